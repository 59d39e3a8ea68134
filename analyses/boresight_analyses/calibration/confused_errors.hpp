// Standing errors that these data cannot tell apart: they move the boresight alike wherever it was measured, and only combinations of them
// are known.
//
// In the coordinates of the fit an error counts in sizes that it may well have (its prior's deviation, or FittedParameter::size), so that
// lengths, angles and temperatures compare. Of the information M about the errors, all else that is fitted eliminated,
//
//   M = H_ee - H_eo H_oo^+ H_oe        M v = lambda v
//
// a direction v is not seen where lambda < 1 / kUnknown^2: its standard error is more than that share of a size. With N the directions not
// seen, reduced so that each has one error (its pivot f) for itself, the combinations
//
//   phi_i = u_i - sum_f N_if u_f
//
// do not change along any of them: these the data know (estimable functions: Scheffe 1959, The Analysis of Variance, 1.4; of calibrations
// Meggiolaro and Dubowsky 2000, An analytical method to eliminate the redundant parameters in robot calibration, ICRA).
#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "boresight_analyses/calibration/calibration_problem.hpp"

namespace boresight {

// A coordinate's standard deviation beyond which the data are said not to know a parameter: as a logarithm, a factor of two at 95 %
// confidence; of an error the share of its size.
inline constexpr double kUnknown = 0.35;

struct KnownCombination {
  std::vector<std::pair<int, double>>
      terms;                       // parameter, coefficient [unit of the first over its own]; the first's is 1
  std::string si_unit, told_unit;  // of the first
  double value = 0.0, standard_error = 0.0, low = 0.0, high = 0.0;
};

// Those that hang together; none known: the data say nothing of them.
struct ConfusedErrors {
  std::vector<int> parameters;
  bool hidden = false;  // were nothing else fitted (offsets of channels, contacts), the data would tell them apart
  std::vector<KnownCombination> known;
};

// What infer() knows of a fit.
struct KnownOfErrors {
  MatX data_information;         // without priors
  MatX information;              // with them
  double variance_factor = 1.0;  // s^2
  MatX departure;                // ChannelVariances
  MatX covariance;
  VecX growth;                                  // of variances, since residuals follow one another
  std::function<double(const VecX&)> quantile;  // of the interval of a combination, by how all unknowns go with it
};

std::vector<ConfusedErrors> confused_errors(const CalibrationProblem& problem, const Globals& globals,
                                            const KnownOfErrors& known, const std::vector<bool>& fixed);

// "error.a + 0.7 error.b".
std::string in_words(const KnownCombination& combination, const std::vector<FittedParameter>& parameters);
// What the data cannot tell of these errors, one sentence.
std::string in_words(const ConfusedErrors& group, const std::vector<FittedParameter>& parameters);

}  // namespace boresight
