// The rates with which displaced journals start: the bodies keep the velocities of the ideal motion, as nearly as the joints let
// them, by kinetic energy. Of what a body's velocity would deviate,
//
//     d = T zdot + (Tdot + (T_turn x w_ideal)) z,    zdot = -(T^T M T)^-1 T^T M (Tdot + (T_turn x w_ideal)) z    makes d^T M d least
//
// (Gauss's principle of least constraint, 1829, for velocities.) At rest in its sleeve instead, a journal would start with what the
// sleeve turns by; and which of two parts is called the sleeve is the drawing's choice.
#pragma once

#include "boresight/mechanism/ideal_motion.hpp"

namespace boresight {

// zdot per z: n x n. T, T_rate: 6 bodies x n, at the instant of `ideal`.
MatX start_rates(const Mechanism& mechanism, const Parameters& parameters, const IdealState& ideal, const MatX& T,
                 const MatX& T_rate);

}  // namespace boresight
