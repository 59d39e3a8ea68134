// A pose in which the constraints lose rank, so that the equations of motion have no unique solution: the error that names the
// time and the motion that nothing resists any more.
#pragma once

#include "boresight/mechanism/constraint_system.hpp"
#include "boresight/mechanism/error.hpp"

namespace boresight {

class SingularPose : public ComputationError {
 public:
  // rows: all constraint rows, evaluated in that pose; t [s].
  SingularPose(const Mechanism& mechanism, const ConstraintSystem& rows, double t);
  double t = 0.0;
};

}  // namespace boresight
