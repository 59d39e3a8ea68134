// Derivatives of the wrench of a joint with play with respect to how its insert moves, exact, by automatic differentiation
// of the law itself.
#pragma once

#include "boresight/play/joint_play.hpp"

namespace boresight {

enum class MomentAbout { insert, seat, insert_as_couples };  // the centre of; the last one as couples_of() it

// Rows: the force on the insert, then its moment. Columns: the numbers of the motion; those that the wrench does not hang on
// (JointPlay::inputs) are left zero.
using ContactJacobian = Eigen::Matrix<double, 6, kMotionNumbers>;
void contact_jacobian(const JointPlay& law, const PlayMotion<double>& motion,
                      const std::array<double, kContactPlaces>& impact_speed, MomentAbout about, ContactJacobian& out);

// Of an insert at rest: how the loads on its offsets, forces and couples, change with these. Symmetric where the contact is elastic.
using OffsetJacobian = Eigen::Matrix<double, kMostOffsets, kMostOffsets>;
void offset_jacobian(const JointPlay& law, const PlayMotion<double>& at_rest,
                     const std::array<double, kContactPlaces>& impact_speed, OffsetJacobian& out);

inline Eigen::Matrix<double, kMotionNumbers, 1> numbers(const PlayMotion<double>& m) {
  Eigen::Matrix<double, kMotionNumbers, 1> all;
  all << m.e, m.e_dot, m.w, m.slope, m.slope_rate, m.roll, m.twist;
  return all;
}

}  // namespace boresight
