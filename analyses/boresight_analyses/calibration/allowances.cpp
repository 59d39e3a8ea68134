#include "boresight_analyses/calibration/allowances.hpp"

#include <algorithm>

namespace boresight {
namespace {

bool any_starts_with(const CalibrationProblem& problem, const std::string& one, const std::string& all) {
  return std::any_of(problem.parameters.begin(), problem.parameters.end(),
                     [&](const FittedParameter& p) { return p.path.starts_with(one) || p.path.starts_with(all); });
}

}  // namespace

void allow_for(const Discrepancy& discrepancy, CalibrationProblem& problem) {
  if (!problem.follows_play()) return;
  allow_for_lag(problem, discrepancy);
  if (!(discrepancy.axial > 0.0)) return;
  const MechanismDescription& m = problem.runs.front().mechanism->description();
  const std::vector<std::string> paths = parameter_paths(m);
  for (const ClearanceDescription& c : m.clearances) {
    const std::string joint = "clearance." + m.joints[static_cast<std::size_t>(c.joint)].name + ".",
                      path = joint + "axial";
    if (!any_starts_with(problem, joint, "clearance.*.") || any_starts_with(problem, path, "clearance.*.axial") ||
        std::find(paths.begin(), paths.end(), path) == paths.end())
      continue;
    const double told = ParameterPath(m, path).get(problem.runs.front().told());
    // Runs that set a gap each in its own way have no one gap to fit.
    if (!(told > 0.0) || std::any_of(problem.runs.begin(), problem.runs.end(), [&](const CalibrationRun& run) {
          return ParameterPath(m, path).get(run.told()) != told;
        }))
      continue;
    problem.parameters.push_back(fitted_parameter(m, path, told));
    problem.parameters.back().has_prior = true;
    problem.parameters.back().prior = discrepancy.axial * told;
  }
}

}  // namespace boresight
