// The loss along each parameter, all others fitted anew: intervals that follow its shape where it is no
// parabola.
//
//   { u : (C(u) - C(u_hat)) / s^2 <= chi-square quantile of one degree of freedom }         Venzon and
//   Moolgavkar (1988)
#pragma once

#include "boresight_analyses/calibration/inference.hpp"

namespace boresight {

struct Profile {
  int parameter = 0;
  std::vector<double> value, cost_rise;  // the loss over its least, divided by s^2
  double low = 0.0, high = 0.0;          // where the rise reaches the quantile; NaN: not within reach
};

// Of every parameter that is not fixed, at 1, 2 and 3 standard errors to each side.
std::vector<Profile> profile_likelihood(const CalibrationProblem& problem, const FitResult& fit,
                                        const Inference& inference, const std::vector<bool>& fixed,
                                        double confidence, int jobs);

}  // namespace boresight
