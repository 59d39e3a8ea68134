// How the acceleration of a mechanism's deviation changes with the deviation itself, A K, at one instant: by central
// differences of the multibody formulation of the mechanism opened at its clearance joints.
//
// A displaced pose is made by displacing the bodies by +-T z and closing all joints again; what that does to the coordinates
// (Z) and their rates (Zdot) is measured, so that with G the change of zddot
//     A K = -(G + A C Zdot) Z^-1.
//
// The ideal joints' reactions act on the journals meanwhile, as contact does on the average: what these large forces do to
// the mechanism changes with its pose (their geometric stiffness).
#pragma once

#include "boresight/scene/deviation_coordinates.hpp"

namespace boresight {

// state, T: of the ideal motion at that instant; AC: M_r^-1 C there; r: the load on the coordinates (T^T (Q - M vdot_ideal)).
// near: where redundant joints tie offsets together, loads on all offsets that those which act differ least from (OffsetLayout); empty: the
// least act.
MatX deviation_stiffness(const Mechanism& mechanism, const IdealMotion& ideal, const Parameters& parameters,
                         DeviationCoordinates& coordinates, const IdealState& state, const MatX& T, const MatX& AC,
                         const VecX& r, const VecX& near = VecX());

}  // namespace boresight
