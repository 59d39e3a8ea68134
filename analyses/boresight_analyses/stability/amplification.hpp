// What one step does to a damped vibration: in theory from a method's stability function, in measurement from
// a signal.
//
//   x'' + 2 alpha x' + beta^2 x = 0,   roots  s = -alpha +- sqrt(alpha^2 - beta^2)
//   a step of size h multiplies each part of the motion by R(h s); it dies if the larger |R| is below 1.
// With beta the angular frequency of a contact and alpha its damping c/(2m) this is the linear contact; with
// Baumgarte's gains it is the error of a constraint (Baumgarte 1972, Computer Methods in Applied Mechanics
// and Engineering 1, 1-16). R: Hairer and Wanner (1996), Solving Ordinary Differential Equations II, section
// IV.2.
#pragma once

#include <functional>
#include <vector>

#include "boresight/integrate/order_conditions.hpp"

namespace boresight {

// The larger |R| over both roots, for alpha h and beta h [-].
double theoretical_growth(const MethodCoefficients& method, double alpha_h, double beta_h);

// The beta h up to which a vibration of damping ratio zeta = alpha / beta dies [-]: 0 is the imaginary axis,
// above 1 the faster of two real roots decides.
double theoretical_limit(const MethodCoefficients& method, double zeta);

// The growth per step that a signal shows, whatever made it: a sum of two powers obeys x_{n+2} = p x_{n+1} -
// q x_n, whose p and q are fitted by least squares; the larger root of r^2 - p r + q is the growth. Equations
// weigh by the largest value so far: those of a growing signal alike, those of a dying one less and less, as
// its roundings gain on it. signal: four values or more, one per step. NaN if the signal says nothing (all
// zero, not finite).
double measured_growth(const std::vector<double>& signal);

// Where a growth, measured as a function of a step, crosses 1 for the first time within 0.89 and 1.2 of
// `guess`: in strides of 2 %, then by bisection to 1e-5. NaN if it does not, or is above 1 at the start
// already.
double measured_limit(const std::function<double(double)>& growth, double guess);

}  // namespace boresight
