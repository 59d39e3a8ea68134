#include "boresight_analyses/calibration/law_comparison.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace boresight {

void hold_out_windows(CalibrationProblem& problem, double share) {
  if (share <= 0.0) return;
  const int every = std::max(2, static_cast<int>(std::lround(1.0 / share)));
  for (std::size_t w = 0; w < problem.windows.size(); ++w)
    problem.windows[w].held_out = static_cast<int>(w) % every == every - 1;
}

std::optional<HoldOut> score_held_out(const CalibrationProblem& problem, const Globals& globals, int jobs) {
  std::vector<int> windows;
  for (std::size_t w = 0; w < problem.windows.size(); ++w)
    if (problem.windows[w].held_out) windows.push_back(static_cast<int>(w));
  if (windows.empty()) return {};
  HoldOut score;
  const std::vector<VecX> states = guess_states(problem, windows, globals, jobs);
  double sum = 0.0;
  for (std::size_t k = 0; k < windows.size(); ++k) {
    WindowResiduals at;
    problem.evaluate(problem.windows[windows[k]], globals, states[k], false, at);
    for (Eigen::Index i = 0; i < at.r.size(); ++i) sum += std::pow(problem.loss.residual(at.r[i]), 2);
    score.values += at.r.size() - (problem.windows[windows[k]].from_rest ? 0 : states[k].size());
  }
  score.rms = std::sqrt(sum / static_cast<double>(std::max(1L, score.values)));
  return score;
}

LawScore law_score(const CalibrationProblem& problem, const std::string& law, const Globals& start,
                   const FitOptions& options) {
  CalibrationProblem other = problem;
  for (CalibrationRun& run : other.runs) {
    MechanismDescription description = run.mechanism->description();
    for (ClearanceDescription& c : description.clearances) c.contact_law = law;
    run.mechanism = std::make_shared<const Mechanism>(std::move(description));
  }
  // A tangent is that of the law it was taken with.
  for (ModelCorrection& correction : other.corrections) correction.tangent.reset();
  const FitResult found = fit(other, start, {}, options);
  // Hertz's law has no restitution: as many fewer as are fitted, none where none is.
  double parameters = other.global_count();
  if (law == "hertz")
    parameters -= static_cast<double>(
        std::count_if(other.parameters.begin(), other.parameters.end(),
                      [](const FittedParameter& q) { return q.path.ends_with(".contact.restitution"); }));
  LawScore score{law, found.cost, found.cost + 2.0 * parameters, 0.0, {}, found.reason, found.evaluations};
  if (const auto held = score_held_out(other, found.globals, options.jobs)) score.held_out = held->rms;
  return score;
}

void compare(std::vector<LawScore>& scores) {
  double best = std::numeric_limits<double>::infinity();
  for (const LawScore& s : scores) best = std::min(best, s.aic);
  for (LawScore& s : scores) s.difference = s.aic - best;
}

}  // namespace boresight
