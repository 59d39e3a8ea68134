#include "boresight/rungs/integrator_choice.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace boresight {

std::vector<std::string> integrator_names(const std::string& rung) {
  if (rung == "perturbation") return {"rk4", "dopri5", "rosenbrock"};
  if (rung == "multibody") return {"rk4", "dopri5", "rosenbrock", "generalized-alpha"};
  return {};
}

std::vector<std::string> integrator_names() { return integrator_names("multibody"); }

std::string integrator_of(const RunOptions& options) { return options.integrator.empty() ? "rk4" : options.integrator; }

double tolerance_of(const RunOptions& options, const std::string& rung) {
  if (options.tolerance > 0.0) return options.tolerance;
  return rung == "multibody" ? kMultibodyTolerance : kPerturbationTolerance;
}

bool controls_error(const RunOptions& options) { return integrator_of(options) != "rk4" && options.step == 0.0; }

double smallest_clearance(const Parameters& parameters) {
  double smallest = std::numeric_limits<double>::infinity();
  for (const ClearanceParameters& c : parameters.clearance)
    for (const auto gap : kGaps)
      if (c.*gap > 0.0) smallest = std::min(smallest, c.*gap);
  return std::isfinite(smallest) ? smallest : 0.0;
}

}  // namespace boresight
