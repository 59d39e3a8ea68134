#include "boresight_analyses/calibration/calibration_fit.hpp"

#include <ceres/ceres.h>

#include <chrono>
#include <limits>

#include "boresight/mechanism/error.hpp"
#include "boresight_analyses/calibration/kept_fits.hpp"

namespace boresight {
namespace {

// What a global counts in within the fit: parameters as they are, times in ms, biases and drifts in standard deviations.
VecX units_of(const CalibrationProblem& problem) {
  VecX units = VecX::Ones(problem.global_count());
  units.segment(problem.time_offset_column(), problem.bias_column() - problem.time_offset_column()).setConstant(1e-3);
  if (problem.fit_bias) units.segment(problem.bias_column(), problem.sigma.size()) = problem.sigma;
  if (problem.fit_drift) units.segment(problem.drift_column(), problem.sigma.size()) = problem.sigma;
  return units;
}

// First column and width of each block of globals: one per parameter, [time offset], [lag], [biases], [drifts].
std::vector<std::pair<int, int>> blocks_of(const CalibrationProblem& problem) {
  std::vector<std::pair<int, int>> blocks;
  for (int g = 0; g < problem.bias_column(); ++g) blocks.emplace_back(g, 1);
  const int channels = static_cast<int>(problem.channels.size());
  for (int g = problem.bias_column(); g < problem.global_count(); g += channels) blocks.emplace_back(g, channels);
  return blocks;
}

// Residuals of one window. Parameter blocks: those of blocks_of(), [start state].
class WindowCost final : public ceres::CostFunction {
 public:
  // What the solver asks of a motion that was followed, or could not be.
  struct Followed {
    bool at_all = false;
    VecX r;
    MatX by_global, by_state;
  };

  WindowCost(const CalibrationProblem& problem, const Window& window, int residuals)
      : problem_(problem),
        window_(window),
        values_(residuals - problem.state_size(window)),
        units_(units_of(problem)),
        globals_(blocks_of(problem)) {
    for (const auto& [first, width] : globals_) mutable_parameter_block_sizes()->push_back(width);
    if (problem.state_size(window) > 0) mutable_parameter_block_sizes()->push_back(problem.state_size(window));
    set_num_residuals(residuals);
  }

  // Follows the window's motion at these blocks, for the Evaluate() that comes next.
  void prepare(const std::vector<double*>& blocks, bool derivatives) {
    const int size = problem_.state_size(window_);
    VecX packed(problem_.global_count());
    for (std::size_t b = 0; b < globals_.size(); ++b)
      packed.segment(globals_[b].first, globals_[b].second) = Eigen::Map<const VecX>(blocks[b], globals_[b].second);
    const Globals globals = problem_.unpacked(packed.cwiseProduct(units_));
    const VecX state = size > 0 ? VecX(Eigen::Map<const VecX>(blocks.back(), size)) : VecX();
    WindowResiduals motion;
    at_.at_all = true;
    try {
      problem_.evaluate(window_, globals, state, derivatives, motion);
    } catch (const ComputationError&) {
      at_.at_all = false;
    }
    at_.r = std::move(motion.r);
    at_.by_global = std::move(motion.by_global);
    at_.by_state = std::move(motion.by_state);
  }
  const Followed& followed() const { return at_; }
  void refuse() { at_.at_all = false; }
  void take(Followed at) { at_ = std::move(at); }

