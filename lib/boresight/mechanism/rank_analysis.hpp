// Rank of a mechanism's constraint rows at a pose, and the motion that they resist least.
//
// The Jacobian is scaled first: velocities in units of the characteristic length a second, distance rows divided by that
// length, so that its singular values are pure numbers of order one for a healthy mechanism.
#pragma once

#include <string>

#include "boresight/mechanism/constraint_system.hpp"

namespace boresight {

struct RankAnalysis {
  int rows = 0, columns = 0, rank = 0;
  double largest = 0.0;  // largest singular value
  double weakest = 0.0;  // the columns-th largest one: 0 means that some motion is free
  VecX least_resisted;   // the motion of all bodies that belongs to it: (v, w) stacked, unit norm after scaling
};

// Rows of one joint against the stacked velocities of all bodies.
MatX stacked_rows(const JointConstraint& constraint, const std::vector<BodyMotion>& bodies);
// Such rows, scaled as above.
MatX scaled_rows(MatX J, double length);

// Singular values below this share of the largest count as zero.
inline constexpr double kRankTolerance = 1e-8;

// `evaluated`: a system on which evaluate() was called at the pose.
RankAnalysis analyse_rank(const Mechanism& mechanism, const ConstraintSystem& evaluated, bool with_motion = true);

// The rank alone, the same number: for a small part of the time, wherever bounds decide it.
int constraint_rank(const Mechanism& mechanism, const ConstraintSystem& evaluated);

// The singular values, falling, of the rows of those groups of coupled bodies whose joints close loops: the rows of the others, of trees,
// hold the same motions everywhere. None where no joint closes a loop.
VecX singular_values_of_loops(const Mechanism& mechanism, const ConstraintSystem& evaluated);

// "turns about (0, 0, 1)", "moves along (1, 0, 0)" or both: one body's part of a stacked motion, world axes.
std::string describe_motion(const Mechanism& mechanism, const VecX& motion, int body);

}  // namespace boresight
