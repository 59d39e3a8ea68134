// What taking means over windows leaves of an error whose course in time is known: exact, not the rational (Pade)
// approximations of the handbook.
//
// ESSB-HB-E-003 (ESA Pointing Error Engineering Handbook, 2011), 8: with x = omega times the window,
//   |F_MPE|^2 = 2 (1 - cos x) / x^2      |F_RPE|^2 = 1 - |F_MPE|^2      |F_PDE|^2 = 2 (1 - cos omega separation)
//   |F_MPE|^2
// are the factors of a sinusoid's mean square. Noise with autocovariance s^2 exp(-|t| / tau), first order, keeps of its
// variance in a window's mean, with x = window / tau (the autocovariance integrated twice),
//   2 (x - 1 + exp(-x)) / x^2
#pragma once

#include "boresight_analyses/budget/error_index.hpp"

namespace boresight {

// The largest size that the index takes of a sinusoid of amplitude 1, over its phase and over time. Of RPE, with
// s = sin(x / 2) / (x / 2) left of the mean and the angle theta from the window's middle, |theta| <= x / 2,
//   max over theta of sqrt(1 - 2 s cos(theta) + s^2)
// which is above the square root of its mean square over theta: within a window shorter than the period the error is
// largest at the ends. The other indices are sinusoids themselves.
double peak_of_sinusoid(ErrorIndex index, double angular_frequency, const Windows& windows);  // [rad/s]

// Share of the mean square that the index keeps; above 1 where two windows add up. Windows hold what the index needs.
double kept_of_sinusoid(ErrorIndex index, double angular_frequency, const Windows& windows);  // [rad/s]
double kept_of_noise(ErrorIndex index, double correlation_time, const Windows& windows);      // [s], positive

}  // namespace boresight
