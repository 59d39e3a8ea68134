// What being linear in standing errors misses, for many samples: a number of the mechanism, found once by closing the built mechanism's
// joints exactly, in place of such a closure for each sample (standing_model_error.hpp, which a single run affords).
//
// The miss is of second order. With s_e the most that error e displaces any body per unit (in turns, or in lengths of the mechanism's size),
// a sample misses the index by about
//
//     curvature * sum over e of (eps_e s_e)^2,
//
// curvature the largest found among errors one by one, and all together with signs drawn at random, in the proportions in which they are typically
// there: among many that are not, what two errors miss together would count for next to nothing. Some of these at their typical size, where higher
// orders may miss more.
#pragma once

#include "boresight/pointing/indices.hpp"
#include "boresight/scene/standing_errors.hpp"

namespace boresight {

class StandingCurvature {
 public:
  // typical: the size of each error, such as its RMS over a scatter [SI]; none: all displace alike.
  StandingCurvature(const Mechanism& mechanism, const IdealMotion& commanded, const StandingErrors& influence,
                    PointingQuantity quantity, const std::vector<double>& typical = {});
  // Relative to an index of this size; 1 where that vanishes.
  double error(const std::vector<double>& errors, double index) const;

 private:
  std::vector<double> size_;  // s_e; 0 of errors that the mechanism does not take up
  double curvature_ = 0.0;    // [m or rad]
};

}  // namespace boresight
