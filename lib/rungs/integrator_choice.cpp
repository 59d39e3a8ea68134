#include "boresight/rungs/integrator_choice.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace boresight {

std::vector<std::string> integrator_names(const std::string& rung) {
  if (rung == "perturbation") return {"rk4", "dopri5", "rosenbrock"};
  if (rung == "multibody") return {"rk4", "dopri5", "rosenbrock", "generalized-alpha"};
  return {};
}

std::vector<std::string> integrator_names() { return integrator_names("multibody"); }

std::string integrator_of(const RunOptions& options, const std::string& rung) {
  const std::string name = options.integrator.empty() ? "rk4" : options.integrator;
  const std::vector<std::string> known = integrator_names(rung);
  if (std::find(known.begin(), known.end(), name) == known.end()) {
    std::string there;
    for (const std::string& k : known) there += (there.empty() ? "" : ", ") + k;
    throw std::invalid_argument("no integrator \"" + name + "\" on the " + rung + " rung; there is: " + there);
  }
  if (options.tolerance > 0.0 && name == "rk4")
    throw std::invalid_argument("rk4 has no error estimate, so no tolerance");
  if (options.tolerance > 0.0 && options.step > 0.0)
    throw std::invalid_argument("a step and a tolerance: steps are fixed or under error control, not both");
  return name;
}

double tolerance_of(const RunOptions& options, const std::string& rung) {
  if (options.tolerance > 0.0) return options.tolerance;
  return rung == "multibody" ? kMultibodyTolerance : kPerturbationTolerance;
}

double smallest_clearance(const Parameters& parameters) {
  double smallest = std::numeric_limits<double>::infinity();
  for (const ClearanceParameters& c : parameters.clearance)
    for (double clearance : {c.radial, c.axial})
      if (clearance > 0.0) smallest = std::min(smallest, clearance);
  return std::isfinite(smallest) ? smallest : 0.0;
}

}  // namespace boresight
