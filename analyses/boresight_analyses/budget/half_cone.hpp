// How large a Gaussian error vector gets: the half cone of two axes, the length of three.
//
// The rule of thumb takes one standard deviation for all axes and no mean: r = s sqrt(chi^2_k(P)), for two axes
// s sqrt(-2 ln(1 - P)) (Rayleigh). With a mean or unequal axes it is wrong, unsafe with a mean: with deviations (1, 1)
// and a mean of 1 the 99.73 % radius is 4.021, not 3.439. Here the density is integrated.
#pragma once

#include <span>

namespace boresight {

// P(|x| <= radius) for independent Gaussian components, one to three of them; a deviation of 0 is a fixed value.
double probability_within(double radius, std::span<const double> mean, std::span<const double> sd);
// The radius with P(|x| <= radius) = probability.
double radius_of(double probability, std::span<const double> mean, std::span<const double> sd);
// sqrt(chi^2_axes(probability)): 2.448 for two axes at 95 %, 3.439 at 99.73 %.
double equal_axes_factor(double probability, int axes);

// n_P of mean + n_P sd, for one axis, two-sided: the standard's own whole number near the levels it prints (68 %: 1,
// 95 %: 2, 99.7 %: 3), between them the Gaussian's. ECSS-E-ST-60-10C, 5.2 and Annex C.
double coverage_factor(double probability);

}  // namespace boresight
