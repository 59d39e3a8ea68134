#include "boresight/mechanism/drawn_joint.hpp"

#include <algorithm>
#include <string_view>

namespace boresight {
namespace {

constexpr std::string_view kFloating = ".floating";

bool are_a_pair(const JointDescription& fixed, const JointDescription& floating) {
  return floating.name.size() == fixed.name.size() + kFloating.size() && floating.name.starts_with(fixed.name) &&
         floating.name.ends_with(kFloating) && fixed.type == JointType::revolute &&
         floating.type == JointType::cylindrical && fixed.first == floating.first && fixed.second == floating.second;
}

}  // namespace

int floating_bearing(const MechanismDescription& mechanism, int joint) {
  for (std::size_t j = 0; j < mechanism.joints.size(); ++j)
    if (are_a_pair(mechanism.joints[joint], mechanism.joints[j])) return static_cast<int>(j);
  return -1;
}

bool is_floating_bearing(const MechanismDescription& mechanism, int joint) {
  return std::any_of(mechanism.joints.begin(), mechanism.joints.end(),
                     [&](const JointDescription& fixed) { return are_a_pair(fixed, mechanism.joints[joint]); });
}

Vec3 drawn_point(const MechanismDescription& mechanism, int joint) {
  const int floating = floating_bearing(mechanism, joint);
  const Vec3& point = mechanism.joints[joint].point;
  return floating < 0 ? point : Vec3(0.5 * (point + mechanism.joints[floating].point));
}

}  // namespace boresight
