#include "boresight_analyses/calibration/calibration_fit.hpp"

#include <ceres/ceres.h>

#include "boresight/mechanism/error.hpp"
#include "boresight_analyses/calibration/kept_fits.hpp"

namespace boresight {
namespace {

// Residuals of one window. Parameter blocks: one per parameter, [time offset], [biases], [start state].
class WindowCost final : public ceres::CostFunction {
 public:
  WindowCost(const CalibrationProblem& problem, const Window& window, int residuals)
      : problem_(problem), window_(window), values_(residuals - problem.state_size(window)) {
    for (int p = 0; p < problem.parameter_count(); ++p) mutable_parameter_block_sizes()->push_back(1);
    if (problem.fit_time_offset) mutable_parameter_block_sizes()->push_back(1);
    if (problem.fit_bias) mutable_parameter_block_sizes()->push_back(static_cast<int>(problem.channels.size()));
    if (problem.state_size(window) > 0) mutable_parameter_block_sizes()->push_back(problem.state_size(window));
    set_num_residuals(residuals);
  }

  // Follows the window's motion at these blocks, for the Evaluate() that comes next.
  void prepare(const std::vector<double*>& blocks, bool derivatives) {
    const int P = problem_.parameter_count(), size = problem_.state_size(window_);
    const int count = static_cast<int>(parameter_block_sizes().size()), last = size > 0 ? count - 1 : count;
    Globals globals;
    globals.u.resize(P);
    for (int p = 0; p < P; ++p) globals.u[p] = blocks[p][0];
    int block = P;
    if (problem_.fit_time_offset) globals.time_offset = 1e-3 * blocks[block++][0];
    if (problem_.fit_bias) {
      globals.bias = Eigen::Map<const VecX>(blocks[block], parameter_block_sizes()[block]);
      globals.bias = globals.bias.cwiseProduct(problem_.sigma);
    }
    const VecX state = size > 0 ? VecX(Eigen::Map<const VecX>(blocks[last], size)) : VecX();
    try {
      problem_.evaluate(window_, globals, state, derivatives, at_);
      followed_ = true;
    } catch (const ComputationError&) {
      followed_ = false;
    }
  }

  bool Evaluate(double const* const* blocks, double* residuals, double** jacobians) const override {
    if (!followed_) return false;
    const WindowResiduals& at = at_;
    const int P = problem_.parameter_count(), size = problem_.state_size(window_);
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
          J.topRows(values_) = slope.asDiagonal() * at.by_global.middleCols(column, width);
          // The fit counts the time offset in ms, biases in standard deviations.
          if (b >= P && problem_.fit_time_offset && b == P)
            J *= 1e-3;
          else if (b >= P)
            J *= problem_.sigma.asDiagonal();
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
  WindowResiduals at_;
  bool followed_ = false;
};

// All windows at once, each on the thread that is free, before the solver adds them up in their order on one: sums of several threads hang
// on which of them was faster, and a fit among narrow optima on the last bit of a sum.
class AllWindows final : public ceres::EvaluationCallback {
 public:
  explicit AllWindows(int jobs) : jobs_(jobs) {}
  void add(WindowCost* cost, std::vector<double*> blocks) { windows_.push_back({cost, std::move(blocks)}); }
  void PrepareForEvaluation(bool evaluate_jacobians, bool) override {
    for_each_on_threads(static_cast<int>(windows_.size()), jobs_,
                        [&](int k) { windows_[k].cost->prepare(windows_[k].blocks, evaluate_jacobians); });
  }

 private:
  struct Window {
    WindowCost* cost;
    std::vector<double*> blocks;
  };
  int jobs_;
  std::vector<Window> windows_;
};

// What was known of a standing error before: (u - u_start) in standard deviations.
class PriorCost final : public ceres::SizedCostFunction<1, 1> {
 public:
  explicit PriorCost(double expected) : expected_(expected) {}
  bool Evaluate(double const* const* blocks, double* residuals, double** jacobians) const override {
    residuals[0] = blocks[0][0] - expected_;
    if (jacobians && jacobians[0]) jacobians[0][0] = 1.0;
    return true;
  }

 private:
  double expected_;
};

class Watch final : public ceres::IterationCallback {
 public:
  explicit Watch(std::function<bool(const ceres::IterationSummary&)> see) : see_(std::move(see)) {}
  ceres::CallbackReturnType operator()(const ceres::IterationSummary& s) override {
    return see_(s) ? ceres::SOLVER_CONTINUE : ceres::SOLVER_ABORT;
  }

