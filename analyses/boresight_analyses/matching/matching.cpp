#include "boresight_analyses/matching/matching.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "boresight_analyses/matching/confirmation_sentence.hpp"
#include "boresight_analyses/statistics/independent_samples.hpp"

namespace boresight {
namespace {

// A descent begins with steps this large, as a share of the ranges: impacts make the objective rough at a
// small scale.
constexpr double kFirstStep = 0.2;

class Matching {
 public:
  Matching(const MatchingPlan& plan, DesignEvaluator& evaluator, const MatchingOptions& options)
      : plan_(plan), evaluator_(&evaluator), options_(options) {}

  MatchingResult run(DesignEvaluator* confirm, const std::string& rung) {
    try {
      search();
      if (result_.design.empty()) return result_;  // no design answered, and the failures say why
      draw_map();
      take_from_map();
      judge_descents();
      seek_front();
      if (confirm != nullptr) confirm_on(*confirm, rung);
    } catch (const EvaluationInterrupted&) {
      result_.interrupted = true;
      result_.converged = false;
      if (result_.design.empty()) best_of_visits();
    }
    if (!result_.design.empty()) describe(*evaluator_);
    return result_;
  }

 private:
  std::vector<double> design_at(std::span<const double> x) const {
    std::vector<double> design;
    for (std::size_t i = 0; i < x.size(); ++i) design.push_back(plan_.variables[i].from_search(x[i]));
    return design;
  }
  std::vector<double> place_of(const std::vector<double>& design) const {
    std::vector<double> x;
    for (std::size_t i = 0; i < design.size(); ++i) x.push_back(plan_.variables[i].to_search(design[i]));
    return x;
  }
  MatchingVisit visit(const std::vector<double>& design) {
    const std::vector<Outcome>& outcomes = evaluator_->at(design);
    MatchingVisit v{.design = design, .objective = plan_.objective.of(outcomes), .violation = 0.0, .stage = stage_};
    for (const MatchingConstraint& c : plan_.constraints) v.violation = std::max(v.violation, excess(c, outcomes));
    if (std::isfinite(v.objective)) largest_ = std::max(largest_, std::abs(v.objective));
    result_.visits.push_back(v);
    result_.evaluations = evaluator_->computed();
    result_.reused = evaluator_->reused();
    if (options_.progress) options_.progress(result_);
    return v;
  }

  // An objective and constraints as the search sees them. A design that fails is worse than any seen.
  MinimisationProblem problem(const MeasureChoice* objective, const MatchingConstraint* further) {
    MinimisationProblem p;
    for (const DesignVariable& v : plan_.variables) {
      p.lower.push_back(v.to_search(v.from));
      p.upper.push_back(v.to_search(v.to));
    }
    p.objective = [this, objective](std::span<const double> x, std::span<double> gradient) {
      const MatchingVisit v = visit(design_at(x));
      if (!gradient.empty()) slopes_at(x, v.design, gradient);
      const double value = objective ? objective->of(evaluator_->at(v.design)) : v.objective;
      // Before any design has answered nothing is known of how large answers are.
      constexpr double kNoneYet = 1e3;
      return std::isfinite(value) ? value : largest_ > 0.0 ? 10.0 * largest_ : kNoneYet;
    };
    for (const MatchingConstraint& c : plan_.constraints)
      p.constraints.push_back(
          [this, &c](std::span<const double> x, std::span<double>) { return excess(c, evaluator_->at(design_at(x))); });
    if (further)
      p.constraints.push_back([this, further](std::span<const double> x, std::span<double>) {
        return excess(*further, evaluator_->at(design_at(x)));
      });
    return p;
  }

  // Where a descent by gradients meets a design without.
  struct NoSlopes {};
  void slopes_at(std::span<const double> x, const std::vector<double>& design, std::span<double> gradient) {
    const std::optional<std::vector<double>> slopes = options_.slopes(design, no_slopes_);
    if (!slopes) throw NoSlopes{};
    for (std::size_t i = 0; i < x.size(); ++i) gradient[i] = (*slopes)[i] * plan_.variables[i].slope_of_search(x[i]);
  }

  MinimisationOptions search_options(bool global, int evaluations) const {
    return {.global = global ? plan_.global : "none",
            .local = global ? "none" : plan_.local,
            .global_evaluations = evaluations,
            .local_evaluations = evaluations,
            .tolerance = plan_.tolerance,
            .constraint_tolerance = 1e-6,
            .initial_step = kFirstStep,
            .seed = plan_.seed,
            .interrupted = options_.interrupted};
  }

