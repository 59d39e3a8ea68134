// A pose in which the constraints lose rank, so that the equations of motion have no unique solution: the error that names the
// time and the motion that nothing resists any more. Rows that depend on each other all along the motion are none: they are
// redundant, and harmless.
#pragma once

#include "boresight/mechanism/constraint_system.hpp"
#include "boresight/mechanism/error.hpp"
#include "boresight/mechanism/ideal_motion.hpp"

namespace boresight {

class SingularPose : public ComputationError {
 public:
  // rows: all constraint rows, evaluated in that pose; t [s].
  SingularPose(const Mechanism& mechanism, const ConstraintSystem& rows, double t);
  double t = 0.0;
};

// Whether rows depend on each other at a state of the motion, and so everywhere (generic_instant.hpp). Throws SingularPose
// where they do at this state only. drives: the motion; none where nothing is driven, and then what depends is redundant.
bool rows_are_redundant(const Mechanism& mechanism, const IdealMotion* drives, ClearanceRows clearance,
                        const IdealState& here);

}  // namespace boresight
