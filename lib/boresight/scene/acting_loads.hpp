// What acts on the bodies, without regard to sign: what they weigh and resist, and what springs and loads do to them. Reactions are
// differences of these; a reaction that is next to nothing beside them is what rounding leaves of loads that cancel.
#pragma once

#include <vector>

#include "boresight/mechanism/ideal_solver.hpp"

namespace boresight {

// A force on a body, and a couple about its origin [N, N m].
struct ActingLoad {
  double force = 0.0, couple = 0.0;
};

// What a body weighs and resists. linear: of its origin's acceleration [m/s^2]; turning: its angular acceleration and the square of its
// speed of turning together [1/s^2].
ActingLoad weight_and_inertia(const MassProperties& body, double gravity, double linear, double turning);
// What springs, dampers and loads do to each body.
std::vector<ActingLoad> applied_loads(const Mechanism& mechanism, const Parameters& parameters, double t,
                                      const std::vector<BodyMotion>& bodies);
// Adds what a load does on each coordinate at most. T: the bodies' motions per coordinate, 6 bodies x n; sum: n.
void add_to_coordinates(const ActingLoad& load, int body, const MatX& T, VecX& sum);

// All of it at one instant as one force, couples as forces over the mechanism's length [N].
double sum_of_acting_loads(const Mechanism& mechanism, const Parameters& parameters, double t,
                           const std::vector<BodyMotion>& bodies, const std::vector<BodyAcceleration>& accelerations);
// Of that sum: far above what rounding leaves of loads that cancel, far below any load that is read.
inline constexpr double kCancelledLoad = 1e-10;

}  // namespace boresight
