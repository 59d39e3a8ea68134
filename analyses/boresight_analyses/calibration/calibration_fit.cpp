#include "boresight_analyses/calibration/calibration_fit.hpp"

#include <ceres/ceres.h>

#include <limits>

#include "boresight_analyses/calibration/kept_fits.hpp"
#include "boresight_analyses/calibration/window_cost.hpp"

namespace boresight {
namespace {

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

// The first of the solver's iterations is the start; it has none where that cannot be followed.
int steps_of(const ceres::Solver::Summary& summary) {
  return std::max(0, static_cast<int>(summary.iterations.size()) - 1);
}

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
      result.iterations += steps_of(summary);
      result.evaluations += summary.num_residual_evaluations + summary.num_jacobian_evaluations;
      set_bounds();
      ceres::Solve(solver, &ceres_problem, &summary);
    }
    take();
    result.iterations += steps_of(summary);
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
  // The solver asks nobody where the start itself cannot be followed: a search over such starts would be deaf.
  constexpr double kNone = std::numeric_limits<double>::infinity();
  if (!result.interrupted && summary.iterations.empty() && options.progress)
    result.interrupted = !options.progress({0, options.most_iterations, kNone, result.globals});
  for (std::size_t k = 0; k < states.size(); ++k) states[k] = state_of[k];
  result.states = std::move(states);
  // A start whose motion cannot be followed has no cost.
  result.cost = summary.IsSolutionUsable() ? 2.0 * summary.final_cost : kNone;
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
