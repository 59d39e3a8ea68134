#include "boresight_analyses/optimise/minimise.hpp"

#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>
#include <nlopt.hpp>
#include <stdexcept>

namespace boresight {
namespace {

struct Algorithm {
  const char* name;
  nlopt::algorithm plain, constrained;  // equal where one takes both
  bool takes_constraints, wants_gradient;
  std::size_t least_dimensions;
};

constexpr Algorithm kGlobal[] = {{"direct-l", nlopt::GN_DIRECT_L, nlopt::GN_ORIG_DIRECT_L, true, false, 1},
                                 {"crs2", nlopt::GN_CRS2_LM, nlopt::GN_CRS2_LM, false, false, 1},
                                 {"mlsl", nlopt::G_MLSL_LDS, nlopt::G_MLSL_LDS, false, false, 1},
                                 {"isres", nlopt::GN_ISRES, nlopt::GN_ISRES, true, false, 1}};
constexpr Algorithm kLocal[] = {{"cobyla", nlopt::LN_COBYLA, nlopt::LN_COBYLA, true, false, 1},
                                {"bobyqa", nlopt::LN_BOBYQA, nlopt::LN_BOBYQA, false, false, 2},
                                {"slsqp", nlopt::LD_SLSQP, nlopt::LD_SLSQP, true, true, 1},
                                {"mma", nlopt::LD_MMA, nlopt::LD_MMA, true, true, 1}};

template <std::size_t N>
const Algorithm* named(const Algorithm (&all)[N], const std::string& name) {
  for (const Algorithm& a : all)
    if (name == a.name) return &a;
  return nullptr;
}

class Search {
 public:
  Search(const MinimisationProblem& problem, const MinimisationOptions& options)
      : problem_(problem), options_(options), gradient_(problem.size()) {}

  Minimum run() {
    const std::string global = choose_global(), local = choose_local();
    result_.global = global;
    result_.local = local;
    std::vector<double> start(problem_.size());
    for (std::size_t i = 0; i < start.size(); ++i)
      start[i] = std::clamp((problem_.start[i] - problem_.lower[i]) / range(i), 0.0, 1.0);
    best_ = start;
    if (const Algorithm* a = named(kGlobal, global)) attempt(*a, best_, options_.global_evaluations, true);
    if (const Algorithm* a = named(kLocal, local); a && !result_.interrupted)
      attempt(*a, best_, options_.local_evaluations, false);
    if (!seen_ && !result_.interrupted) evaluate(best_, nullptr);
    result_.x = scaled(best_);
    result_.objective = best_value_;
    result_.violation = std::max(0.0, best_violation_);
    result_.evaluations = evaluations_;
    return result_;
  }

 private:
  double range(std::size_t i) const { return std::max(problem_.upper[i] - problem_.lower[i], 1e-300); }
  std::vector<double> scaled(const std::vector<double>& u) const {
    std::vector<double> x(u.size());
    for (std::size_t i = 0; i < x.size(); ++i)
      x[i] = std::clamp(problem_.lower[i] + u[i] * range(i), problem_.lower[i], problem_.upper[i]);
    return x;
  }

  std::string choose_global() {
    const bool constrained = !problem_.constraints.empty();
    if (options_.global != "auto") {
      const Algorithm* a = named(kGlobal, options_.global);
      if (options_.global != "none" && a == nullptr) throw std::invalid_argument("no global search " + options_.global);
      if (a && constrained && !a->takes_constraints)
        throw std::invalid_argument(options_.global + " takes no constraints; direct-l and isres do");
      result_.why = "the search was asked for";
      return options_.global;
    }
    constexpr std::size_t kMostForDirect = 6;
    if (constrained || problem_.size() <= kMostForDirect) {
      result_.why = constrained ? "DIRECT-L, which divides the box and takes constraints"
                                : "DIRECT-L, which divides the box evenly: few variables";
      return "direct-l";
    }
    result_.why = "CRS2, a population of points: too many variables to divide the box";
    return "crs2";
  }

