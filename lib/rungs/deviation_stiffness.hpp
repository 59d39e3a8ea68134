// How the acceleration of a mechanism's deviation changes with the deviation itself, A K, at one instant: by central
// differences of the multibody formulation of the mechanism opened at its clearance joints.
//
// A displaced pose is made by displacing the bodies by +-T z and closing all joints again; what that does to the coordinates
// (Z) and their rates (Zdot) is measured, so that with G the change of zddot
//     A K = -(G + A C Zdot) Z^-1.
#pragma once

#include "boresight/rungs/deviation_coordinates.hpp"

namespace boresight {

// state, T: of the ideal motion at that instant; AC: M_r^-1 C there.
MatX deviation_stiffness(const Mechanism& mechanism, const IdealMotion& ideal, const Parameters& parameters,
                         DeviationCoordinates& coordinates, const IdealState& state, const MatX& T, const MatX& AC);

}  // namespace boresight
