// Mass matrix and force in joint coordinates: H udot = tau + (reactions of the cut joints).
//
//   H_ij = S_i^T I_i S_j    I_i: inertia of all bodies that speed i carries, as one rigid body; j: on i's path to the ground
//   tau_i = -S_i^T f_i      f_i: what it takes to give those bodies their bias accelerations, less the forces on them
//
// with S_k = (a_k, m_k) as in TreeKinematics. Inertias and wrenches about that class's point O simply add up on the way in.
// Source: Featherstone (2008), Rigid Body Dynamics Algorithms: composite rigid bodies, section 6.2; recursive Newton-Euler,
// section 5.3.
#pragma once

#include <vector>

#include "boresight/formulations/tree_cholesky.hpp"
#include "boresight/formulations/tree_kinematics.hpp"
#include "boresight/mechanism/mechanism.hpp"

namespace boresight {

class JointSpaceInertia {
 public:
  JointSpaceInertia(const SpanningTree& tree, std::vector<MassProperties> mass, const Vec3& gravity);

  // applied: per body, force and moment about its own centre of mass, world axes, without gravity.
  void evaluate(const TreeKinematics& kinematics, const std::vector<Vec6>& applied);
  // Of the last evaluate().
  const VecX& force() const { return force_; }                  // tau [N or N m]
  const BranchCholesky& cholesky() const { return cholesky_; }  // of H

  // Kinetic plus potential energy in the field of gravity [J].
  double energy(const std::vector<BodyMotion>& bodies) const;

 private:
  // About O, world axes.
  struct Carried {
    double mass = 0.0;
    Vec3 first_moment = Vec3::Zero();
    Mat3 inertia = Mat3::Zero();
    Vec3 force = Vec3::Zero(), moment = Vec3::Zero();
  };
  void single_body(int body, const TreeKinematics& kinematics, const Vec6& applied);

  const SpanningTree& tree_;
  std::vector<MassProperties> mass_;
  Vec3 gravity_;
  std::vector<Carried> carried_;  // per body: itself and all that it carries
  BranchCholesky cholesky_;
  VecX force_;
};

}  // namespace boresight
