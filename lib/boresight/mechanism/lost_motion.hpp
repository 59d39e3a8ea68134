// Singular poses of an ideal motion: its rows lose rank there, some motion of the bodies is locked by nothing, and a loop may go on in more
// ways than one.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "boresight/mechanism/constraint_system.hpp"

namespace boresight {

class IdealMotion;

struct LostMotion {
  double t = 0.0;           // [s]
  std::string description;  // "platform turns about (0, 0, 1) while every drive stands still"
  double measure = 0.0;     // smallest singular value over the largest, lengths scaled; 0 at the singularity
};

// Below this share of the largest singular value a pose is called singular: locks that weak are moved by play and
// elasticity by more than they hold.
inline constexpr double kSingular = 1e-6;

// How well the rows hold one freedom of the bodies after another, redundant or not: the least of them is zero where the smallest singular value is,
// for a small part of the time of singular values. `evaluated`: a system on which evaluate() was called at the pose.
VecX locks(const Mechanism& mechanism, const ConstraintSystem& evaluated);
double weakest_lock(const Mechanism& mechanism, const ConstraintSystem& evaluated);

// Whether a lock may fall to zero beside a time at which it is looked at, seen before and after it too; and the time from t0 to t1 at which it
// is weakest, by the golden section.
bool may_be_zero_near(double here, double before, double after);
double weakest_between(double t0, double t1, const std::function<double(double)>& lock);

// The motion that the rows resist least. with_pose: the prescribed pose of a body is among what holds it.
LostMotion lost_motion(const Mechanism& mechanism, const ConstraintSystem& evaluated, double t, bool with_pose);

// Those that a motion by kinematics passes or begins or ends at, wherever they lie between its states.
std::vector<LostMotion> lost_motions(const Mechanism& mechanism, const IdealMotion& motion);

}  // namespace boresight
