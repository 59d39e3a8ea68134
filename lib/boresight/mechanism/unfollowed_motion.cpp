#include "boresight/mechanism/unfollowed_motion.hpp"

#include <algorithm>
#include <cmath>

namespace boresight {
namespace {

// What a law may move in one step and still be followed [rad or characteristic lengths]: Newton's method closes loops from this far off.
constexpr double kFollowedInAStep = 0.1;

bool moves_too_fast(const Mechanism& mechanism, double t, double step) {
  const MechanismDescription& m = mechanism.description();
  const double length = mechanism.characteristic_length();
  const auto too_fast = [&](const TimeFunctionPtr& law, double scale) {
    const TimeValue from = law->at(t), to = law->at(std::min(t + step, mechanism.duration()));
    // What is guessed of the step's end from its beginning counts too: there a law may stand still and be elsewhere at once.
    const double guessed = step * std::abs(from.rate) + 0.5 * step * step * std::abs(from.acceleration);
    return std::max(std::abs(to.value - from.value), guessed) > kFollowedInAStep * scale;
  };
  for (const auto& [joint, law] : m.motion.drives)
    if (too_fast(law, m.joints[joint].type == JointType::prismatic ? length : 1.0)) return true;
  if (!m.motion.pose) return false;
  for (int k = 0; k < 3; ++k)
    if (too_fast(m.motion.pose->angle[k], 1.0) || too_fast(m.motion.pose->position[k], length)) return true;
  return false;
}

}  // namespace

std::string why_not_followed(const Mechanism& mechanism, double t, double step) {
  return moves_too_fast(mechanism, t, step)
             ? "the prescribed motion is too fast there for any step to follow it; look at its units and frequencies"
             : "the prescribed motion leaves what the mechanism can reach, or passes a singular pose";
}

}  // namespace boresight
