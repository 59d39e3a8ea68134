// What a kind of play is made of; journal/, ball/, pad/ and guide/ are kinds, and kinds.hpp lists them all. A kind K is two types of one shape.
//
// KT<T>, the contacts as templates on the scalar T of what a sample varies (double, lanes, jets):
//   static bool serves(description, JointType)       whether this kind is the play of such a joint
//   static words()                                   PlayWords: what its parts are called
//   penetrations(motion, contact)                    how deep each place is, without its force
//   wrench(motion, impact_speed, traction, out)      traction: the friction of contact_friction.hpp
//   keep_only(touching)                              what does not touch is out of reach: it gives no force even in a trial step
//   numbers()                                        std::array<T*, n>, n <= kMostContactNumbers: what parameters change
//   take_shape_of(other)                             what they do not change, from the same kind of another scalar
//   complete()                                       after its numbers were set
//   friction                                         FrictionLawT<T>
//
// K, KT<double> with what is asked of a joint and not of every lane:
//   K(description, joint type, parameters)
//   places()                        the contacts it can have
//   inputs()                        which numbers of the motion its wrench hangs on, one of
//   kInputs                         those that such a kind may hang on
//   elastic_energy(motion)          of all contacts [J]
//   elastic_only()                  the same without what dissipates and rubs
//   tangent(motion)                 ContactTangent
//   rest_under(load, joint, before) RestingPlay; joint: JointCoordinates
//   gap_parts(rest, joint)          std::vector<GapPart>
//   clearances()                    the gaps that limit it, each way [m]
//   widths(other)                   of each offset, the clearance that it crosses; `other` where that is zero
//   lever()                         a slope times it is a displacement [m]
//   size()                          radius of the seat: a penetration of its order is none [m]
//   normal_law()                    of the contact that carries the loads across its axis
//   axial_stiffness()               of the contact that carries them along it [N/m]; 0 where there is none
//   pushed_together()               OffsetGroups: which offsets no shape of the seat tells apart
//   root_stiffness(load)            per offset, the root of the tangent stiffness under twice the load [N]
#pragma once

#include "boresight/contact/contact_friction.hpp"
#include "boresight/contact/normal_law.hpp"
#include "boresight/mechanism/description.hpp"
#include "boresight/play/contact_tangent.hpp"
#include "boresight/play/gap_part.hpp"
#include "boresight/play/play_words.hpp"
#include "boresight/play/resting_play.hpp"

namespace boresight {

inline constexpr int kMostContactNumbers = 26;

// Which numbers of a PlayMotion a wrench hangs on: of an insert that keeps parallel (e, e_dot, its spin about the axis), of a ball
// (e, e_dot, w), of one that tilts (all but roll and twist), of one that tilts and rolls (all but the twist), of one whose contacts turn with it (all
// but the roll).
enum class MotionInputs { parallel, turning, tilting, rolling, twisting };

inline constexpr double kOutOfReach = 1e6;  // [m]

}  // namespace boresight
