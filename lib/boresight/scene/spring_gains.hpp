// How a spring with its damper sees the coordinates z of a small deviation, and what it opposes to them.
//
// Its length is L(z) = L + g . z + z^T W z / 2, with the ends moving by G z against each other and u the
// direction from first to second end:
//   g = G^T u       W = G^T (I - u u^T) G / L + what turning arms add at second order       L' = u .
//   (relative velocity)
// and its pull f = k (L - L0) + d L' works on z by -f dL/dz. To first order in z that is the ideal motion's
// force, less
//   (f W + g (k g + d g')^T) z + d g g^T z'.
// The turn of an arm r by theta moves its end by theta x r + theta x (theta x r) / 2.
// Derived for this program; held against differences of ForceElements, and against the multibody rung, in
// tests.
#pragma once

#include "boresight/mechanism/ideal_motion.hpp"
#include "boresight/mechanism/mechanism.hpp"

namespace boresight {

struct SpringGain {
  double length = 0.0, speed = 0.0;  // L [m], L' [m/s] of the ideal motion
  VecX g, g_rate;
  MatX W;

  MatX stiffness(const SpringParameters& p) const;
  // The same of what lies still: f W + k g g^T.
  MatX stiffness_at_rest(const SpringParameters& p) const;
  // What stiffness() has beyond that: of a damper whose stretch rate z changes.
  MatX turning_damping(const SpringParameters& p) const { return p.damping * g * g_rate.transpose(); }
  MatX damping(const SpringParameters& p) const { return p.damping * g * g.transpose(); }
};

// T, T_rate: velocities of all bodies per unit rate of z, and their rate of change, at that state.
SpringGain spring_gain(const MechanismDescription& mechanism, const SpringDescription& spring, const IdealState& state,
                       const MatX& T, const MatX& T_rate);

}  // namespace boresight
