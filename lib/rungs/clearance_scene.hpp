// The mechanism opened at its clearance joints, as smooth functions of time: what the cheap rungs compute with.
//
// Clearances are 1e-3 to 1e-4 of the link lengths, so the motion is the ideal one plus a deviation that is linear in the
// joints' offsets xi (three a revolute, two a cylindrical joint; sleeve axes). With J the square Jacobian of all ideal rows,
// T = J^-1 restricted to the released rows gives the velocities of all bodies per unit offset rate, and
//
//     M_r(t) xiddot + C(t) xidot = r(t) + f_contact(xi, xidot, w_rel),    pose error of the boresight body = E(t) xi
//
//   M_r = T^T M T      C = T^T [M (2 Tdot - w x T) + gyroscopic]      r = T^T (Q - M vdot_ideal)      E = T's rows
//
// 2 Tdot is the Coriolis part (the offsets ride on moving bodies); - w x T stands in the turning rows only: with
// R = exp(theta) R_ideal the angular acceleration is alpha_ideal + thetaddot + thetadot x w_ideal to first order in theta.
// The generalised contact force of a joint is its whole wrench on the journal: the force along the offset, the moment
// through what T does to the relative spin, w_rel = w_ideal + S xidot, and on a cylindrical joint the axial friction through
// what it does to the slide, slide_ideal + Y xidot. No number of a contact changes any of this. Masses and gravity enter
// M_r, C and r affinely, so a payload, body-mass or gravity sweep needs no new scene.
// Derived for this program; held against the multibody rung in a test.
#pragma once

#include <optional>
#include <vector>

#include "boresight/math/time_table.hpp"
#include "boresight/mechanism/ideal_motion.hpp"

namespace boresight {

// The scene for one set of masses and one gravity, ready to integrate. n = 3 offsets per clearance (sleeve axes); a
// cylindrical joint's axial one is held at zero.
struct SceneTables {
  int clearances = 0;
  // Per time, row by row: A = M_r^-1 (n x n), A r (n), A C (n x n), then per clearance w_ideal (3), slide_ideal (1),
  // S (3 x n), Y (1 x n).
  TimeTable dynamics;
  TimeTable pose;  // E: 6 x n, row by row
};

class ClearanceScene {
 public:
  // The ideal motion must be kinematic. Throws ComputationError, naming time and joint, where T does not exist: near a
  // singular pose, or where redundant rows hold an offset that the clearance would release.
  ClearanceScene(const Mechanism& mechanism, const IdealMotion& ideal);

  int offsets() const { return n_; }
  int knots() const { return static_cast<int>(state_.size()); }
  double spacing() const { return spacing_; }

  SceneTables tables(const Parameters& parameters) const;
  // M_r, C and r of these parameters at a knot.
  void assemble(const Parameters& parameters, int knot, MatX& M, MatX& C, VecX& r) const;
  // E at a knot, 6 x n.
  const MatX& pose_gain(int knot) const { return pose_gain_[knot]; }

 private:
  // A mass that rides on a body: what one unit of it adds at each knot.
  struct Element {
    int body = 0;
    Vec3 c = Vec3::Zero();        // from the body's own centre of mass, body axes [m]
    double mass = 0.0;            // [kg] per unit
    Mat3 inertia = Mat3::Zero();  // about its own centre, body axes [kg m^2] per unit
    std::vector<MatX> M = {}, C = {};
    std::vector<VecX> r = {};          // - T^T M vdot_ideal
    std::vector<MatX> r_gravity = {};  // n x 3: per unit of gravity
  };
  void solve_gain(double t, const IdealMotion& ideal, ConstraintSystem& system, const std::vector<Mat6>& weight,
                  MatX& T) const;
  void fill(Element& element) const;
  void add(const Element& element, double units, const Vec3& gravity, int knot, MatX& M, MatX& C, VecX& r) const;

  const Mechanism& mechanism_;
  int n_ = 0;
  double spacing_ = 0.0;
  std::vector<IdealState> state_;
  std::vector<MatX> T_, T_rate_;  // 6 bodies x n
  std::vector<MatX> pose_gain_;
  std::vector<std::vector<double>> joint_;  // per knot: the per-clearance part of SceneTables::dynamics
  std::vector<Element> body_mass_, body_inertia_;
  std::optional<Element> payload_;
};

}  // namespace boresight
