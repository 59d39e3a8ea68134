// What the standing errors do to the bodies' poses, to first order: columns of influence.
//
// The rows of a joint see an error of its frame in a body as they see that body moved: with x the displacement of the frame,
//
//     J u = -J_body x   on the rows of that joint,    J u = law(q, t)   on the row of a drive,
//
// all joints closed, drives held where they are commanded. Source: Chase, Gao and Magleby (1995), General 2-D tolerance analysis of mechanical
// assemblies, Journal of Design and Manufacturing 5, 263-274, whose direct linearisation this is in space; held against the exact
// closure of the built mechanism in a test.
#pragma once

#include <optional>

#include "boresight/mechanism/built_mechanism.hpp"
#include "boresight/mechanism/constraint_system.hpp"
#include "boresight/mechanism/offset_choice.hpp"

namespace boresight {

class ErrorInfluence {
 public:
  // commanded: of this drawn mechanism; both outlive this.
  ErrorInfluence(const Mechanism& mechanism, const IdealMotion& commanded);

  int count() const { return static_cast<int>(frames_.size()); }
  // Whether redundant joints with play may take up errors: their offsets that follow from others are then shifted.
  bool shifts() const { return mechanism_.offset_choice() != nullptr; }
  const OffsetLayout& offsets() const { return offsets_; }
  // By how much, per unit of each error, at the time of the last at(): offsets x errors, of OffsetLayout; zero where an offset is a
  // coordinate.
  const MatX& shift() const { return shift_; }

  // Displacement and turn of each body per unit of each error at t, world axes, all coordinates of the play held at zero: 6 bodies x errors.
  // Only errors in `wanted` (all if empty) are computed, the other columns are zero. Throws ComputationError, with the names of error and joint, where an error strains an
  // overconstrained mechanism, and where freedoms are left that nothing drives.
  void at(double t, const std::vector<bool>& wanted, MatX& G);

 private:
  // What the rows of a joint change by for an error, the bodies held.
  Vec6 seen(const JointConstraint& constraint, const JointRows& rows, std::size_t error) const;
  void right_side(std::size_t error, double t);
  void add_shift(std::size_t error, const MatX& G);
  void drop_rounding(int error, MatX& G) const;
  void solve_dense(const std::vector<bool>& wanted, double t, MatX& G);

  std::shared_ptr<const Mechanism> held_;  // the drawn mechanism as one that is built, without errors
  const Mechanism& mechanism_;
  const IdealMotion& commanded_;
  ConstraintSystem closed_;
  bool rows_tell_motion_ = false;  // as many closed rows as the bodies have freedoms, and independent
  std::vector<Mat6> weight_;
  VecX scale_;  // kinematic weight of the stacked velocities
  OffsetLayout offsets_;
  std::vector<JointConstraint> released_;  // per clearance
  std::vector<JointRows> released_rows_;
  MatX shift_;
  std::vector<std::vector<FrameError>> frames_;  // per error
  std::vector<int> block_of_;                    // of a joint; -1: it has no rows
  IdealState state_;
  std::vector<TimeValue> laws_;
  double asked_ = 0.0;  // by the right side of joint and drive, in turns or lengths of the mechanism's size
  std::vector<Vec6> right_, goal_, motion_, residual_, more_;
};

}  // namespace boresight
