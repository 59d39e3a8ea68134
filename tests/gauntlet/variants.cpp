#include "variants.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>
#include <numeric>
#include <regex>

namespace boresight::gauntlet {
namespace {

// sum_k a_k f_k + b
class Combination final : public TimeFunction {
 public:
  Combination(std::vector<std::pair<double, TimeFunctionPtr>> parts, double constant)
      : parts_(std::move(parts)), constant_(constant) {}
  TimeValue at(double t) const override {
    TimeValue sum{constant_, 0.0, 0.0};
    for (const auto& [factor, f] : parts_) {
      const TimeValue v = f->at(t);
      sum.value += factor * v.value;
      sum.rate += factor * v.rate;
      sum.acceleration += factor * v.acceleration;
    }
    return sum;
  }

 private:
  std::vector<std::pair<double, TimeFunctionPtr>> parts_;
  double constant_;
};

MechanismDescription drawn_elsewhere(MechanismDescription m, const Mat3& R, const Vec3& p) {
  const auto place = [&](Vec3& x) { x = (R * x + p).eval(); };
  const auto turn = [&](Vec3& d) { d = (R * d).eval(); };
  for (BodyDescription& b : m.bodies) {
    place(b.center_of_mass);
    b.axes = (R * b.axes).eval();
    if (b.boresight) turn(*b.boresight);
  }
  if (m.payload) place(m.payload->center_of_mass);
  for (JointDescription& j : m.joints) {
    place(j.point);
    turn(j.axis);
    turn(j.second_axis);
  }
  for (ClearanceDescription& c : m.clearances) turn(c.width_direction);
  for (SpringDescription& s : m.springs) {
    place(s.first_point);
    place(s.second_point);
  }
  for (LoadDescription& l : m.loads) {
    if (l.joint) continue;
    place(l.point);
    const auto before = l.force;
    for (int row = 0; row < 3; ++row)
      l.force[row] = std::make_shared<Combination>(
          std::vector<std::pair<double, TimeFunctionPtr>>{
              {R(row, 0), before[0]}, {R(row, 1), before[1]}, {R(row, 2), before[2]}},
          0.0);
  }
  if (m.motion.pose)
    for (int k = 0; k < 3; ++k)
      m.motion.pose->position[k] = std::make_shared<Combination>(
          std::vector<std::pair<double, TimeFunctionPtr>>{{1.0, m.motion.pose->position[k]}}, p[k]);
  for (ErrorDescription& e : m.errors) turn(e.direction);
  if (m.line_of_sight) {
    place(m.line_of_sight->from);
    place(m.line_of_sight->target);
  }
  turn(m.gravity);
  return m;
}

template <typename T>
void turn_around(std::vector<T>& list) {
  std::reverse(list.begin(), list.end());
}

// Lists backwards, and joints that nothing drives or loads seen from their other body.
MechanismDescription reordered(MechanismDescription m) {
  const int bodies = static_cast<int>(m.bodies.size()), joints = static_cast<int>(m.joints.size());
  const auto body = [&](int& b) { b = b == kGround ? kGround : bodies - 1 - b; };
  const auto joint = [&](int& j) { j = joints - 1 - j; };
  std::vector<bool> keeps(m.joints.size(), false);
  for (int j = 0; j < joints; ++j) keeps[j] = m.joints[j].driven;
  for (const LoadDescription& l : m.loads)
    if (l.joint) keeps[*l.joint] = true;
  for (const InitialRateDescription& r : m.initial_rates) keeps[r.joint] = true;
  for (int j = 0; j < joints; ++j) {
    body(m.joints[j].first);
    body(m.joints[j].second);
    if (keeps[j]) continue;
    std::swap(m.joints[j].first, m.joints[j].second);
    if (m.joints[j].type == JointType::universal) std::swap(m.joints[j].axis, m.joints[j].second_axis);
  }
  for (ClearanceDescription& c : m.clearances) {
    joint(c.joint);
    body(c.journal);
  }
  for (SpringDescription& s : m.springs) {
    body(s.first);
    body(s.second);
  }
  for (LoadDescription& l : m.loads) {
    if (l.joint)
      joint(*l.joint);
    else
      body(l.body);
  }
  for (InitialRateDescription& r : m.initial_rates) joint(r.joint);
  for (ErrorDescription& e : m.errors) {
    if (e.kind != ErrorDescription::Kind::expansion) joint(e.joint);
    if (e.kind != ErrorDescription::Kind::drive) body(e.body);
  }
  if (m.payload) body(m.payload->body);
  if (m.motion.pose) body(m.motion.pose->body);
  std::map<int, TimeFunctionPtr> drives;
  for (const auto& [j, law] : m.motion.drives) drives[joints - 1 - j] = law;
  m.motion.drives = std::move(drives);
  turn_around(m.bodies);
  turn_around(m.joints);
  turn_around(m.clearances);
  turn_around(m.springs);
  turn_around(m.loads);
  turn_around(m.errors);
  return m;
}

MechanismDescription renamed(MechanismDescription m) {
  int number = 100;
  for (BodyDescription& b : m.bodies) b.name = fmt::format("z{} part", --number);
  for (JointDescription& j : m.joints) j.name = fmt::format("q{}_pin", --number);
  m.name = "another name";
  return m;
}

}  // namespace

const std::vector<std::string>& variant_names() {
  static const std::vector<std::string> names = {"moved", "turned", "renamed", "reordered"};
  return names;
}

std::optional<MechanismDescription> variant(const MechanismDescription& mechanism, const std::string& name) {
  double reach = 0.0;
  for (const JointDescription& a : mechanism.joints)
    for (const JointDescription& b : mechanism.joints) reach = std::max(reach, (a.point - b.point).norm());
  if (name == "moved")
    return drawn_elsewhere(mechanism, Mat3::Identity(), std::max(reach, 0.01) * Vec3(3.1, -2.3, 1.7));
  if (name == "renamed") return renamed(mechanism);
  if (name == "reordered") return reordered(mechanism);
  if (mechanism.motion.pose) return {};
  return drawn_elsewhere(mechanism, Eigen::AngleAxisd(1.1, Vec3(0.36, -0.48, 0.8)).toRotationMatrix(), Vec3::Zero());
}

std::string in_other_units(const std::string& toml) {
  struct Unit {
    const char *from, *to;
    double factor;
  };
  // Longest first, so that "kg m^2" is not taken for "kg".
  static const std::vector<Unit> units = {
      {"kg m^2", "g mm^2", 1e9}, {"kg/m^3", "g/cm^3", 1e-3}, {"N s/m", "N s/mm", 1e-3},
      {"N/m", "N/mm", 1e-3},     {"m/s^2", "cm/s^2", 100.0}, {"rad/s", "deg/s", 180.0 / std::numbers::pi},
      {"mm/s", "m/s", 1e-3},     {"m/s", "mm/s", 1e3},       {"GPa", "Pa", 1e9},
      {"Pa", "MPa", 1e-6},       {"mm", "m", 1e-3},          {"um", "m", 1e-6},
      {"m", "mm", 1e3},          {"kg", "g", 1e3},           {"ms", "s", 1e-3},
      {"s", "ms", 1e3}};
  static const std::regex quantity("\"([-+]?[0-9][0-9.]*(?:e[-+]?[0-9]+)?) ([a-zA-Z][a-zA-Z0-9/^ ]*)\"");
  std::string out;
  auto last = toml.cbegin();
  for (std::sregex_iterator it(toml.begin(), toml.end(), quantity), end; it != end; ++it) {
    out.append(last, toml.cbegin() + it->position());
    last = toml.cbegin() + it->position() + it->length();
    const auto unit = std::find_if(units.begin(), units.end(), [&](const Unit& u) { return (*it)[2] == u.from; });
    out +=
        unit == units.end() ? it->str() : fmt::format("\"{:.17g} {}\"", std::stod((*it)[1]) * unit->factor, unit->to);
  }
  out.append(last, toml.cend());
  return out;
}

}  // namespace boresight::gauntlet
