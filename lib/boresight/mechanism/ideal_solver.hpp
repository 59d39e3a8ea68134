// One instant of the ideal motion, solved exactly: positions by Newton's method, velocities and accelerations from the
// differentiated constraints.
#pragma once

#include <vector>

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
  bool factor();
  bool newton(IdealState& state);
  bool differentiate(IdealState& state);
  bool open_chain() const;
  bool reach_start(IdealState& state);

  const Mechanism& mechanism_;
  ConstraintSystem system_;
  std::vector<Mat6> weight_;
  std::vector<TimeValue> laws_;
  std::vector<Vec6> blocks_, motion_;
  double largest_correction_;  // [characteristic length or rad]
};

}  // namespace boresight
