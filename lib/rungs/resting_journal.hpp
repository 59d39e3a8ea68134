// Where a journal rests under a load on its offsets: what the quasistatic and envelope rungs are made of.
//
// Parallel axes, load r = (r_x, r_y, r_z):
//   xi_rad = (c_r + (|r_rad| / K)^(2/3)) r_rad / |r_rad|           Hertz, pressed against the bore
//   xi_ax  = sign(r_ax) (c_a + |r_ax| / K_c)                        once |r_ax| exceeds what friction holds, mu |r_rad|;
//                                                                   until then the journal stays where it was axially
// A journal that may tilt also carries a couple g on its slopes. Its two ends are statically determined,
//   R+ + R- = r_rad,   R+ - R- = 2 g / L_b   (a slide e_y adds e_y r_rad to g),
// each rests at c_r + (|R| / (K/2))^(2/3) along its force, and where they rest gives centre and slope. The axial load on a
// tilted face acts off the axis (ring_contact.hpp), which takes its share of g: iterated.
#pragma once

#include <array>

#include "boresight/contact/journal_in_sleeve.hpp"

namespace boresight {

struct Rest {
  JournalMotion<double> motion{Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};
  std::array<double, 2> radial_reach = {0.0, 0.0};  // c_r plus the radial deflection, of each end (equal where parallel) [m]
  double axial_reach = 0.0;                         // c_a plus the axial deflection; 0 on a cylindrical joint [m]
  std::array<ContactState<double>, kContactPlaces> contact{};
  double normal_force() const;  // sum over the contacts [N]
  double penetration() const;   // the deepest [m]
};

// load: on the five offsets, slopes' couples zero where parallel [N, N m]. slide: displacement along the axis of a
// cylindrical joint [m]. before: its rest a moment ago, for the axial place it keeps.
Rest rest_under(const JournalInSleeve& joint, const Eigen::Matrix<double, 5, 1>& load, double slide, const Rest& before);

}  // namespace boresight