  Minimum descend(const std::vector<double>& from, const std::string& name, int evaluations) {
    stage_ = "descent from " + name;
    MinimisationProblem p = problem(nullptr, nullptr);
    p.start = place_of(from);
    MinimisationOptions o = search_options(false, evaluations);
    Minimum m;
    p.gradients = options_.slopes && no_slopes_.empty() && (plan_.local == "auto" || plan_.wants_gradients());
    if (!p.gradients && plan_.wants_gradients()) o.local = "auto";
    try {
      m = minimise(p, o);
    } catch (const NoSlopes&) {
      p.gradients = false;
      o.local = "auto";
      m = minimise(p, o);
    }
    if (m.interrupted) throw EvaluationInterrupted{};
    result_.descents.push_back({name, from, design_at(m.x), m.objective, m.evaluations, m.converged, false, m.local});
    result_.local = m.local;
    take(m);
    return m;
  }

  // Where it is the best so far. A place whose runs failed is no optimum, whatever stood for its objective.
  void take(const Minimum& m) {
    const bool answered = std::isfinite(plan_.objective.of(evaluator_->at(design_at(m.x))));
    const bool better = answered && (result_.design.empty() || m.violation < result_.violation ||
                                     (m.violation == result_.violation && m.objective < result_.objective));
    if (better) {
      result_.design = design_at(m.x);
      result_.objective = m.objective;
      result_.violation = m.violation;
      result_.converged = m.converged;
      result_.feasible = m.violation <= 1e-6;
    }
  }

  std::string shown(double value, double beside) const {
    if (options_.shown) return options_.shown(value, beside);
    char text[40];
    std::snprintf(text, sizeof text, "%.4g", value);
    return text;
  }

  void search() {
    if (plan_.local == "none") result_.local = "none";
    const std::vector<std::vector<double>> starts = plan_.starts();
    if (plan_.global != "none") {
      stage_ = "search of the box";
      MinimisationProblem p = problem(nullptr, nullptr);
      p.start = place_of(starts.front());
      const Minimum m = minimise(p, search_options(true, plan_.evaluations));
      if (m.interrupted) throw EvaluationInterrupted{};
      result_.global = m.global;
      result_.why = m.why.substr(0, m.why.find("; the descent"));
      if (plan_.local == "none")
        take(m);  // it is the whole search, and knows whether it was exhausted
      else
        descend(design_at(m.x), "the box", plan_.evaluations);
    } else {
      result_.global = "none";
      result_.why = "no search of the whole box was asked for";
    }
    for (std::size_t k = 0; k < starts.size(); ++k)
      descend(starts[k], "start " + std::to_string(k + 1), plan_.evaluations);
    // Any place seen on the way counts, the corners of the search included.
    best_of_visits();
    if (result_.local == "none") return;
    result_.why += "; then " + result_.local;
    if (result_.local == "slsqp" || result_.local == "mma") {
      result_.why += ", which goes by gradients: every motion on the way had exact slopes to its end";
      return;
    }
    result_.why +=
        result_.local == "bobyqa" ? ", which models the objective by a quadratic" : ", which needs no gradients";
    result_.why += ": " + (no_slopes_.empty() ? options_.no_slopes : no_slopes_);
  }

  void best_of_visits() {
    for (const MatchingVisit& v : result_.visits) {
      if (!std::isfinite(v.objective)) continue;
      const bool keeps = v.violation <= 1e-6;
      const bool better = result_.design.empty() || (keeps && !result_.feasible) ||
                          (keeps && v.objective < result_.objective) ||
                          (!keeps && !result_.feasible && v.violation < result_.violation);
      if (!better) continue;
      result_.design = v.design;
      result_.objective = v.objective;
      result_.violation = v.violation;
      result_.feasible = keeps;
    }
  }

  // Whether b is worse than a beyond what the common samples leave open: Student's t of the paired
  // differences.
  bool is_worse(const std::vector<double>& b, const std::vector<double>& a) {
    if (a == b) return false;
    const auto& of_a = evaluator_->at(a);
    const auto& of_b = evaluator_->at(b);
    const double value_a = plan_.objective.of(of_a), value_b = plan_.objective.of(of_b);
    if (!std::isfinite(value_b)) return true;
    if (plan_.objective.over != Over::mean || of_a.size() < 2)
      return value_b > value_a + options_.accuracy * std::abs(value_a);
    std::vector<double> difference;
    for (std::size_t k = 0; k < of_a.size(); ++k)
      difference.push_back(plan_.objective.of(of_b[k]) - plan_.objective.of(of_a[k]));
    return IndependentSamples(difference).mean(options_.confidence).low > options_.accuracy * std::abs(value_a);
  }

  bool keeps_constraints(const std::vector<double>& design) {
    for (const MatchingConstraint& c : plan_.constraints)
      if (excess(c, evaluator_->at(design)) > 1e-6) return false;
    return true;
  }

