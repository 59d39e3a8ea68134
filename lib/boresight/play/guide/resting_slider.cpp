// Where a slider rests in its guide under a force and, where it may tilt, couples on its slopes and its roll.
//
//   parallel   |e_x| = c_x + |F_x| / K_x, |e_z| likewise                              Hooke
//   tilting    where the contacts' elastic energy less the work of the load is least: it is convex, each penetration being linear in the
//              offsets (pressed_insert.hpp).
#include <algorithm>
#include <cmath>

#include "boresight/play/guide/slider_in_guide.hpp"
#include "boresight/play/pressed_insert.hpp"

namespace boresight {

RestingPlay SliderInGuide::rest_under(const PlayOffsets& load, const JointCoordinates& joint,
                                      const RestingPlay& before) const {
  RestingPlay rest;
  PlayOffsets at = offsets_of(before.motion);
  if (tilts) {
    PlayOffsets across = load;
    across[1] = 0.0;
    at = PressedInsert(*this, across, joint).rest_near(at);
  } else {
    at.setZero();
    for (const int across : {0, 1}) {
      const double force = load[2 * across], reach = gap[across] + std::abs(force) / stiffness[across];
      at[2 * across] = force != 0.0 ? std::copysign(reach, force)
                                    : std::clamp(before.motion.e[2 * across], -gap[across], gap[across]);
    }
  }
  at[1] = joint.slide;
  rest.motion = at_rest_at(at);
  const SliderInGuide elastic = elastic_only();
  PlayWrench<double> wrench;
  elastic.wrench(rest.motion, kSlowImpacts, SlidingFriction<double>{elastic.friction}, wrench);
  rest.contact = wrench.contact;
  return rest;
}

}  // namespace boresight
