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

namespace boresight {

class ErrorInfluence {
 public:
  // commanded: of this drawn mechanism; both outlive this.
  ErrorInfluence(const Mechanism& mechanism, const IdealMotion& commanded);

  int count() const { return static_cast<int>(frames_.size()); }
  // Displacement and turn of each body per unit of each error at t, world axes: 6 bodies x errors. Only errors in `wanted` (all if empty)
  // are computed, the other columns are zero. Throws ComputationError, with the names of error and joint, where an error strains an
  // overconstrained mechanism, and where freedoms are left that nothing drives.
  void at(double t, const std::vector<bool>& wanted, MatX& G);

 private:
  void right_side(std::size_t error, double t);
  void solve_dense(const std::vector<bool>& wanted, double t, MatX& G);

  const Mechanism& mechanism_;
  const IdealMotion& commanded_;
  ConstraintSystem closed_;
  std::vector<Mat6> weight_;
  VecX scale_;                                   // kinematic weight of the stacked velocities
  std::vector<std::vector<FrameError>> frames_;  // per error
  std::vector<int> block_of_;                    // of a joint; -1: it has no rows
  IdealState state_;
  std::vector<TimeValue> laws_;
  std::vector<Vec6> right_, goal_, motion_, residual_, more_;
};

}  // namespace boresight