  void judge_descents() {
    for (MatchingDescent& d : result_.descents)
      d.agrees = keeps_constraints(d.end) == result_.feasible && !is_worse(d.end, result_.design);
    find_as_good(0);
  }

  // Of the visits from here on.
  void find_as_good(std::size_t first) {
    result_.as_good_from = result_.as_good_to = result_.design;
    const std::vector<MatchingVisit> visits(result_.visits.begin() + static_cast<std::ptrdiff_t>(first),
                                            result_.visits.end());
    for (const MatchingVisit& v : visits) {
      if (v.violation > result_.violation + 1e-6 || is_worse(v.design, result_.design)) continue;
      for (std::size_t i = 0; i < v.design.size(); ++i) {
        result_.as_good_from[i] = std::min(result_.as_good_from[i], v.design[i]);
        result_.as_good_to[i] = std::max(result_.as_good_to[i], v.design[i]);
      }
    }
  }

  std::vector<double> grid(const DesignVariable& v, double through) const {
    std::vector<double> values;
    const double low = v.to_search(v.from), high = v.to_search(v.to);
    for (int i = 0; i < plan_.map; ++i)
      values.push_back(v.from_search(low + (high - low) * static_cast<double>(i) / static_cast<double>(plan_.map - 1)));
    values.front() = v.from;
    values.back() = v.to;
    values.push_back(through);
    std::sort(values.begin(), values.end());
    values.erase(std::unique(values.begin(), values.end()), values.end());
    return values;
  }

  void draw_map() {
    if (plan_.map == 0) return;
    stage_ = "map";
    MatchingMap& map = result_.map;
    map.x = grid(plan_.variables[0], result_.design[0]);
    if (plan_.variables.size() > 1) map.y = grid(plan_.variables[1], result_.design[1]);
    // Gaps until they are known: an interruption leaves a map of the same shape.
    map.value.assign(std::max<std::size_t>(1, map.y.size()), std::vector<double>(map.x.size(), std::nan("")));
    for (std::size_t r = 0; r < map.value.size(); ++r)
      for (std::size_t c = 0; c < map.x.size(); ++c) {
        std::vector<double> design = result_.design;
        design[0] = map.x[c];
        if (!map.y.empty()) design[1] = map.y[r];
        const MatchingVisit v = visit(design);
        if (!(v.violation > 1e-6)) map.value[r][c] = v.objective;
      }
  }

  // A narrow valley that the search went past may show there.
  void take_from_map() {
    if (plan_.map == 0) return;
    const std::vector<double> before = result_.design;
    best_of_visits();
    if (result_.design == before) return;
    descend(result_.design, "the map", plan_.evaluations);
    best_of_visits();
  }

  // Points that no other one beats in both accuracy and stability, of designs that keep the constraints.
  void gather_front(const MeasureChoice& accuracy, const MeasureChoice& stability) {
    std::vector<FrontPoint> all;
    for (const auto& [design, outcomes] : evaluator_->all()) {
      const FrontPoint p{design, accuracy.of(outcomes), stability.of(outcomes)};
      if (std::isfinite(p.index) && std::isfinite(p.free_flight_share) && keeps_constraints(design)) all.push_back(p);
    }
    std::sort(all.begin(), all.end(), [](const FrontPoint& l, const FrontPoint& r) {
      return l.index != r.index ? l.index < r.index : l.free_flight_share < r.free_flight_share;
    });
    result_.front.clear();
    for (const FrontPoint& p : all)
      if (result_.front.empty() || p.free_flight_share < result_.front.back().free_flight_share)
        result_.front.push_back(p);
  }

  void seek_front() {
    MeasureChoice accuracy = plan_.objective, stability = plan_.objective;
    accuracy.measure = Measure::index;
    stability.measure = Measure::free_flight_share;
    gather_front(accuracy, stability);
    if (plan_.front == 0 || result_.front.size() < 2) return;
    stage_ = "front";
    const double low = result_.front.back().free_flight_share, high = result_.front.front().free_flight_share;
    const std::vector<FrontPoint> known = result_.front;
    constexpr int kEvaluationsPerPoint = 12;
    for (int k = 1; k <= plan_.front; ++k) {
      // The most accurate design with at most this much free flight (the epsilon-constraint method, Haimes
      // 1971).
      const MatchingConstraint level{stability, low + (high - low) * k / (plan_.front + 1.0)};
      MinimisationProblem p = problem(&accuracy, &level);
      for (const FrontPoint& f : known)
        if (f.free_flight_share <= level.at_most) {
          p.start = place_of(f.design);
          break;
        }
      MinimisationOptions o = search_options(false, kEvaluationsPerPoint);
      o.local = "cobyla";
      o.initial_step = 0.05;
      if (minimise(p, o).interrupted) throw EvaluationInterrupted{};
    }
    gather_front(accuracy, stability);
  }

