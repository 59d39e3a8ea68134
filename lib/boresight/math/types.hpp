// The few matrix and vector types that every room uses, and the notation of the names built from them.
//
// Notation (Drake's and Simbody's "monogram" notation):
//   p_AB    position of point B from point A;  p_AB_W the same expressed in frame W (W may be left out where it is world)
//   R_AB    rotation that takes components in B to components in A:  v_A = R_AB v_B
//   v_WB    velocity of B's centre of mass in the world;  w_WB its angular velocity, both expressed in world axes
// Everything is SI: m, kg, s, rad, N.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace boresight {

using Vec3 = Eigen::Vector3d;
using Vec6 = Eigen::Matrix<double, 6, 1>;
using Mat3 = Eigen::Matrix3d;
using Mat6 = Eigen::Matrix<double, 6, 6>;
using Quat = Eigen::Quaterniond;
using VecX = Eigen::VectorXd;
using MatX = Eigen::MatrixXd;

template <typename T>
using Vec2T = Eigen::Matrix<T, 2, 1>;
template <typename T>
using Vec3T = Eigen::Matrix<T, 3, 1>;
template <typename T>
using Mat3T = Eigen::Matrix<T, 3, 3>;

}  // namespace boresight
