// Baumgarte's stabilisation: constraints that have opened close again like a damped oscillator,
//
//   Phi'' + 2 alpha Phi' + beta^2 Phi = 0,    so  gamma' = gamma - 2 alpha Phi' - beta^2 Phi.
//
// Source: Baumgarte (1972), Computer Methods in Applied Mechanics and Engineering 1, 1-16; Sun et al., Eq. 43, with alpha = 40
// and beta = 50 1/s. Zero gains leave gamma as it is.
#pragma once

#include "boresight/mechanism/joint_rows.hpp"

namespace boresight {

struct BaumgarteStabilisation {
  double alpha = 0.0, beta = 0.0;  // gains [1/s]

  // gamma' of a joint's rows [m/s^2, rad/s^2]; gamma: theirs, or less what the bodies' bias accelerations make of it.
  Vec6 gamma_of(const Vec6& gamma, const JointRows& rows) const {
    return gamma - 2.0 * alpha * rows.rate - beta * beta * rows.value;
  }
};

}  // namespace boresight
