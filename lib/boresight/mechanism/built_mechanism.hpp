// The mechanism as it is built: the drawn one with its standing errors (ErrorDescription).
//
// The drives are told what the drawn mechanism needs: its laws, or what inverse kinematics of the drawn geometry gives for a prescribed
// pose. With D the displacement of a joint's frame in one of its bodies (a turn about the joint's point, then a translation, both along
// world axes at home), X a body's displacement from home and J the joint's, a joint between bodies a and b closes as
//
//     X_a D_a J(q) = X_b D_b,      q = q_commanded(t) + sum of value * law(q_commanded, t) on a drive.
//
// Several turns of one frame add up as rotation vectors. A bearing pair is displaced as the one joint that it was drawn as: both of its bearings,
// turned about the point between them, so that they stay in line. What grows moves its joint frames away from its centre of mass, or on the
// ground from the middle of its joints, of which a pair is one.
#pragma once

#include <memory>
#include <vector>

#include "boresight/mechanism/ideal_motion.hpp"
#include "boresight/mechanism/mechanism.hpp"

namespace boresight {

// A joint's frame is displaced by this in one of its bodies, per unit of an error; world axes at home.
struct FrameError {
  int joint = 0;
  bool second = false;              // in the joint's second body, else in its first
  Vec3 translation = Vec3::Zero();  // [m per unit]
  Vec3 rotation = Vec3::Zero();     // through the joint's point, which the frame stands `arm` off [rad per unit]
  Vec3 arm = Vec3::Zero();          // [m]; none but in a bearing pair

  // What a small turn and the translation displace the frame by.
  Vec3 displacement() const { return translation + rotation.cross(arm); }
};

// What one error displaces; nothing for one of a drive.
std::vector<FrameError> frame_errors(const MechanismDescription& mechanism, const ErrorDescription& error);

// Whether any error of this sample is not zero.
bool has_errors(const Parameters& parameters);

// commanded: the motion of the drawn mechanism, which says where drives are told to stand.
std::shared_ptr<const Mechanism> built_mechanism(const Mechanism& drawn, const Parameters& parameters,
                                                 std::shared_ptr<const IdealMotion> commanded);

}  // namespace boresight
