// Largest Lyapunov exponent of a motion from its own history: Rosenstein, Collins, De Luca (1993), Physica D
// 65, 117-134.
//
// Every state has a nearest neighbour elsewhere on the motion (at the same phase of the drive, at least
// `apart` away in time). The mean logarithm of the distance between the two, followed as both go on, rises as
// the exponent times time until it meets the size of the motion. A straight line through the rise is the
// exponent; a motion that does not part from itself has none.
#pragma once

#include <vector>

#include "boresight_analyses/nonlinear/return_map.hpp"

namespace boresight {

struct Divergence {
  double exponent = 0.0;                         // [1/s]
  double standard_error = 0.0;                   // of the straight line [1/s]
  double fitted_from = 0.0, fitted_until = 0.0;  // the rise [s]
  bool rises = false;                            // by at least a factor e before it levels off
  std::vector<double> t;                         // [s]
  std::vector<double> log_distance;
  int pairs = 0;  // neighbours followed
};

// apart: least separation in time of two neighbours [s]; horizon: how long they are followed [s]. States are
// scaled by their spread. Neighbours share the drive's phase; a map or an autonomous motion has per_period 1.
Divergence largest_lyapunov_exponent(const StateSeries& series, double apart, double horizon);

}  // namespace boresight