  bool Evaluate(double const* const* blocks, double* residuals, double** jacobians) const override {
    if (!at_.at_all) return false;
    const Followed& at = at_;
    const int size = problem_.state_size(window_);
    const int count = static_cast<int>(parameter_block_sizes().size()), last = size > 0 ? count - 1 : count;
    const VecX state = size > 0 ? VecX(Eigen::Map<const VecX>(blocks[last], size)) : VecX(),
               prior = problem_.prior_deviation(window_);
    for (int i = 0; i < values_; ++i) residuals[i] = problem_.loss.residual(at.r[i]);
    for (int i = 0; i < size; ++i) residuals[values_ + i] = state[i] / prior[i];
    if (!jacobians) return true;
    VecX slope(values_);
    for (int i = 0; i < values_; ++i) slope[i] = problem_.loss.slope(at.r[i]);
    using Rows = Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>;
    for (int b = 0, column = 0; b < count; ++b) {
      const int width = parameter_block_sizes()[b];
      if (jacobians[b]) {
        Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> J = MatX::Zero(num_residuals(), width);
        if (b == last) {
          J.topRows(values_) = slope.asDiagonal() * at.by_state;
          J.bottomRows(size) = prior.cwiseInverse().asDiagonal();
        } else {
          J.topRows(values_) =
              slope.asDiagonal() * at.by_global.middleCols(column, width) * units_.segment(column, width).asDiagonal();
        }
        if (width == 1)
          Eigen::Map<VecX>(jacobians[b], num_residuals()) = J.col(0);
        else
          Rows(jacobians[b], num_residuals(), width) = J;
      }
      column += width;
    }
    return true;
  }

 private:
  const CalibrationProblem& problem_;
  const Window& window_;
  int values_;
  VecX units_;
  std::vector<std::pair<int, int>> globals_;
  Followed at_;
};

void fields(Numbers& n, WindowCost::Followed& f) { n(f.at_all, f.r, f.by_global, f.by_state); }

// All windows at once, each on the thread that is free, before the solver adds them up in their order on one: sums of several threads hang
// on which of them was faster, and a fit among narrow optima on the last bit of a sum.
//
// Evaluations that take long are kept until the fit is, so that a start that goes on loses one of them at most, and not a fit.
class AllWindows final : public ceres::EvaluationCallback {
 public:
  // kept: may be none. fit: the key of this one.
  AllWindows(int jobs, KeptResults* kept, std::uint64_t fit) : jobs_(jobs), kept_(kept), fit_(fit) {}
  void add(WindowCost* cost, std::vector<double*> blocks) { windows_.push_back({cost, std::move(blocks)}); }
  // Whether the blocks are where they may be; asked before every evaluation from here on.
  void ask_first(std::function<bool()> inside) { inside_ = std::move(inside); }
  bool refused() const { return refused_; }
  void PrepareForEvaluation(bool evaluate_jacobians, bool) override {
    if (inside_ && !inside_()) {
      for (const Window& w : windows_) w.cost->refuse();
      refused_ = true;
      return;
    }
    const std::uint64_t key = key_of(evaluations_++);
    if (auto found = kept_result<std::vector<WindowCost::Followed>>(kept_, key);
        found && found->size() == windows_.size()) {
      for (std::size_t k = 0; k < windows_.size(); ++k) windows_[k].cost->take(std::move((*found)[k]));
      return;
    }
    const auto begin = std::chrono::steady_clock::now();
    for_each_on_threads(static_cast<int>(windows_.size()), jobs_,
                        [&](int k) { windows_[k].cost->prepare(windows_[k].blocks, evaluate_jacobians); });
    if (kept_ == nullptr || std::chrono::steady_clock::now() - begin < kLong) return;
    std::vector<WindowCost::Followed> all;
    for (const Window& w : windows_) all.push_back(w.cost->followed());
    kept_->keep(key, Numbers::of(std::move(all)));
  }
  void forget() {
    if (kept_ == nullptr) return;
    for (std::uint64_t k = 0; k < evaluations_; ++k) kept_->forget(key_of(k));
  }

 private:
  // Far longer than it takes to write what an evaluation leaves.
  static constexpr auto kLong = std::chrono::milliseconds(50);
  std::uint64_t key_of(std::uint64_t evaluation) const {
    Checksum sum;
    sum.add(fit_);
    sum.add(evaluation);
    return static_cast<std::uint64_t>(sum.value());
  }

