// Where an insert rests in its seat under a load on its offsets: what the quasistatic and envelope rungs are made of. How each kind
// finds it is in the kind's own folder.
#pragma once

#include "boresight/play/play_motion.hpp"

namespace boresight {

struct RestingPlay {
  PlayMotion<double> motion{Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};
  // Clearance plus deflection under the load, across the axis: of each end (equal where the insert cannot tilt) [m].
  std::array<double, 2> radial_reach = {0.0, 0.0};
  double axial_reach = 0.0;  // along the axis; 0 where nothing limits it [m]
  ContactStates<double> contact{};
  double carried = 0.0;  // resultant of its contacts [N]

  double normal_force() const;  // sum over the contacts [N]
  double penetration() const;   // the deepest [m]
};

}  // namespace boresight