  std::string choose_local() {
    const bool constrained = !problem_.constraints.empty();
    if (options_.local != "auto") {
      const Algorithm* a = named(kLocal, options_.local);
      if (options_.local != "none" && a == nullptr) throw std::invalid_argument("no descent " + options_.local);
      if (a && a->wants_gradient && !problem_.gradients)
        throw std::invalid_argument(options_.local +
                                    " wants gradients, which there are none of; cobyla and bobyqa do not");
      if (a && constrained && !a->takes_constraints)
        throw std::invalid_argument(options_.local + " takes no constraints; cobyla does");
      if (a && problem_.size() < a->least_dimensions)
        throw std::invalid_argument(options_.local + " wants two variables or more; cobyla does not");
      result_.why += "; the descent was asked for";
      return options_.local;
    }
    if (problem_.gradients) {
      result_.why += "; then SLSQP, as there are gradients";
      return "slsqp";
    }
    if (constrained || problem_.size() < 2) {
      result_.why += constrained ? "; then COBYLA, which takes constraints without gradients"
                                 : "; then COBYLA: no gradients, one variable";
      return "cobyla";
    }
    result_.why += "; then BOBYQA, which builds a quadratic model without gradients";
    return "bobyqa";
  }

  // Value at a place of the unit box; remembers the best place that keeps the constraints, or breaks them
  // least.
  double evaluate(const std::vector<double>& u, double* gradient) {
    if (options_.interrupted && options_.interrupted()) {
      result_.interrupted = true;
      throw nlopt::forced_stop();
    }
    // DIRECT divides all boxes of a round before it looks at what it was granted.
    if (tried_++ >= granted_) {
      spent_ = true;
      throw nlopt::forced_stop();
    }
    const std::vector<double> x = scaled(u);
    ++evaluations_;
    const double value = problem_.objective(x, gradient ? std::span<double>(gradient_) : std::span<double>());
    if (gradient)
      for (std::size_t i = 0; i < x.size(); ++i) gradient[i] = gradient_[i] * range(i);
    double violation = -HUGE_VAL;
    for (const auto& constraint : problem_.constraints) violation = std::max(violation, constraint(x, {}));
    const double excess = std::max(0.0, violation - options_.constraint_tolerance);
    if (!seen_ || excess < best_excess_ || (excess == best_excess_ && value < best_value_)) {
      seen_ = true;
      best_ = u;
      best_value_ = value;
      best_violation_ = violation;
      best_excess_ = excess;
    }
    return value;
  }

  struct Bound {
    Search* search;
    std::size_t constraint;
  };
  // What the caller's functions throw ends the search and is thrown on; NLopt would swallow it.
  template <typename Compute>
  double guarded(const Compute& compute) {
    try {
      return compute();
    } catch (const nlopt::forced_stop&) {
      throw;
    } catch (...) {
      fault_ = std::current_exception();
      throw nlopt::forced_stop();
    }
  }
  static double objective_of(const std::vector<double>& u, std::vector<double>& gradient, void* data) {
    Search& s = *static_cast<Search*>(data);
    return s.guarded([&] {
      const double value = s.evaluate(u, gradient.empty() ? nullptr : gradient.data());
      if (gradient.empty()) return value;
      // SLSQP and MMA begin as if the objective bent by 1 over the box, and end where steps are short: an objective of
      // tenths of a millimetre would never set out. Scaled, the first step is initial_step long.
      if (s.scale_ == 0.0) {
        double square = 0.0;
        for (std::size_t i = 0; i < u.size(); ++i)
          if (!(u[i] <= 0.0 && gradient[i] > 0.0) && !(u[i] >= 1.0 && gradient[i] < 0.0))
            square += gradient[i] * gradient[i];
        s.scale_ = square > 0.0 ? s.options_.initial_step / std::sqrt(square) : 1.0;
      }
      for (double& slope : gradient) slope *= s.scale_;
      return value * s.scale_;
    });
  }
  static double constraint_of(const std::vector<double>& u, std::vector<double>& gradient, void* data) {
    const auto& bound = *static_cast<Bound*>(data);
    Search& s = *bound.search;
    const double value = s.guarded([&] {
      return s.problem_.constraints[bound.constraint](
          s.scaled(u), gradient.empty() ? std::span<double>() : std::span<double>(s.gradient_));
    });
    for (std::size_t i = 0; i < gradient.size(); ++i) gradient[i] = s.gradient_[i] * s.range(i);
    return value;
  }

