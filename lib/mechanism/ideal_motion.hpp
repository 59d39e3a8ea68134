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
#include "boresight/mechanism/body_motion.hpp"
#include "boresight/mechanism/constraint_system.hpp"
#include "boresight/mechanism/mechanism.hpp"

namespace boresight {

// All bodies at one instant of the ideal motion.
struct IdealState {
  double t = 0.0;
  std::vector<BodyMotion> bodies;
  std::vector<BodyAcceleration> acceleration;
};

class IdealMotion {
 public:
  // Throws ComputationError, naming the time and what is lost, where the motion cannot be followed.
  static IdealMotion kinematic(const Mechanism& mechanism);

  // From states at increasing times, first to last (a simulation without clearance). error: see error(). laws: of the
  // mechanism's driven joints.
  IdealMotion(const Mechanism& mechanism, const std::vector<IdealState>& knots, double error = 0.0);

  double duration() const { return duration_; }
  int knots() const { return knots_; }
  // What the motion is wrong by, as far as its making could see: in characteristic lengths and radians.
  double error() const { return error_; }
  static constexpr double kAccuracy = 1e-9;  // that it is sought with; the kinematic one with a thousandth of it

  // Laws of all joints at t (zero where not driven); `laws` must have one entry per joint.
  void drive_laws(double t, std::vector<TimeValue>& laws) const;
  // One body's motion; acceleration may be null.
  BodyMotion body(double t, int body, BodyAcceleration* acceleration = nullptr) const;
  void state(double t, IdealState& state) const;

 private:
  IdealMotion(const Mechanism& mechanism, const std::vector<IdealState>& knots, double error, bool read_drives);
  void fit(const Mechanism& mechanism, const std::vector<IdealState>& knots, bool read_drives);

  double duration_ = 0.0, error_ = 0.0;
  int knots_ = 0, bodies_ = 0;
  QuinticSpline bodies_spline_;  // 7 numbers a body: p_WB, then the quaternion w x y z
  std::vector<int> driven_;
  QuinticSpline drive_spline_;             // of driven_ where laws were read off a prescribed pose
  std::vector<TimeFunctionPtr> drive_law_;  // of driven_ where they were given
};

// The prescribed pose of a motion at t, with exact derivatives.
PrescribedPose prescribed_pose(const MechanismDescription& mechanism, double t);

// Weight for kinematic solves: displacements in units of the characteristic length count like angles.
std::vector<Mat6> kinematic_weight(const Mechanism& mechanism);

// Solves one instant exactly, starting from `state`'s bodies as a guess. rows: as the mechanism's motion asks.
// Returns false if Newton does not converge to 1e-13 of the characteristic length.
class IdealSolver {
 public:
  explicit IdealSolver(const Mechanism& mechanism);
  // The assembly pose at t = 0 is searched from home by continuation of the prescribed pose or drives.
  void start(IdealState& state);
  bool solve(double t, IdealState& state);
  // Of the last solve: smallest pivot ratio of J W J^T.
  double smallest_pivot_ratio() const { return system_.smallest_pivot_ratio(); }
  const ConstraintSystem& system() const { return system_; }

 private:
  void laws_at(double t, double scale);
  bool newton(IdealState& state);
  bool differentiate(IdealState& state);

  const Mechanism& mechanism_;
  ConstraintSystem system_;
  std::vector<Mat6> weight_;
  std::vector<TimeValue> laws_;
  std::vector<Vec6> blocks_, motion_;
};

}  // namespace boresight
