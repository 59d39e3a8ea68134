// Parallel mechanisms with play in every one of their joints.
#pragma once

#include <string>

#include "boresight/io/mechanism_file.hpp"

namespace boresight::scenes {

// The default mechanism with play in all fifteen: nine revolute, three cylindrical and, on round guides, three prismatic ones.
inline MechanismDescription fifteen_joints(JournalAxes axes, double duration) {
  MechanismDescription m = read_mechanism(std::string(BORESIGHT_EXAMPLES) + "/3-rrcpr/twelve-joints.toml", {});
  const ClearanceDescription other = m.clearances.front();
  for (std::size_t j = 0; j < m.joints.size(); ++j) {
    if (m.joints[j].type != JointType::prismatic) continue;
    ClearanceDescription c = other;
    c.joint = static_cast<int>(j);
    c.journal = m.joints[j].second;
    c.parameters.axial = c.parameters.cap_radius = 0.0;
    c.parameters.sleeve_length = 0.08;
    m.clearances.push_back(c);
  }
  for (ClearanceDescription& c : m.clearances) c.axes = axes;
  m.motion.duration = duration;
  return m;
}

// The hexapod with play in all eighteen: six universal ones with two bearings each, six prismatic and six spherical ones.
inline MechanismDescription eighteen_joints(JournalAxes axes, double duration) {
  MechanismDescription m = read_mechanism(std::string(BORESIGHT_EXAMPLES) + "/hexapod/play.toml", {});
  for (ClearanceDescription& c : m.clearances)
    if (keeps_axis(m.joints[c.joint].type)) c.axes = axes;
  m.motion.duration = duration;
  return m;
}

}  // namespace boresight::scenes
