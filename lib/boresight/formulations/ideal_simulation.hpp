// The ideal motion of any mechanism: by kinematics where everything is driven, else simulated without clearance from its
// starting rates, until two runs agree to IdealMotion::kAccuracy: RK4 with the step halved, or, where springs and dampers are
// so stiff that stability asks for more steps than the motion does, RODAS4 with the tolerance tightened. What the two differ by
// in the end is the motion's error().
#pragma once

#include <memory>
#include <string>

#include "boresight/mechanism/ideal_motion.hpp"

namespace boresight {

// How many freedoms of the mechanism without clearance nothing drives, at home.
int undriven_freedoms(const Mechanism& mechanism);

// Whether everything is driven, so that no parameter changes the ideal motion.
bool is_kinematic(const Mechanism& mechanism);

// Throws ComputationError where the motion cannot be followed.
IdealMotion ideal_motion(const Mechanism& mechanism, const Parameters& parameters);

// Steps of a simulation at most: all are held in memory.
struct SimulationSize {
  int explicit_steps = 1 << 19;
  long implicit_steps = 200'000;
};

// The same where freedoms are left that nothing drives. Throws ComputationError too where one run alone comes to its end: nothing tells then
// what it is wrong by.
IdealMotion simulated_motion(const Mechanism& mechanism, const Parameters& parameters, const SimulationSize& most = {});

// For a result's warnings: that the drawn mechanism's motion, or the built one's by its error(), is not known as well as it was sought; or that
// it passes singular poses. Empty where neither is so.
std::string doubt_of(const IdealMotion& drawn, double error_of_built = 0.0);

// A sample's mechanism as it is built, and its motion without clearance.
struct BuiltMotion {
  std::shared_ptr<const Mechanism> mechanism;
  std::shared_ptr<const IdealMotion> motion;
};

// The drawn mechanism and its commanded motion themselves where the sample has no errors. Throws ComputationError where the built
// mechanism's joints do not close.
BuiltMotion built_motion(std::shared_ptr<const Mechanism> drawn, std::shared_ptr<const IdealMotion> commanded,
                         const Parameters& parameters);

}  // namespace boresight
