// Where journals rest under the ideal joints' reactions, over time: what the quasistatic and envelope rungs are made of.
//
//   xi_rad = (c_r + (|r_rad| / K)^(2/3)) r_rad / |r_rad|           Hertz, pressed against the bore by the reaction r(t)
//   xi_ax  = sign(r_ax) (c_a + |r_ax| / K_c)                        once |r_ax| exceeds what friction holds, mu |r_rad|;
//                                                                   until then the journal stays where it was axially
#pragma once

#include <vector>

#include "boresight/contact/journal_in_sleeve.hpp"
#include "boresight/rungs/clearance_scene.hpp"

namespace boresight {

struct Rest {
  Vec3 offset = Vec3::Zero();     // sleeve axes [m]
  double radial_reach = 0.0;      // c_r plus the radial deflection [m]
  double axial_reach = 0.0;       // c_a plus the axial deflection; 0 on a cylindrical joint [m]
  double radial_force = 0.0, axial_force = 0.0;  // [N]; axial 0 while friction holds it
};

// One joint's rest under the reaction r (sleeve axes); `before`: its rest a moment ago, for the axial place it keeps.
Rest rest_under(const JournalInSleeve& joint, const Vec3& reaction, const Rest& before);

}  // namespace boresight