  struct Window {
    WindowCost* cost;
    std::vector<double*> blocks;
  };
  int jobs_;
  KeptResults* kept_;
  std::uint64_t fit_, evaluations_ = 0;
  std::function<bool()> inside_;
  bool refused_ = false;
  std::vector<Window> windows_;
};

// What was known of a global before: its distance from what was told, in standard deviations.
class PriorCost final : public ceres::SizedCostFunction<1, 1> {
 public:
  PriorCost(double expected, double deviation) : expected_(expected), deviation_(deviation) {}
  bool Evaluate(double const* const* blocks, double* residuals, double** jacobians) const override {
    residuals[0] = (blocks[0][0] - expected_) / deviation_;
    if (jacobians && jacobians[0]) jacobians[0][0] = 1.0 / deviation_;
    return true;
  }

 private:
  double expected_, deviation_;
};

class Watch final : public ceres::IterationCallback {
 public:
  // least: the share of the cost below which what a step promised and did not keep is looked for no more.
  Watch(double least, std::function<bool(const ceres::IterationSummary&)> see) : least_(least), see_(std::move(see)) {}
  ceres::CallbackReturnType operator()(const ceres::IterationSummary& s) override {
    if (!see_(s)) return ceres::SOLVER_ABORT;
    const double promised = s.cost_change / s.relative_decrease;
    const bool in_vain = s.iteration > 0 && s.step_is_valid && !s.step_is_successful && promised < least_ * s.cost;
    return in_vain ? ceres::SOLVER_TERMINATE_SUCCESSFULLY : ceres::SOLVER_CONTINUE;
  }

