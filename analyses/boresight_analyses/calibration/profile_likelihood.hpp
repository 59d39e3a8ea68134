// The loss along each parameter, all others fitted anew: intervals that follow its shape where it is no
// parabola. Impacts that come and go with a parameter bend it: its curvature at the optimum, and with it the
// standard error, may then differ by a factor of two from one side to the other.
//
//   { u : (C(u) - C(u_hat)) / s^2 <= t^2 }, t the intervals' quantile                        Venzon and
//   Moolgavkar (1988), with Student's t where few residuals tell s^2: Bates and Watts (1988), 6.1
//
// Where residuals follow one another, s^2 is larger by what that does to the parameter's variance.
#pragma once

#include "boresight_analyses/calibration/inference.hpp"

namespace boresight {

struct Profile {
  int parameter = 0;
  std::vector<double> value, cost_rise;  // rising; the loss over its least, divided by s^2
  double low = 0.0, high = 0.0;          // where the rise reaches the quantile; NaN: not within reach
};

// Of every contact parameter that is not fixed; by standing errors the loss is a parabola. lower: becomes the lowest place that was come by, if lower than it.
std::vector<Profile> profile_likelihood(const CalibrationProblem& problem, const FitResult& fit,
                                        const Inference& inference, const std::vector<bool>& fixed, int jobs,
                                        FitResult& lower);

// Puts the profiles' intervals in place of those by curvature; standard errors become what a Gaussian of the
// same width has, and correlations stay.
void take_intervals(const std::vector<Profile>& profiles, const CalibrationProblem& problem, Inference& inference);

}  // namespace boresight