  void attempt(const Algorithm& a, std::vector<double> from, int evaluations, bool global) {
    if (evaluations <= 0) return;
    scale_ = 0.0;
    const auto n = static_cast<unsigned>(problem_.size());
    nlopt::opt optimiser(problem_.constraints.empty() ? a.plain : a.constrained, n);
    optimiser.set_lower_bounds(0.0);
    optimiser.set_upper_bounds(1.0);
    optimiser.set_min_objective(objective_of, this);
    std::vector<Bound> bounds(problem_.constraints.size());
    for (std::size_t k = 0; k < bounds.size(); ++k) {
      bounds[k] = {this, k};
      optimiser.add_inequality_constraint(constraint_of, &bounds[k], options_.constraint_tolerance);
    }
    optimiser.set_maxeval(evaluations);
    tried_ = 0;
    granted_ = evaluations;
    spent_ = false;
    if (a.plain == nlopt::G_MLSL_LDS) {
      const bool bobyqa = !problem_.gradients && n > 1;
      nlopt::opt descent(problem_.gradients ? nlopt::LD_SLSQP : bobyqa ? nlopt::LN_BOBYQA : nlopt::LN_COBYLA, n);
      descent.set_xtol_abs(10.0 * options_.tolerance);
      optimiser.set_local_optimizer(descent);
    }
    if (!global) {
      optimiser.set_xtol_abs(options_.tolerance);
      // Towards the inside where the start lies on a bound, so that no first step is lost.
      std::vector<double> step(n, options_.initial_step);
      for (unsigned i = 0; i < n; ++i)
        if (from[i] + step[i] > 1.0) step[i] = -step[i];
      if (!a.wants_gradient) optimiser.set_initial_step(step);
    }
    nlopt::srand(options_.seed);
    double value = 0.0;
    try {
      const nlopt::result ended = optimiser.optimize(from, value);
      result_.converged = global ? options_.local == "none" : ended != nlopt::MAXEVAL_REACHED;
      result_.stopped = ended == nlopt::MAXEVAL_REACHED ? "the most evaluations were reached"
                                                        : "the variables came to rest within the tolerance";
    } catch (const nlopt::roundoff_limited&) {
      result_.converged = !global;
      result_.stopped = "rounding allows no further progress";
    } catch (const nlopt::forced_stop&) {
      result_.converged = spent_ && global && options_.local == "none";
      result_.stopped = spent_ ? "the most evaluations were reached" : "interrupted";
    } catch (const std::runtime_error&) {
      // NLopt's plain failure (SLSQP where a gradient breaks off): the best place seen stands, unproven.
      result_.converged = false;
      result_.stopped = "the algorithm could not go on";
    }
    if (fault_) std::rethrow_exception(fault_);
  }

  const MinimisationProblem& problem_;
  const MinimisationOptions& options_;
  std::vector<double> gradient_, best_;
  Minimum result_;
  double best_value_ = 0.0, best_violation_ = 0.0, best_excess_ = 0.0;
  double scale_ = 0.0;  // of the objective, for algorithms that go by gradients; 0: not known yet
  int evaluations_ = 0;
  int tried_ = 0, granted_ = std::numeric_limits<int>::max();  // of one attempt
  bool seen_ = false, spent_ = false;
  std::exception_ptr fault_;
};

template <std::size_t N>
std::vector<std::string> words(const Algorithm (&all)[N]) {
  std::vector<std::string> names = {"auto", "none"};
  for (const Algorithm& a : all) names.emplace_back(a.name);
  return names;
}

}  // namespace

std::vector<std::string> global_algorithms() { return words(kGlobal); }
std::vector<std::string> local_algorithms() { return words(kLocal); }

Minimum minimise(const MinimisationProblem& problem, const MinimisationOptions& options) {
  const std::size_t n = problem.size();
  if (n == 0 || problem.upper.size() != n || problem.start.size() != n)
    throw std::invalid_argument("bounds and start of different sizes, or of none");
  for (std::size_t i = 0; i < n; ++i)
    if (!(problem.lower[i] < problem.upper[i]))
      throw std::invalid_argument("a lower bound that is not below the upper one");
  return Search(problem, options).run();
}

}  // namespace boresight
