#include "boresight_analyses/calibration/posterior.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace boresight {

std::string posterior_toml(const CalibrationProblem& problem, const Inference& inference) {
  std::string out =
      "# What a calibration knows of the parameters, as random inputs of a study (boresight montecarlo). "
      "Gaussian in the\n"
      "# coordinates of the fit: logarithms, so lognormal; restitution: normal, truncated to where it can "
      "be; standing errors: normal.\n";
  char text[400];
  const int P = problem.parameter_count();
  const auto quantity = [](double value, const std::string& unit) {
    char number[64];
    if (unit == "1" || unit.empty())
      std::snprintf(number, sizeof number, "%.17g", value);
    else
      std::snprintf(number, sizeof number, "\"%.17g %s\"", value, unit.c_str());
    return std::string(number);
  };
  for (int p = 0; p < P; ++p) {
    const ParameterEstimate& e = inference.parameters[p];
    const FittedParameter& parameter = problem.parameters[p];
    std::string distribution;
    // What was known before bounds what the data do not know.
    const bool known = e.identifiable || parameter.has_prior;
    if (parameter.is_error() && !known) {
      out += "\n# " + e.name + " is not identifiable (" + e.reason + "): it stays what the mechanism file says.\n";
      continue;
    }
    if (parameter.is_error()) {
      distribution = "{ normal = { mean = " + quantity(e.value, e.si_unit) +
                     ", sd = " + quantity(e.standard_error, e.si_unit) + " } }";
    } else if (!e.identifiable) {
      out += "\n# Not identifiable (" + e.reason + "): all that is allowed for it.";
      distribution = "{ uniform = { min = " + quantity(parameter.lower, e.si_unit) +
                     ", max = " + quantity(parameter.upper, e.si_unit) + " } }";
    } else if (parameter.transform == Transform::log) {
      std::snprintf(text, sizeof text, "%.17g", std::exp(e.coordinate_error));
      distribution = "{ lognormal = { median = " + quantity(e.value, e.si_unit) + ", factor = " + text + " } }";
    } else {
      distribution = "{ normal = { mean = " + quantity(e.value, e.si_unit) +
                     ", sd = " + quantity(e.standard_error, e.si_unit) + " }, truncate = [" +
                     quantity(parameter.lower, e.si_unit) + ", " + quantity(parameter.upper, e.si_unit) + "] }";
    }
    out += "\n[[random]]\nparameter = \"" + e.name + "\"\ndistribution = " + distribution + "\n";
  }
  for (int a = 0; a < P; ++a)
    for (int b = a + 1; b < P; ++b) {
      const double rho = inference.correlation(a, b);
      const auto& first = inference.parameters[a];
      const auto& second = inference.parameters[b];
      if (!(first.identifiable || problem.parameters[a].has_prior) ||
          !(second.identifiable || problem.parameters[b].has_prior) || !std::isfinite(rho))
        continue;
      std::snprintf(text, sizeof text,
                    "\n[[correlation]]\nparameters = [\"%s\", \"%s\"]\ncoefficient = %.6f\nmeasure = \"normal\"\n",
                    first.name.c_str(), second.name.c_str(), std::clamp(rho, -0.999, 0.999));
      out += text;
    }
  return out;
}

}  // namespace boresight
