// All constraint rows of a mechanism at one instant, and the solves with J W J^T that everything else is made of.
//
// With u the stacked velocities (v, w) of the bodies, J u = law's rate. For a symmetric positive definite block-diagonal W
// (inverse masses, or a kinematic weight) and right-hand side b the smallest u in the norm W^-1 with J u = b is
//     u = W J^T lambda,   (J W J^T) lambda = b.
// With W = M^-1 the same solve gives the multipliers of the paper's Eq. 41, the mass-orthogonal projection onto the
// constraints, and (kinematic W) Newton's step for assembling a pose. J W J^T has one 6 x 6 block row per joint.
//
// Redundant rows (planar loops in space, Bricard) make J W J^T singular but consistent: it is then regularised by
// 1e-10 of its diagonal and the solution refined until it satisfies the unregularised rows.
#pragma once

#include <vector>

#include "boresight/math/block_cholesky.hpp"
#include "boresight/mechanism/joint_rows.hpp"

namespace boresight {

// A body's pose given from outside, with its derivatives: six more rows on that body.
struct PrescribedPose {
  Vec3 p = Vec3::Zero();
  Mat3 R = Mat3::Identity();
  Vec3 v = Vec3::Zero(), w = Vec3::Zero(), a = Vec3::Zero(), alpha = Vec3::Zero();
};

class ConstraintSystem {
 public:
  struct Rows {
    ClearanceRows clearance = ClearanceRows::closed;
    bool drives = true;
    int prescribed_body = kGround;  // its pose is given: see pose()
  };

  ConstraintSystem(const Mechanism& mechanism, Rows rows);

  int bodies() const { return bodies_; }
  int blocks() const { return static_cast<int>(rows_.size()); }
  int row_count() const { return row_count_; }
  const std::vector<JointConstraint>& joints() const { return joints_; }
  const JointRows& rows(int block) const { return rows_[block]; }
  PrescribedPose& pose() { return pose_; }  // set before evaluate()

  // Tells that rows depend on each other (found by rank analysis); see above.
  void set_redundant(bool redundant) { redundant_ = redundant; }
  bool redundant() const { return redundant_; }

  // laws: one per joint of the mechanism, used where it is driven.
  void evaluate(const std::vector<BodyMotion>& bodies, const std::vector<TimeValue>& laws);
  // Factors J W J^T. false if rows depend on each other (never, if set_redundant).
  bool factor(const std::vector<Mat6>& W);
  // Smallest pivot of the last factor() relative to its diagonal, and the joint it belongs to.
  double smallest_pivot_ratio() const { return cholesky_.smallest_pivot_ratio(); }

  // The stacks below have one Vec6 per block (rows beyond a joint's count are ignored), or one per body.
  void solve(std::vector<Vec6>& lambda) const;                                            // (J W J^T)^-1, in place
  void multiply(const std::vector<Vec6>& u, std::vector<Vec6>& Ju) const;                 // J u
  void multiply_transposed(const std::vector<Vec6>& lambda, std::vector<Vec6>& u) const;  // J^T lambda
  // u = W J^T (J W J^T)^-1 b: b is overwritten by lambda.
  void least_motion(std::vector<Vec6>& b, std::vector<Vec6>& u) const;

  // Largest |value| over all rows [m or rad].
  double violation() const;
  // The same with lengths in units of `length`: a pure number, whatever the mechanism's size.
  double violation(double length) const;
  MatX dense_jacobian() const;  // row_count x 6 bodies

  std::vector<Vec6> block_vector() const { return std::vector<Vec6>(rows_.size(), Vec6::Zero()); }
  std::vector<Vec6> body_vector() const { return std::vector<Vec6>(bodies_, Vec6::Zero()); }

 private:
  struct BlockCoupling {  // two blocks that share a body
    int pair, row, column, body;
    bool row_other, column_other;  // the body is the "other" one of that block
  };
  int rows_in(int block) const;

  int bodies_ = 0, row_count_ = 0;
  std::vector<JointConstraint> joints_;
  int prescribed_ = kGround;
  PrescribedPose pose_;
  std::vector<JointRows> rows_;
  std::vector<BlockCoupling> couplings_;
  BlockCholesky cholesky_;
  bool redundant_ = false;
  std::vector<Mat6> W_, JW_reference_, JW_other_;
  mutable std::vector<Vec6> residual_, work_blocks_, work_bodies_;
};

}  // namespace boresight
