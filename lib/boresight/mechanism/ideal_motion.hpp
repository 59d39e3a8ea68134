// The motion of the mechanism without clearance: every body's pose, velocity and acceleration over time, and the drives'.
//
// Drives given as laws: positions by Newton, warm-started along the motion (continuation); velocities and accelerations
// exactly, by solving the differentiated constraints. A body's pose given instead: the same solve with the pose's rows in
// place of the drives' rows, and the drives' laws read off the result. Both are solved at uniform knots, dense enough that
// quintic interpolation (which meets value, rate and acceleration at the knots) is exact to about 1e-12 of the lengths.
//
// A mechanism with freedoms that nothing drives has no ideal motion by kinematics alone: kinematic() then throws, and the
// motion is simulated without clearance instead and handed to the other constructor, with knots wherever its steps ended.
#pragma once

#include <vector>

#include "boresight/math/quintic_spline.hpp"
#include "boresight/mechanism/ideal_solver.hpp"
#include "boresight/mechanism/lost_motion.hpp"
#include "boresight/mechanism/mechanism.hpp"

namespace boresight {

class IdealMotion {
 public:
  // Throws ComputationError, naming the time and what is lost, where the motion cannot be followed; InputError where a drive's error has
  // no course along the drive that a prescribed pose makes of it.
  static IdealMotion kinematic(const Mechanism& mechanism);

  // From states at increasing times, first to last (a simulation without clearance). error: see error(). laws: of the
  // mechanism's driven joints.
  IdealMotion(const Mechanism& mechanism, const std::vector<IdealState>& knots, double error = 0.0);

  double duration() const { return duration_; }
  int knots() const { return knots_; }
  // What the motion is wrong by, as far as its making could see: in characteristic lengths and radians.
  double error() const { return error_; }
  static constexpr double kAccuracy = 1e-9;  // that it is sought with; the kinematic one with a thousandth of it

  // The singular poses that it passes, known of motions by kinematics of mechanisms as drawn.
  const std::vector<LostMotion>& lost() const { return lost_; }

  // Laws of all joints at t (zero where not driven); `laws` must have one entry per joint.
  void drive_laws(double t, std::vector<TimeValue>& laws) const;
  // Of one of them.
  TimeValue drive_law(double t, int joint) const;
  // One body's motion; acceleration may be null.
  BodyMotion body(double t, int body, BodyAcceleration* acceleration = nullptr) const;
  void state(double t, IdealState& state) const;

 private:
  IdealMotion(const Mechanism& mechanism, const std::vector<IdealState>& knots, double error, bool read_drives);
  void fit(const Mechanism& mechanism, const std::vector<IdealState>& knots, bool read_drives);

  double duration_ = 0.0, error_ = 0.0;
  int knots_ = 0, bodies_ = 0;
  std::vector<LostMotion> lost_;
  QuinticSpline bodies_spline_;  // 7 numbers a body: p_WB, then the quaternion w x y z
  std::vector<int> driven_;
  QuinticSpline drive_spline_;              // of driven_ where laws were read off a prescribed pose
  std::vector<TimeFunctionPtr> drive_law_;  // of driven_ where they were given
};

}  // namespace boresight
