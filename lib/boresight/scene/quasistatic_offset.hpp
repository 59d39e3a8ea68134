// Where a journal rests under a load on its offsets: what the quasistatic and envelope rungs are made of.
//
// Parallel axes, load r = (r_x, r_y, r_z):
//   xi_rad = (c_r + (|r_rad| / K)^(2/3)) r_rad / |r_rad|           Hertz, pressed against the bore
//   xi_ax  = sign(r_ax) (c_a + |r_ax| / K_c)                        once |r_ax| exceeds what friction holds, mu |r_rad|;
//                                                                   until then the journal stays where it was axially
// A journal that may tilt also carries a couple g on its slopes. It rests where its elastic energy less the work of the load,
//   V(e, sigma) = U_ends + U_rings - r . e - g . sigma,
// is least (tilted_journal.hpp has the contacts). V is convex, so there is one such place, or a set of places between which
// no force decides: the one nearest to where the journal was. The ends and the faces share the couple as their stiffness
// decides: under an axial load a cap stands evenly on its face until the couple lifts its edge.
// Friction holds the axial place as above, by the forces of both ends.
#pragma once

#include <array>

#include "boresight/contact/journal_in_sleeve.hpp"

namespace boresight {

struct RestingJournal {
  JournalMotion<double> motion{Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};
  std::array<double, 2> radial_reach = {0.0,
                                        0.0};  // c_r plus the radial deflection, of each end (equal where parallel) [m]
  double axial_reach = 0.0;                    // c_a plus the axial deflection; 0 on a cylindrical joint [m]
  std::array<ContactState<double>, kContactPlaces> contact{};
  double normal_force() const;  // sum over the contacts [N]
  double penetration() const;   // the deepest [m]
};

// load: on the five offsets, slopes' couples zero where parallel [N, N m]. slide: displacement along the axis of a
// cylindrical joint [m]. before: its rest a moment ago, for the axial place it keeps.
RestingJournal resting_journal_under(const JournalInSleeve& joint, const Eigen::Matrix<double, 5, 1>& load,
                                     double slide, const RestingJournal& before);

}  // namespace boresight
