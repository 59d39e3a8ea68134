// One of two independent normal coordinates with the same sd, given that their point lies within `radius` of the centre:
//
//   f(x) = phi(x / sd) / sd * erf(sqrt(R^2 - x^2) / (sd sqrt 2)) / (1 - exp(-R^2 / 2 sd^2))
//
// (the plane's normal density, integrated along the chord at x). Its variance is half the mean square of the distance,
// sd^2 (1 - a / (e^a - 1)) with a = R^2 / 2 sd^2.
#pragma once

#include "boresight_analyses/random/distribution.hpp"

namespace boresight {

// radius, sd > 0.
DistributionPtr make_disc_coordinate(double centre, double radius, double sd);

}  // namespace boresight
