// The masses that ride on the bodies, and what they and the forces on the bodies load the coordinates of the deviation with:
//
//     r = T^T (Q - M vdot),     T the bodies' motions per coordinate, vdot their accelerations.
//
// Masses are kept in groups, each for what one parameter scales, since r, as all matrices of the scene, is a sum over them.
#pragma once

#include <vector>

#include "boresight/mechanism/ideal_solver.hpp"

namespace boresight {

// What one unit of it adds.
struct RidingMass {
  int body = 0;
  Vec3 c = Vec3::Zero();        // from the body's own centre of mass, body axes [m]
  double mass = 0.0;            // [kg] per unit
  Mat3 inertia = Mat3::Zero();  // about its own centre, body axes [kg m^2] per unit
};

// What no parameter scales; one group per body's mass; the payload.
std::vector<std::vector<RidingMass>> riding_masses(const Mechanism& mechanism, const Parameters& parameters);
// How much there is of a group: 1, a body's mass, the payload's.
double units_of(std::size_t group, const Mechanism& mechanism, const Parameters& parameters);

// T of the mass' own centre, 3 x n, from rows 6 b to 6 b + 5 of T.
Eigen::Matrix<double, 3, Eigen::Dynamic> gain_of_centre(const RidingMass& mass, const BodyMotion& body, const MatX& T);
// Adds to r (n), and to r per unit of gravity (n x 3, column by column).
void add_load(const RidingMass& mass, const IdealState& state, const MatX& T, double* r, double* per_gravity);
// Adds what springs, dampers and loads have of r.
void add_load_of_forces(const Mechanism& mechanism, const Parameters& parameters, const IdealState& state,
                        const MatX& T, VecX& r);

}  // namespace boresight
