#include "boresight/play/joint_play.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "boresight/contact/hertz.hpp"

namespace boresight {
namespace {

[[noreturn]] void refuse(JointType joint) {
  throw std::invalid_argument(std::string("no kind of play for a joint of type ") + to_string(joint));
}

// The first kind that serves the type of joint.
template <std::size_t K = 0>
PlayKinds<double> made(const ClearanceDescription& description, JointType joint, const ClearanceParameters& p) {
  if constexpr (K < std::variant_size_v<PlayKinds<double>>) {
    using Kind = std::variant_alternative_t<K, PlayKinds<double>>;
    if (Kind::serves(description, joint)) return Kind(description, joint, p);
    return made<K + 1>(description, joint, p);
  } else {
    refuse(joint);
  }
}

template <std::size_t K = 0>
PlayWords words_for(const ClearanceDescription& description, JointType joint) {
  if constexpr (K < std::variant_size_v<PlayKinds<double>>) {
    using Kind = std::variant_alternative_t<K, PlayKinds<double>>;
    return Kind::serves(description, joint) ? Kind::words() : words_for<K + 1>(description, joint);
  } else {
    refuse(joint);
  }
}

template <std::size_t K = 0>
bool any_serves(const ClearanceDescription& description, JointType joint) {
  if constexpr (K < std::variant_size_v<PlayKinds<double>>)
    return std::variant_alternative_t<K, PlayKinds<double>>::serves(description, joint) ||
           any_serves<K + 1>(description, joint);
  else
    return false;
}

}  // namespace

JointPlay::JointPlay(const ClearanceDescription& description, JointType joint, const ClearanceParameters& p) {
  kind = made(description, joint, p);
  const FrictionLaw friction = make_friction_law(description.friction_law, p.friction);
  sticks = friction.kind == FrictionKind::lugre && friction.stiction > 0.0;
  lugre = {friction.coefficient,         friction.stiction,          friction.stribeck_speed, friction.dynamic_speed,
           p.friction.bristle_stiffness, p.friction.bristle_damping, p.friction.viscosity};
  minimum_impact_speed = p.contact.minimum_impact_speed;
  validity_speed = boresight::validity_speed(p.contact);
}

bool JointPlay::serves(const ClearanceDescription& description, JointType joint) {
  return any_serves(description, joint);
}
PlayWords JointPlay::words(const ClearanceDescription& description, JointType joint) {
  return words_for(description, joint);
}
PlayWords JointPlay::words() const {
  return std::visit([](const auto& k) { return k.words(); }, kind);
}

std::vector<ContactPlace> JointPlay::places() const {
  return std::visit([](const auto& k) { return k.places(); }, kind);
}
MotionInputs JointPlay::inputs() const {
  return std::visit([](const auto& k) { return k.inputs(); }, kind);
}
double JointPlay::elastic_energy(const PlayMotion<double>& motion) const {
  return std::visit([&](const auto& k) { return k.elastic_energy(motion); }, kind);
}
JointPlay JointPlay::elastic_only() const {
  JointPlay elastic = *this;
  std::visit([&](const auto& k) { elastic.kind = k.elastic_only(); }, kind);
  elastic.sticks = false;
  return elastic;
}
ContactTangent JointPlay::tangent(const PlayMotion<double>& motion) const {
  return std::visit([&](const auto& k) { return k.tangent(motion); }, kind);
}
RestingPlay JointPlay::rest_under(const PlayOffsets& load, const JointCoordinates& joint,
                                  const RestingPlay& before) const {
  RestingPlay rest = std::visit([&](const auto& k) { return k.rest_under(load, joint, before); }, kind);
  rest.carried = load.head<3>().norm();
  return rest;
}
std::vector<GapPart> JointPlay::gap_parts(const RestingPlay& rest, const JointCoordinates& joint) const {
  return std::visit([&](const auto& k) { return k.gap_parts(rest, joint); }, kind);
}
std::vector<double> JointPlay::clearances() const {
  return std::visit([](const auto& k) { return k.clearances(); }, kind);
}
double JointPlay::widest() const {
  const std::vector<double> all = clearances();
  return *std::max_element(all.begin(), all.end());
}
double JointPlay::narrowest() const {
  double least = std::numeric_limits<double>::infinity();
  for (const double gap : clearances())
    if (gap > 0.0) least = std::min(least, gap);
  return std::isfinite(least) ? least : 0.0;
}
PlayOffsets JointPlay::widths(double other) const {
  return std::visit([&](const auto& k) { return k.widths(other); }, kind);
}
OffsetGroups JointPlay::pushed_together() const {
  return std::visit([](const auto& k) { return k.pushed_together(); }, kind);
}
double JointPlay::lever() const {
  return std::visit([](const auto& k) { return k.lever(); }, kind);
}
double JointPlay::size() const {
  return std::visit([](const auto& k) { return k.size(); }, kind);
}
const NormalLaw& JointPlay::normal_law() const {
  return std::visit([](const auto& k) -> const NormalLaw& { return k.normal_law(); }, kind);
}
double JointPlay::axial_stiffness() const {
  return std::visit([](const auto& k) { return k.axial_stiffness(); }, kind);
}
PlayOffsets JointPlay::root_stiffness(double load) const {
  return std::visit([&](const auto& k) { return k.root_stiffness(load); }, kind);
}

std::vector<JointPlay> joint_plays(const MechanismDescription& mechanism, const Parameters& parameters) {
  std::vector<JointPlay> plays;
  for (std::size_t c = 0; c < mechanism.clearances.size(); ++c) {
    const ClearanceDescription& clearance = mechanism.clearances[c];
    plays.emplace_back(clearance, mechanism.joints[clearance.joint].type, parameters.clearance[c]);
  }
  return plays;
}

}  // namespace boresight
