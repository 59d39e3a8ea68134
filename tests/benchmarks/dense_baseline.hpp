// The paper's method as a first program would have it: all 78 coordinates and 75 rows in dense matrices, nothing of their
// structure used. Small and plain on purpose: the baseline that the rungs' speed is measured against.
//   [M Phi^T; Phi 0] [vdot; lambda] = [Q; gamma']   by way of   (Phi M^-1 Phi^T) lambda = Phi M^-1 Q - gamma'
#pragma once

#include <Eigen/Cholesky>
#include <Eigen/LU>

#include "boresight/formulations/formulation.hpp"
#include "boresight/mechanism/constraint_system.hpp"

namespace boresight::benchmarks {

class DenseBaseline {
 public:
  DenseBaseline(const Mechanism& mechanism, const Parameters& parameters, const IdealMotion& ideal)
      : mechanism_(mechanism),
        ideal_(ideal),
        mass_(mechanism.mass_properties(parameters)),
        gravity_(parameters.gravity),
        constraints_(mechanism, {.clearance = ClearanceRows::open}),
        forces_(mechanism, parameters, true),
        laws_(mechanism.joints()),
        memory_(mechanism.clearances()) {}

  // Accelerations of all bodies, stacked; payload at the body's own centre of mass (as in the default scene).
  VecX acceleration(double t, const std::vector<BodyMotion>& bodies) {
    const int n = 6 * mechanism_.bodies();
    MatX M = MatX::Zero(n, n);
    VecX Q = VecX::Zero(n);
    std::vector<Vec6> wrench(mechanism_.bodies(), Vec6::Zero());
    forces_.apply(t, bodies, memory_, wrench);
    for (int b = 0; b < mechanism_.bodies(); ++b) {
      const Mat3 I = bodies[b].R * mass_[b].inertia * bodies[b].R.transpose();
      M.block<3, 3>(6 * b, 6 * b) = mass_[b].mass * Mat3::Identity();
      M.block<3, 3>(6 * b + 3, 6 * b + 3) = I;
      Q.segment<6>(6 * b) = wrench[b];
      Q.segment<3>(6 * b) += mass_[b].mass * gravity_;
      Q.segment<3>(6 * b + 3) -= bodies[b].w.cross(I * bodies[b].w);
    }
    ideal_.drive_laws(t, laws_);
    constraints_.evaluate(bodies, laws_);
    const MatX Phi = constraints_.dense_jacobian();
    VecX gamma(Phi.rows());
    int row = 0;
    for (int k = 0; k < constraints_.blocks(); ++k)
      for (int i = 0; i < constraints_.joints()[k].count(); ++i) {
        const JointRows& rows = constraints_.rows(k);
        gamma[row++] = rows.gamma[i] - 80.0 * rows.rate[i] - 2500.0 * rows.value[i];
      }
    const Eigen::PartialPivLU<MatX> lu(M);
    const MatX MinvPhiT = lu.solve(Phi.transpose());
    const VecX free = lu.solve(Q);
    const VecX lambda = (Phi * MinvPhiT).ldlt().solve(Phi * free - gamma);
    return free - MinvPhiT * lambda;
  }

 private:
  const Mechanism& mechanism_;
  const IdealMotion& ideal_;
  std::vector<MassProperties> mass_;
  Vec3 gravity_;
  ConstraintSystem constraints_;
  ForceElements forces_;
  std::vector<TimeValue> laws_;
  std::vector<ContactMemory> memory_;
};

}  // namespace boresight::benchmarks
