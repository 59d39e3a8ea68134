#include "boresight_analyses/calibration/posterior.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

namespace boresight {
namespace {

// What is known of all parameters together, in the coordinates of the fit.
struct Known {
  VecX u, deviation;
  MatX correlation;
};

// Standing errors at poses that the data cannot tell apart: combinations of them are known, and the errors are not. What nothing tells is
// taken for what it may well be (FittedParameter::size, about the start), so that the combinations stay as well known as they are.
bool tells_combinations(const CalibrationProblem& problem, const Inference& inference, int p) {
  return !problem.follows_play() && problem.parameters[p].is_error() && !problem.parameters[p].has_prior &&
         !inference.parameters[p].identifiable && std::isfinite(inference.parameters[p].standard_error);
}

Known known_of(const CalibrationProblem& problem, const Inference& inference) {
  const int P = problem.parameter_count(), G = static_cast<int>(inference.information.rows());
  Known known{VecX(P), VecX(P), inference.correlation.topLeftCorner(P, P)};
  bool any = false;
  for (int p = 0; p < P; ++p) {
    known.u[p] = problem.parameters[p].coordinate(inference.parameters[p].value);
    known.deviation[p] = inference.parameters[p].student * inference.parameters[p].coordinate_error;
    any = any || tells_combinations(problem, inference, p);
  }
  if (!any) return known;
  std::vector<int> free;
  double growth = 1.0;
  for (int g = 0; g < G; ++g) {
    if (!std::isfinite(inference.covariance(g, g))) continue;
    free.push_back(g);
    // Residuals that follow one another have made variances larger.
    growth = std::max(growth, inference.growth[g]);
  }
  const VecX prior = problem.prior_information();
  MatX information = inference.information(free, free);
  VecX told = VecX::Zero(information.rows()), away = told;
  for (std::size_t k = 0; k < free.size(); ++k) {
    const int g = free[k];
    const auto i = static_cast<Eigen::Index>(k);
    information(i, i) -= prior[g];
    if (g >= P || !tells_combinations(problem, inference, g)) continue;
    told[i] = 1.0;
    away[i] = known.u[g] - problem.parameters[g].coordinate(problem.parameters[g].start);
  }
  information /= inference.variance_factor * growth;
  information.diagonal() += prior(free) + told;
  const Eigen::LDLT<MatX> solver(information);
  const MatX inverse = solver.solve(MatX::Identity(information.rows(), information.cols()));
  const VecX back = inverse * told.cwiseProduct(away);
  // Channels with noises of their own scatter otherwise than one variance factor says (channel_variances.hpp).
  const double s4 = inference.variance_factor * inference.variance_factor;
  const MatX covariance = inverse + inverse * inference.departure(free, free) * inverse / (s4 * growth);
  for (std::size_t a = 0; a < free.size(); ++a) {
    if (free[a] >= P) continue;
    const auto i = static_cast<Eigen::Index>(a);
    known.u[free[a]] -= back[i];
    known.deviation[free[a]] = inference.parameters[free[a]].student * std::sqrt(covariance(i, i));
    for (std::size_t b = 0; b < free.size(); ++b)
      if (const auto j = static_cast<Eigen::Index>(b); free[b] < P)
        known.correlation(free[a], free[b]) = covariance(i, j) / std::sqrt(covariance(i, i) * covariance(j, j));
  }
  return known;
}

std::string quantity(double value, const std::string& unit) {
  char number[100];
  if (unit == "1" || unit.empty())
    std::snprintf(number, sizeof number, "%.17g", value);
  else
    std::snprintf(number, sizeof number, "\"%.17g %s\"", value, unit.c_str());
  return number;
}

}  // namespace

std::string all_allowed(const FittedParameter& parameter) {
  return "{ uniform = { min = " + quantity(parameter.lower, parameter.si_unit) +
         ", max = " + quantity(parameter.upper, parameter.si_unit) + " } }";
}

std::string posterior_toml(const CalibrationProblem& problem, const Inference& inference) {
  std::string out =
      "# What a calibration knows of the parameters, as random inputs of a study (boresight montecarlo). "
      "Gaussian in the\n"
      "# coordinates of the fit: logarithms, so lognormal; restitution: normal, truncated to where it can "
      "be; standing errors: normal.\n";
  char text[400];
  const int P = problem.parameter_count();
  const Known known = known_of(problem, inference);
  // What was known before bounds what the data do not know.
  const auto is_told = [&](int p) {
    return inference.parameters[p].identifiable || problem.parameters[p].has_prior ||
           tells_combinations(problem, inference, p);
  };
  for (int p = 0; p < P; ++p) {
    const ParameterEstimate& e = inference.parameters[p];
    const FittedParameter& parameter = problem.parameters[p];
    std::string distribution;
    if (parameter.is_error() && !is_told(p)) {
      out += "\n# " + e.name + " is not identifiable (" + e.reason + "): it stays what the mechanism file says.\n";
      continue;
    }
    if (parameter.is_error()) {
      if (tells_combinations(problem, inference, p))
        out += "\n# Not identifiable (" + e.reason + "): normal, of " + quantity(parameter.size, e.si_unit) +
               " about its start, within what the data tell of it and others together.";
      distribution = "{ normal = { mean = " + quantity(parameter.value(known.u[p]), e.si_unit) +
                     ", sd = " + quantity(known.deviation[p] * parameter.size, e.si_unit) + " } }";
    } else if (!is_told(p) || !std::isfinite(e.coordinate_error)) {
      out += "\n# Not identifiable (" + e.reason + "): all that is allowed for it.";
      distribution = all_allowed(parameter);
    } else if (parameter.transform == Transform::log) {
      std::snprintf(text, sizeof text, "%.17g", std::exp(known.deviation[p]));
      distribution = "{ lognormal = { median = " + quantity(e.value, e.si_unit) + ", factor = " + text + " } }";
    } else {
      distribution = "{ normal = { mean = " + quantity(e.value, e.si_unit) +
                     ", sd = " + quantity(e.student * e.standard_error, e.si_unit) + " }, truncate = [" +
                     quantity(parameter.lower, e.si_unit) + ", " + quantity(parameter.upper, e.si_unit) + "] }";
    }
    out += "\n[[random]]\nparameter = \"" + e.name + "\"\ndistribution = " + distribution + "\n";
  }
  for (int a = 0; a < P; ++a)
    for (int b = a + 1; b < P; ++b) {
      const double rho = known.correlation(a, b);
      if (!is_told(a) || !is_told(b) || !std::isfinite(rho)) continue;
      // To the last digit, and a little less: what errors are together may be known ten thousand times as well as each of them, and the matrix
      // stays positive definite.
      constexpr double kOfRounding = 1e-12;
      std::snprintf(text, sizeof text, "%.17g", (1.0 - kOfRounding) * rho);
      out += "\n[[correlation]]\nparameters = [\"" + inference.parameters[a].name + "\", \"" +
             inference.parameters[b].name + "\"]\ncoefficient = " + text + "\nmeasure = \"normal\"\n";
    }
  return out;
}

}  // namespace boresight