 private:
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

FitResult computed_fit(const CalibrationProblem& problem, const Globals& start, std::vector<VecX> states,
                       const FitOptions& options) {
  FitResult result;
  result.globals = start;
  result.windows = windows_of(problem, options);
  if (states.empty()) states = guess_states(problem, result.windows, start, options.jobs);

  const int P = problem.parameter_count();
  // The solver orders blocks by where they lie in memory: one after the other, so that no fit hangs on what the heap had room for.
  Eigen::Index numbers = P + 1 + (problem.fit_bias ? problem.sigma.size() : 0);
  for (const VecX& state : states) numbers += state.size();
  VecX packed(numbers);
  Eigen::Map<VecX> u(packed.data(), P);
  double& offset = packed[P];
  Eigen::Map<VecX> bias(packed.data() + P + 1, problem.fit_bias ? problem.sigma.size() : 0);
  u = start.u;
  offset = 1e3 * start.time_offset;
  if (problem.fit_bias) bias = start.bias.cwiseQuotient(problem.sigma);
  std::vector<Eigen::Map<VecX>> state_of;
  for (Eigen::Index k = 0, at = P + 1 + bias.size(); k < static_cast<Eigen::Index>(states.size()); ++k) {
    state_of.emplace_back(packed.data() + at, states[k].size());
    state_of.back() = states[k];
    at += states[k].size();
  }
  AllWindows all(options.jobs);
  ceres::Problem::Options of_problem;
  of_problem.evaluation_callback = &all;
  ceres::Problem ceres_problem(of_problem);
  bool free_states = false;
  auto ordering = std::make_shared<ceres::ParameterBlockOrdering>();
  for (std::size_t k = 0; k < result.windows.size(); ++k) {
    const Window& w = problem.windows[result.windows[k]];
    std::vector<double*> blocks;
    for (int p = 0; p < P; ++p) blocks.push_back(&u[p]);
    if (problem.fit_time_offset) blocks.push_back(&offset);
    if (problem.fit_bias) blocks.push_back(bias.data());
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
  for (int p = 0; p < P; ++p) {
    ordering->AddElementToGroup(&u[p], 1);
    ceres_problem.SetParameterLowerBound(&u[p], 0, problem.parameters[p].lowest_coordinate());
    ceres_problem.SetParameterUpperBound(&u[p], 0, problem.parameters[p].highest_coordinate());
    if (!options.fixed.empty() && options.fixed[p]) ceres_problem.SetParameterBlockConstant(&u[p]);
    const FittedParameter& parameter = problem.parameters[p];
    if (parameter.has_prior)
      ceres_problem.AddResidualBlock(new PriorCost(parameter.coordinate(parameter.start)), nullptr, &u[p]);
  }
  if (problem.fit_time_offset) {
    ordering->AddElementToGroup(&offset, 1);
    ceres_problem.SetParameterLowerBound(&offset, 0, -1e3 * problem.largest_time_offset);
    ceres_problem.SetParameterUpperBound(&offset, 0, 1e3 * problem.largest_time_offset);
    if (options.fix_nuisance) ceres_problem.SetParameterBlockConstant(&offset);
  }
  if (problem.fit_bias) {
    ordering->AddElementToGroup(bias.data(), 1);
    if (options.fix_nuisance) ceres_problem.SetParameterBlockConstant(bias.data());
  }

  const auto take = [&] {
    result.globals.u = u;
    result.globals.time_offset = 1e-3 * offset;
    if (problem.fit_bias) result.globals.bias = bias.cwiseProduct(problem.sigma);
  };
  Watch watch([&](const ceres::IterationSummary& s) {
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
  solver.callbacks.push_back(&watch);
  solver.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  // Each window's own landscape is rough, and one radius of trust for all of them together holds the
  // parameters where the roughest window is: between solves every window looks for its start state alone.
  const int rounds = free_states ? 3 : 1;
  solver.max_num_iterations = std::max(1, options.most_iterations / rounds);
  for (int round = 0; round < rounds; ++round) {
    ceres::Solve(solver, &ceres_problem, &summary);
    take();
    if (round == 0) result.start_cost = 2.0 * summary.initial_cost;
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
  result.cost = 2.0 * summary.final_cost;
  result.converged = summary.termination_type == ceres::CONVERGENCE;
  if (result.interrupted)
    result.reason = "interrupted";
  else if (summary.termination_type == ceres::CONVERGENCE)
    result.reason = "converged: cost or parameters no longer change";
  else if (summary.termination_type == ceres::NO_CONVERGENCE)
    result.reason = "stopped after " + std::to_string(result.iterations) + " iterations, still falling";
  else
    result.reason = "failed: " + summary.message;
  return result;
}

}  // namespace

FitResult fit(const CalibrationProblem& problem, const Globals& start, std::vector<VecX> states,
              const FitOptions& options) {
  if (problem.kept == nullptr) return computed_fit(problem, start, std::move(states), options);
  const std::uint64_t key =
      CalibrationKey("fit", problem)
          .add(start, states, options.most_iterations, options.cost_tolerance, options.parameter_tolerance,
               options.windows, std::vector<int>(options.fixed.begin(), options.fixed.end()), options.fix_nuisance)
          .value();
  if (std::optional<FitResult> found = kept_result<FitResult>(problem.kept, key)) return std::move(*found);
  FitResult result = computed_fit(problem, start, std::move(states), options);
  if (!result.interrupted) problem.kept->keep(key, Numbers::of(result));
  return result;
}

}  // namespace boresight
