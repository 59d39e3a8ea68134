#include "boresight_analyses/calibration/law_comparison.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "boresight/contact/normal_law.hpp"
#include "boresight_analyses/calibration/inference.hpp"

namespace boresight {

void hold_out_windows(CalibrationProblem& problem, double share) {
  if (share <= 0.0) return;
  const int every = std::max(2, static_cast<int>(std::lround(1.0 / share)));
  for (std::size_t w = 0; w < problem.windows.size(); ++w)
    problem.windows[w].held_out = static_cast<int>(w) % every == every - 1;
  // Of few windows one.
  const auto windows = static_cast<int>(problem.windows.size());
  if (windows > 1 && windows < every) problem.windows.back().held_out = true;
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
    for (ClearanceDescription& c : description.clearances) {
      c.contact_law = law;
      // Damping of another law's is a matter of laws for cylinders, which have none of their own.
      if (normal_law(law).geometry != ContactGeometry::line) c.dissipation_law.clear();
    }
    run.mechanism = std::make_shared<const Mechanism>(std::move(description));
  }
  // A tangent is that of the law it was taken with.
  for (ModelCorrection& correction : other.corrections) correction.tangent.reset();
  const FitResult found = fit(other, start, {}, options);
  const Inference inference = infer(other, found, 0.95, options.fixed, options.jobs);
  LawScore score;
  score.law = law;
  score.cost = found.cost;
  score.reason = found.reason;
  score.evaluations = found.evaluations;
  score.values = inference.values;
  const auto values = static_cast<double>(inference.values);
  score.residuals = {.mean_square = inference.variance_factor * (values - inference.unknowns) / values,
                     .per_independent_one = inference.per_independent_one,
                     .parameters = static_cast<double>(inference.unknowns)};
  // What the law does not know is no parameter of it: restitution of Hertz's, say.
  score.parameters = inference.unknowns + 1;
  for (Eigen::Index g = 0; g < inference.information.rows(); ++g) {
    const bool held = g < static_cast<Eigen::Index>(options.fixed.size()) && options.fixed[static_cast<std::size_t>(g)];
    if (!held && inference.information(g, g) == 0.0) --score.parameters;
  }
  if (const auto held = score_held_out(other, found.globals, options.jobs)) score.held_out = held->rms;
  return score;
}

void compare(std::vector<LawScore>& scores) {
  if (scores.empty()) return;
  const LawScore fits_best = *std::min_element(scores.begin(), scores.end(),
                                               [](const LawScore& a, const LawScore& b) { return a.cost < b.cost; });
  double best = std::numeric_limits<double>::infinity();
  for (LawScore& s : scores) {
    s.effective_values = static_cast<double>(s.values) / fits_best.residuals.per_independent_one;
    s.aic = akaike(s.cost, static_cast<double>(s.values), s.parameters, fits_best.residuals);
    best = std::min(best, s.aic);
  }
  for (LawScore& s : scores) s.difference = s.aic == best ? 0.0 : s.aic - best;
}

}  // namespace boresight