 private:
  double least_;
  std::function<bool(const ceres::IterationSummary&)> see_;
};

int value_count(const CalibrationProblem& problem, const Window& w) {
  return static_cast<int>(
      problem.runs[w.run].data.value.middleRows(w.first, w.last - w.first + 1).array().isFinite().count());
}

}  // namespace

std::vector<int> windows_of(const CalibrationProblem& problem, const FitOptions& options) {
  if (!options.windows.empty()) return options.windows;
  std::vector<int> windows;
  for (std::size_t w = 0; w < problem.windows.size(); ++w)
    if (!problem.windows[w].held_out) windows.push_back(static_cast<int>(w));
  return windows;
}

std::vector<VecX> guess_states(const CalibrationProblem& problem, const std::vector<int>& windows,
                               const Globals& globals, int jobs) {
  std::vector<VecX> states(windows.size());
  // Window after window within a run, so that each may go on from where the one before led.
  for_each_on_threads(static_cast<int>(problem.runs.size()), jobs, [&](int run) {
    int before = -1;
    for (std::size_t k = 0; k < windows.size(); ++k) {
      const Window& w = problem.windows[windows[k]];
      if (w.run != run) continue;
      VecX carried;
      if (before >= 0 && windows[before] + 1 == windows[k]) {
        const Window& earlier = problem.windows[windows[before]];
        try {
          carried = problem.state_at(earlier, globals, states[before], w.start);
        } catch (const ComputationError&) {
        }
      }
      states[k] = problem.guess_state(w, globals, carried);
      before = static_cast<int>(k);
    }
  });
  return states;
}

namespace {

// key: what it is kept under.
FitResult computed_fit(const CalibrationProblem& problem, const Globals& start, std::vector<VecX> states,
                       const FitOptions& options, std::uint64_t key) {
  FitResult result;
  result.globals = start;
  result.windows = windows_of(problem, options);
  if (states.empty()) states = guess_states(problem, result.windows, start, options.jobs);

  const int P = problem.parameter_count();
  // The solver orders blocks by where they lie in memory: one after the other, so that no fit hangs on what the heap had room for.
  const int G = problem.global_count();
  const VecX units = units_of(problem);
  const std::vector<std::pair<int, int>> global_blocks = blocks_of(problem);
  Eigen::Index numbers = G;
  for (const VecX& state : states) numbers += state.size();
  VecX packed(numbers);
  packed.head(G) = problem.packed(start).cwiseQuotient(units);
  std::vector<Eigen::Map<VecX>> state_of;
  for (Eigen::Index k = 0, at = G; k < static_cast<Eigen::Index>(states.size()); ++k) {
    state_of.emplace_back(packed.data() + at, states[k].size());
    state_of.back() = states[k];
    at += states[k].size();
  }
  AllWindows all(options.jobs, problem.kept, key);
  ceres::Problem::Options of_problem;
  of_problem.evaluation_callback = &all;
  ceres::Problem ceres_problem(of_problem);
  bool free_states = false;
  auto ordering = std::make_shared<ceres::ParameterBlockOrdering>();
  for (std::size_t k = 0; k < result.windows.size(); ++k) {
    const Window& w = problem.windows[result.windows[k]];
    std::vector<double*> blocks;
    for (const auto& [first, width] : global_blocks) blocks.push_back(packed.data() + first);
    if (states[k].size() > 0) blocks.push_back(state_of[k].data());
    auto cost = std::make_unique<WindowCost>(problem, w, value_count(problem, w) + problem.state_size(w));
    all.add(cost.get(), blocks);
    ceres_problem.AddResidualBlock(cost.release(), nullptr, blocks);
    if (states[k].size() == 0) continue;
    ordering->AddElementToGroup(state_of[k].data(), 0);
    if (w.from_rest) {
      ceres_problem.SetParameterBlockConstant(state_of[k].data());
    } else {
      free_states = true;
    }
  }
  const VecX known = problem.prior_information(), expected = problem.packed(problem.start());
  for (const auto& [first, width] : global_blocks) {
    double* const block = packed.data() + first;
    ordering->AddElementToGroup(block, 1);
    if (first >= P && options.fix_nuisance) ceres_problem.SetParameterBlockConstant(block);
    if (known[first] > 0.0)
      ceres_problem.AddResidualBlock(
          new PriorCost(expected[first] / units[first], 1.0 / (units[first] * std::sqrt(known[first]))), nullptr,
          block);
    if (first < P && !options.fixed.empty() && options.fixed[first]) ceres_problem.SetParameterBlockConstant(block);
  }
  VecX low = VecX::Constant(G, -std::numeric_limits<double>::infinity()), high = -low;
  for (int p = 0; p < P; ++p) {
    low[p] = problem.parameters[p].lowest_coordinate();
    high[p] = problem.parameters[p].highest_coordinate();
  }
  if (problem.fit_time_offset) {
    high[problem.time_offset_column()] = problem.largest_time_offset / units[problem.time_offset_column()];
    low[problem.time_offset_column()] = -high[problem.time_offset_column()];
  }
  // With bounds every step is searched along, three motions for one. They are set where a step has led beyond them.
  packed.head(G) = packed.head(G).cwiseMax(low).cwiseMin(high);
  all.ask_first(
      [&] { return (packed.head(G).array() >= low.array()).all() && (packed.head(G).array() <= high.array()).all(); });
  const auto set_bounds = [&] {
    all.ask_first({});
    for (const auto& [first, width] : global_blocks) {
      if (!std::isfinite(low[first])) continue;
      ceres_problem.SetParameterLowerBound(packed.data() + first, 0, low[first]);
      ceres_problem.SetParameterUpperBound(packed.data() + first, 0, high[first]);
    }
  };

  const auto take = [&] { result.globals = problem.unpacked(packed.head(G).cwiseProduct(units)); };
  Eigen::Index values = 0;
  for (const int w : result.windows) values += value_count(problem, problem.windows[w]);
  Watch watch(
      options.least_gain / static_cast<double>(std::max<Eigen::Index>(1, values)),
      [&](const ceres::IterationSummary& s) {
        if (!options.progress) return true;
        take();
        result.interrupted = !options.progress({s.iteration, options.most_iterations, 2.0 * s.cost, result.globals});
        return !result.interrupted;
      });
  ceres::Solver::Options solver;
  solver.linear_solver_type = ceres::DENSE_SCHUR;
  solver.linear_solver_ordering = ordering;
  if (!free_states) {
    solver.linear_solver_type = ceres::DENSE_QR;
    solver.linear_solver_ordering.reset();
  }
  solver.num_threads = 1;
  solver.max_num_iterations = options.most_iterations;
  solver.function_tolerance = options.cost_tolerance;
  solver.parameter_tolerance = options.parameter_tolerance;
  solver.update_state_every_iteration = true;
  solver.initial_trust_region_radius = options.first_radius;
  solver.callbacks.push_back(&watch);
  solver.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  // Each window's own landscape is rough, and one radius of trust for all of them together holds the
  // parameters where the roughest window is: between solves every window looks for its start state alone.
  const int rounds = free_states ? 3 : 1;
  solver.max_num_iterations = std::max(1, options.most_iterations / rounds);
  bool bounded = false;
  for (int round = 0; round < rounds; ++round) {
    ceres::Solve(solver, &ceres_problem, &summary);
    if (round == 0) result.start_cost = 2.0 * summary.initial_cost;
    if (all.refused() && !bounded && !result.interrupted) {
      bounded = true;
      result.iterations += static_cast<int>(summary.iterations.size()) - 1;
      result.evaluations += summary.num_residual_evaluations + summary.num_jacobian_evaluations;
      set_bounds();
      ceres::Solve(solver, &ceres_problem, &summary);
    }
    take();
    result.iterations += static_cast<int>(summary.iterations.size()) - 1;
    result.evaluations += summary.num_residual_evaluations + summary.num_jacobian_evaluations;
    if (round + 1 == rounds || result.interrupted || !summary.IsSolutionUsable()) break;
    for_each_on_threads(static_cast<int>(states.size()), options.jobs, [&](int k) {
      const Window& w = problem.windows[result.windows[k]];
      if (w.from_rest) return;
      VecX state = state_of[k];
      problem.refine_state(w, result.globals, state, 6);
      state_of[k] = state;
    });
  }
  for (std::size_t k = 0; k < states.size(); ++k) states[k] = state_of[k];
  result.states = std::move(states);
  // A start whose motion cannot be followed has no cost.
  result.cost = summary.IsSolutionUsable() ? 2.0 * summary.final_cost : std::numeric_limits<double>::infinity();
  result.converged = summary.termination_type == ceres::CONVERGENCE || summary.termination_type == ceres::USER_SUCCESS;
  if (result.interrupted)
    result.reason = "interrupted";
  else if (result.converged)
    result.reason = "converged: cost or parameters no longer change";
  else if (summary.termination_type == ceres::NO_CONVERGENCE)
    result.reason = "stopped after " + std::to_string(result.iterations) + " iterations, still falling";
  else
    result.reason = "failed: " + summary.message;
  if (problem.kept != nullptr && !result.interrupted) {
    problem.kept->keep(key, Numbers::of(result));
    all.forget();
  }
  return result;
}

}  // namespace

FitResult fit(const CalibrationProblem& problem, const Globals& start, std::vector<VecX> states,
              const FitOptions& options) {
  if (problem.kept == nullptr) return computed_fit(problem, start, std::move(states), options, 0);
  const std::uint64_t key =
      CalibrationKey("fit", problem)
          .add(start, states, options.most_iterations, options.cost_tolerance, options.parameter_tolerance,
               options.least_gain, options.first_radius, options.windows,
               std::vector<int>(options.fixed.begin(), options.fixed.end()), options.fix_nuisance)
          .value();
  if (std::optional<FitResult> found = kept_result<FitResult>(problem.kept, key)) return std::move(*found);
  return computed_fit(problem, start, std::move(states), options, key);
}

}  // namespace boresight
