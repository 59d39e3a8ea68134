// How fast a mechanism moves by itself, contacts left out: springs, dampers and gravity on the freedoms that it has.
//
//   lambda = eigenvalues of d f / d y,   y' = f(t, y) the equations of motion of a formulation
//
// by central differences. The largest |lambda| bounds the step of an explicit method (RK4: 2.785 / |lambda|), where a stiff
// damper between light parts sets it as well as a stiff spring.
#pragma once

#include "boresight/formulations/formulation.hpp"

namespace boresight {

// Spectral radius at (t, y) [1/s], with no contact acting.
double fastest_own_rate(Formulation& formulation, double t, const VecX& y);

// The largest along the motion, of the mechanism opened at its clearance joints; 0 where it has no springs.
double fastest_own_rate(const Mechanism& mechanism, const Parameters& parameters, const IdealMotion& ideal);

}  // namespace boresight
