// What closes the loops that the spanning tree leaves open: the rows of the cut joints, in joint coordinates.
//
// Their rows are those of JointConstraint, the same as in the paper's formulation: J v = ..., v the velocities of two
// bodies. In the free speeds, J becomes G, nonzero only for the speeds on the two bodies' paths below their nearest common
// one: speeds that move both bodies alike do not change a joint between them. With H = L^T L and Z = G L^-1 the multipliers
// follow from
//   (Z Z^T) lambda = Z x - d,     x <- x - Z^T lambda          so that Z x = d, x being changed as little as possible.
// This one step serves three ends: x = L^-T tau and d = gamma' give L udot, hence the accelerations; x = 0 and d = -(value of
// the rows) gives L times the correction of least kinetic energy that closes the loops; and a unit force on the journal with
// d = 0 its compliance.
// Sources: Featherstone (2008), Rigid Body Dynamics Algorithms, section 8.3 to 8.5 and 8.12 (loop joints, their sparsity).
#pragma once

#include <vector>

#include "boresight/formulations/tree_cholesky.hpp"
#include "boresight/formulations/tree_kinematics.hpp"
#include "boresight/math/block_cholesky.hpp"
#include "boresight/mechanism/joint_rows.hpp"

namespace boresight {

// The rows of one joint.
class LoopRows {
 public:
  LoopRows(const Mechanism& mechanism, const SpanningTree& tree, int joint, ClearanceRows clearance, bool with_drive);

  const JointConstraint& constraint() const { return constraint_; }
  int count() const { return constraint_.count(); }
  // All free speeds on the paths of its bodies from the ground, largest first: where G L^-1 may be nonzero.
  const std::vector<int>& support() const { return support_; }

  void evaluate(const std::vector<BodyMotion>& bodies, const std::vector<TimeValue>& laws) {
    constraint_.evaluate(bodies, laws[constraint_.joint()], rows_);
  }
  const JointRows& rows() const { return rows_; }
  // G, one column per free speed; columns outside the support are left alone.
  void jacobian(const TreeKinematics& kinematics, std::vector<Vec6>& G) const;
  // What the rows of J make of the bodies' bias accelerations: J vdot = G udot + this.
  Vec6 bias(const TreeKinematics& kinematics) const;

 private:
  JointConstraint constraint_;
  JointRows rows_;
  std::vector<int> support_, common_, reference_only_, other_only_;
};

// All of them.
class LoopClosure {
 public:
  LoopClosure(const Mechanism& mechanism, const SpanningTree& tree, const std::vector<MassProperties>& mass,
              bool with_clearance);

  int blocks() const { return static_cast<int>(blocks_.size()); }
  const LoopRows& block(int k) const { return blocks_[k]; }
  // One Vec6 per block; entries beyond a block's count are ignored.
  std::vector<Vec6> block_vector() const { return std::vector<Vec6>(blocks_.size(), Vec6::Zero()); }
  // Tells that rows depend on each other; they are then regularised and the solution refined, as in ConstraintSystem.
  void set_redundant(bool redundant) { redundant_ = redundant; }

  void evaluate(const std::vector<BodyMotion>& bodies, const std::vector<TimeValue>& laws);
  // Largest |value| of the rows of the last evaluate() [m or rad]; with lengths in units of `length`.
  double violation() const;
  double violation(double length) const;
  // Z and the factors of Z Z^T, at the pose of the last evaluate(). false if rows depend on each other.
  bool factor(const TreeKinematics& kinematics, const BranchCholesky& H);
  // x <- x - Z^T (Z Z^T)^-1 (Z x - d); d is overwritten by the multipliers.
  void constrain(std::vector<Vec6>& d, VecX& x);

 private:
  struct BlockCoupling {  // two blocks that share speeds
    int row, column;
    std::vector<int> speeds;
  };
  void multiply(const VecX& x, std::vector<Vec6>& Zx) const;
  void subtract_transposed(const std::vector<Vec6>& lambda, VecX& x) const;
  void solve(std::vector<Vec6>& lambda);
  void regularise(int block, Mat6& diagonal) const;

  std::vector<LoopRows> blocks_;
  std::vector<std::vector<Vec6>> Z_;  // per block, one column per speed
  std::vector<BlockCoupling> couplings_;
  BlockCholesky cholesky_;
  bool redundant_ = false;
  std::vector<Vec6> mobility_;  // per body: 1 / mass and 1 / mean moment of inertia, each thrice
  std::vector<Vec6> right_, residual_;
  VecX motion_;
};

}  // namespace boresight