  void confirm_on(DesignEvaluator& confirm, const std::string& rung) {
    MatchingConfirmation c;
    c.rung = rung;
    c.seed = confirm.options().seed;
    c.samples = confirm.options().samples;
    const std::vector<Outcome>& outcomes = confirm.at(result_.design);
    c.value = plan_.objective.of(outcomes);
    c.interval = plan_.objective.interval(outcomes, options_.confidence);
    c.design = result_.design;
    c.objective = c.value;
    c.failed = static_cast<std::size_t>(std::count_if(
        outcomes.begin(), outcomes.end(), [](const Outcome& o) { return o.status != Outcome::Status::done; }));
    const double off = std::abs(c.value - result_.objective);
    bool keeps = true;
    for (const MatchingConstraint& k : plan_.constraints) keeps = keeps && excess(k, outcomes) <= options_.accuracy;
    c.agrees = std::isfinite(off) && keeps == result_.feasible &&
               plan_.objective.may_be_alike(evaluator_->at(result_.design), outcomes, options_.confidence,
                                            options_.accuracy * std::abs(c.value));
    c.sentence = confirmation_sentence(c, plan_.constraints, outcomes, options_.accuracy, result_.objective,
                                       result_.feasible, [&](double value) { return shown(value, result_.objective); });
    if (!c.agrees && std::isfinite(off)) {
      // On from there, on the better rung.
      DesignEvaluator* before = evaluator_;
      evaluator_ = &confirm;
      if (options_.slopes) no_slopes_ = "slopes are those of the perturbation rung";
      const MatchingResult cheap = result_;
      result_.design.clear();
      const std::size_t visits_before = result_.visits.size();
      try {
        descend(cheap.design, "the optimum, on " + rung, std::max(8, plan_.evaluations / 3));
        if (result_.design.empty()) result_.design = cheap.design;  // no run there has answered
      } catch (const EvaluationInterrupted&) {
        // What was found before, on its own rung, stands.
        evaluator_ = before;
        result_ = cheap;
        throw;
      }
      c.went_on = result_.design != cheap.design;
      c.design = result_.design;
      c.objective = result_.objective;
      c.sentence += c.went_on ? "; a descent there moved the optimum" : "; a descent there stays where it is";
      // What was as good by the rung before says nothing of this one's.
      find_as_good(visits_before);
      evaluator_ = before;
      result_.descents.back().agrees = true;
      result_.on_confirming_rung = true;
      describe_constraints(confirm);
      result_.interval = plan_.objective.interval(confirm.at(result_.design), options_.confidence);
      result_.evaluations += confirm.computed();
      result_.reused += confirm.reused();
    }
    c.constraint_values = constraints_of(confirm);
    result_.confirmation.push_back(c);
  }

  // At the optimum, on this evaluator's rung.
  std::vector<double> constraints_of(DesignEvaluator& evaluator) const {
    std::vector<double> values;
    const auto& outcomes = evaluator.at(result_.design);
    for (const MatchingConstraint& c : plan_.constraints) values.push_back(c.measure.of(outcomes));
    return values;
  }

  void describe_constraints(DesignEvaluator& evaluator) {
    result_.constraint_values = constraints_of(evaluator);
    result_.active.clear();
    for (std::size_t k = 0; k < plan_.constraints.size(); ++k)
      result_.active.push_back(result_.constraint_values[k] > 0.99 * plan_.constraints[k].at_most);
  }

  void describe(DesignEvaluator& evaluator) {
    for (std::size_t i = 0; i < plan_.variables.size(); ++i) {
      const DesignVariable& v = plan_.variables[i];
      const double low = v.to_search(v.from), high = v.to_search(v.to), at = v.to_search(result_.design[i]);
      const double margin = 1e-3 * (high - low);
      result_.at_bound.push_back(at < low + margin || at > high - margin);
    }
    if (result_.on_confirming_rung) return;
    describe_constraints(evaluator);
    result_.interval = plan_.objective.interval(evaluator.at(result_.design), options_.confidence);
  }

  const MatchingPlan& plan_;
  DesignEvaluator* evaluator_;
  const MatchingOptions& options_;
  MatchingResult result_;
  std::string stage_;
  std::string no_slopes_;  // why descents no longer go by gradients
  double largest_ = 0.0;
};

}  // namespace

MatchingResult run_matching(const MatchingPlan& plan, DesignEvaluator& evaluator, DesignEvaluator* confirm,
                            const std::string& confirming_rung, const MatchingOptions& options) {
  return Matching(plan, evaluator, options).run(confirm, confirming_rung);
}

}  // namespace boresight
