// How stiff the contacts of one clearance joint are where they stand, as columns n with tangent stiffness = sum n n^T over
// the joint's offsets (x y z of the journal's centre, slopes x z; see OffsetLayout).
//
// A radial contact has one: the root of the elastic slope (Hertz: 1.5 K sqrt(d)) times the gradient of its penetration. A
// face that tilts has three: with cos a = -d0 / A (a = pi in full contact) the energy's second derivatives are
// (K_c / pi) [a, sin a; sin a, (a + sin a cos a) / 2] in (d0, A), and (K_c / 2 pi) (a - sin a cos a) for a slope across the
// tilt. Derivatives of ring_contact.hpp.
#pragma once

#include <array>

#include "boresight/contact/journal_in_sleeve.hpp"

namespace boresight {

struct ContactTangent {
  struct Column {
    ContactPlace place;
    Eigen::Matrix<double, 5, 1> n;  // a parallel journal's slopes are zero
  };
  int count = 0;
  std::array<Column, 8> column;
};

ContactTangent contact_tangent(const JournalInSleeve& joint, const JournalMotion<double>& motion);

}  // namespace boresight
