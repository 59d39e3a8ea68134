// Derivatives of a clearance joint's wrench with respect to how its journal moves, exact, by automatic differentiation
// of the law itself.
#pragma once

#include "boresight/contact/journal_in_sleeve.hpp"

namespace boresight {

// Numbers of a JournalMotion: e, e_dot, w (3 each), then slope, slope_rate (2 each).
inline constexpr int kMotionNumbers = 13;

enum class MomentAbout { journal, sleeve };  // the centre of

// Rows: the force on the journal, then its moment. Columns: the numbers of the motion; of a parallel journal those of
// w_x, w_z and the slopes are left zero.
using ContactJacobian = Eigen::Matrix<double, 6, kMotionNumbers>;
void contact_jacobian(const JournalInSleeve& law, const JournalMotion<double>& motion,
                      const std::array<double, kContactPlaces>& impact_speed, MomentAbout about, ContactJacobian& out);

inline Eigen::Matrix<double, kMotionNumbers, 1> numbers(const JournalMotion<double>& m) {
  Eigen::Matrix<double, kMotionNumbers, 1> all;
  all << m.e, m.e_dot, m.w, m.slope, m.slope_rate;
  return all;
}

}  // namespace boresight
