#include "boresight/mechanism/parameter_path.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <sstream>

#include "boresight/mechanism/error.hpp"

namespace boresight {
namespace {

// One kind of number within a table, e.g. clearance.JOINT.contact.young: unit and where it lies (two places for pairs).
template <typename Owner>
struct Field {
  const char* name;
  const char* unit;
  double* (*place)(Owner&);
  double* (*second_place)(Owner&) = nullptr;
};

using C = ClearanceParameters;
const Field<C> kClearanceFields[] = {
    {"radial", "m", [](C& c) { return &c.radial; }},
    {"axial", "m", [](C& c) { return &c.axial; }},
    {"journal_radius", "m", [](C& c) { return &c.journal_radius; }},
    {"cap_radius", "m", [](C& c) { return &c.cap_radius; }},
    {"sleeve_length", "m", [](C& c) { return &c.sleeve_length; }},
    {"pad_radius", "m", [](C& c) { return &c.pad_radius; }},
    {"width", "m", [](C& c) { return &c.width; }},
    {"height", "m", [](C& c) { return &c.height; }},
    {"length", "m", [](C& c) { return &c.length; }},
    {"width_gap", "m", [](C& c) { return &c.width_gap; }},
    {"height_gap", "m", [](C& c) { return &c.height_gap; }},
    {"contact.restitution", "1", [](C& c) { return &c.contact.restitution; }},
    {"contact.young", "Pa", [](C& c) { return &c.contact.young[0]; }, [](C& c) { return &c.contact.young[1]; }},
    {"contact.poisson", "1", [](C& c) { return &c.contact.poisson[0]; }, [](C& c) { return &c.contact.poisson[1]; }},
    {"contact.density", "kg/m^3", [](C& c) { return &c.contact.density; }},
    {"contact.minimum_impact_speed", "m/s", [](C& c) { return &c.contact.minimum_impact_speed; }},
    {"contact.stiffness_scale", "1", [](C& c) { return &c.contact.stiffness_scale; }},
    {"contact.stiffness", "N/m", [](C& c) { return &c.contact.linear_stiffness; }},
    {"contact.damping", "N s/m", [](C& c) { return &c.contact.linear_damping; }},
    {"friction.coefficient", "1", [](C& c) { return &c.friction.coefficient; }},
    {"friction.static_speed", "m/s", [](C& c) { return &c.friction.static_speed; }},
    {"friction.dynamic_speed", "m/s", [](C& c) { return &c.friction.dynamic_speed; }},
    {"friction.static_coefficient", "1", [](C& c) { return &c.friction.static_coefficient; }},
    {"friction.stribeck_speed", "m/s", [](C& c) { return &c.friction.stribeck_speed; }},
    {"friction.bristle_stiffness", "1/m", [](C& c) { return &c.friction.bristle_stiffness; }},
    {"friction.bristle_damping", "s/m", [](C& c) { return &c.friction.bristle_damping; }},
    {"friction.viscosity", "s/m", [](C& c) { return &c.friction.viscosity; }},
};

// A pad has sizes of its own, and so has a slider in a rectangular guide; a journal or ball has none of theirs.
bool belongs(const std::string& number, const ClearanceDescription& clearance, JointType joint) {
  const auto one_of = [&](std::initializer_list<const char*> names) {
    return std::find(names.begin(), names.end(), number) != names.end();
  };
  const bool pad = joint == JointType::planar, slider = clearance.guide == GuideShape::rectangular,
             corners = pad && clearance.pad == PadShape::rectangular;
  if (one_of({"width", "length"})) return slider || corners;
  if (one_of({"height", "width_gap", "height_gap"})) return slider;
  if (number == "pad_radius") return pad && !corners;
  if (number == "axial") return !slider;
  if (one_of({"radial", "journal_radius", "cap_radius", "sleeve_length"})) return !pad && !slider;
  return true;
}

using S = SpringParameters;
const Field<S> kPreload = {"preload", "N", [](S& s) { return &s.preload; }};
const Field<S> kSpringFields[] = {
    {"stiffness", "N/m", [](S& s) { return &s.stiffness; }},
    {"damping", "N s/m", [](S& s) { return &s.damping; }},
    {"free_length", "m", [](S& s) { return &s.free_length; }},
};

// A path that exists: its unit and the numbers it names.
struct Entry {
  std::string path, unit;
  std::vector<std::function<double*(Parameters&)>> numbers;
};

std::vector<Entry> all_entries(const MechanismDescription& m) {
  std::vector<Entry> entries;
  const char* axis[] = {"x", "y", "z"};
  for (int k = 0; k < 3; ++k)
    entries.push_back({std::string("gravity.") + axis[k], "m/s^2", {[k](Parameters& p) { return &p.gravity[k]; }}});
  const auto add_center = [&](const std::string& owner, const auto& place) {
    for (int k = 0; k < 3; ++k)
      entries.push_back(
          {owner + ".center_of_mass." + axis[k], "m", {[k, place](Parameters& p) { return &place(p)[k]; }}});
  };
  if (m.payload) {
    entries.push_back({"payload.mass", "kg", {[](Parameters& p) { return &p.payload_mass; }}});
    add_center("payload", [](Parameters& p) -> Vec3& { return p.payload_center; });
  }
  for (std::size_t b = 0; b < m.bodies.size(); ++b) {
    entries.push_back({"body." + m.bodies[b].name + ".mass", "kg", {[b](Parameters& p) { return &p.body_mass[b]; }}});
    add_center("body." + m.bodies[b].name, [b](Parameters& p) -> Vec3& { return p.body_center[b]; });
  }
  for (std::size_t c = 0; c < m.clearances.size(); ++c) {
    for (const Field<C>& f : kClearanceFields) {
      if (!belongs(f.name, m.clearances[c], m.joints[m.clearances[c].joint].type)) continue;
      Entry e{"clearance." + m.joints[m.clearances[c].joint].name + "." + f.name, f.unit, {}};
      for (auto place : {f.place, f.second_place})
        if (place) e.numbers.push_back([c, place](Parameters& p) { return place(p.clearance[c]); });
      entries.push_back(std::move(e));
    }
  }
  for (std::size_t s = 0; s < m.springs.size(); ++s) {
    const auto add = [&](const std::string& owner, const Field<S>& f) {
      entries.push_back(
          {owner + "." + f.name, f.unit, {[s, place = f.place](Parameters& p) { return place(p.spring[s]); }}});
    };
    for (const Field<S>& f : kSpringFields) add("spring." + std::to_string(s + 1), f);
    if (!m.springs[s].preloads.empty()) add("clearance." + m.springs[s].preloads, kPreload);
  }
  for (std::size_t e = 0; e < m.errors.size(); ++e)
    entries.push_back(
        {"error." + m.errors[e].name, unit_of(m.errors[e], m.joints), {[e](Parameters& p) { return &p.error[e]; }}});
  return entries;
}

// "clearance.*.radial" against "clearance.F1.radial": the middle part may be *. Names may themselves contain dots.
bool matches(const std::string& pattern, const std::string& path) {
  if (pattern == "error.*") return path.starts_with("error.");
  const std::size_t star = pattern.find(".*.");
  if (star == std::string::npos) return pattern == path;
  const std::string head = pattern.substr(0, star + 1), tail = pattern.substr(star + 2);
  return path.size() > head.size() + tail.size() && path.starts_with(head) && path.ends_with(tail) &&
         (head != "clearance." || std::count(tail.begin(), tail.end(), '.') > 1 ||
          (!path.ends_with(".contact" + tail) && !path.ends_with(".friction" + tail)));
}

// "radial, axial, contact.restitution ..., friction.coefficient ...": of names in order, the first of those that begin alike.
std::string listed(const std::vector<std::string>& names) {
  std::string text;
  std::vector<std::string> seen;
  for (const std::string& name : names) {
    const std::size_t dot = name.find('.');
    const std::string first = name.substr(0, dot);
    if (std::find(seen.begin(), seen.end(), first) != seen.end()) continue;
    seen.push_back(first);
    text += (text.empty() ? "" : ", ") + name + (dot == std::string::npos ? "" : " ...");
  }
  return text;
}

// What a path that names nothing may be instead, and the one that it may be a slip of. Not all that a file holds varies within a study:
// where joints stand, which law is in force.
std::pair<std::string, std::string> what_there_is(const std::vector<Entry>& entries, const std::string& path,
                                                  const std::string& mechanism) {
  const std::string of_all = "; anything else in the file has one value for a whole study, which --set changes";
  std::vector<std::string> names;
  for (const Entry& e : entries) names.push_back(e.path);
  // Of the longest beginning that some have: "clearance.F1.", not "clearance." alone.
  for (std::size_t dot = path.rfind('.'); dot != std::string::npos && path.find('.') < dot;
       dot = path.rfind('.', dot - 1)) {
    const std::string rest = path.substr(dot + 1);
    std::vector<std::string> own;
    std::string nearest;
    std::size_t least = std::max<std::size_t>(1, rest.size() / 3) + 1;  // further off it is no slip
    for (const std::string& name : names) {
      if (!name.starts_with(path.substr(0, dot + 1))) continue;
      own.push_back(name.substr(dot + 1));
      if (const std::size_t distance = edit_distance(rest, own.back()); distance < least) {
        least = distance;
        nearest = name;
      }
    }
    if (!own.empty()) return {"of " + path.substr(0, dot) + " one of " + listed(own) + of_all, nearest};
  }
  return {"a parameter path of " + mechanism + ": " + listed(names) + of_all, nearest_name(path, names)};
}

}  // namespace

ParameterPath::ParameterPath(const MechanismDescription& mechanism, const std::string& path, const Origin& origin)
    : path_(path) {
  const std::vector<Entry> entries = all_entries(mechanism);
  for (const Entry& e : entries) {
    if (!matches(path, e.path)) continue;
    if (!unit_.empty() && unit_ != e.unit)
      throw InputError(origin, path, "parameters in " + unit_ + " and in " + e.unit, "parameters of one unit");
    unit_ = e.unit;
    numbers_.insert(numbers_.end(), e.numbers.begin(), e.numbers.end());
  }
  if (!numbers_.empty()) return;
  const auto [expected, nearest] = what_there_is(entries, path, mechanism.name);
  throw InputError(origin, path, "no number that studies vary", expected, nearest);
}

double ParameterPath::get(const Parameters& parameters) const {
  // The accessors give a place to write to; reading through a copy keeps this function const in its meaning.
  Parameters copy = parameters;
  return *numbers_.front()(copy);
}

std::vector<double> ParameterPath::values(const Parameters& parameters) const {
  Parameters copy = parameters;
  std::vector<double> each;
  for (const auto& number : numbers_) each.push_back(*number(copy));
  if (std::equal(each.begin() + 1, each.end(), each.begin())) each.resize(1);
  return each;
}

void ParameterPath::set(Parameters& parameters, double value) const {
  for (const auto& number : numbers_) *number(parameters) = value;
}

bool ParameterPath::set(Parameters& parameters, const std::vector<double>& values) const {
  if (values.size() != 1 && values.size() != numbers_.size()) return false;
  for (std::size_t k = 0; k < numbers_.size(); ++k) *numbers_[k](parameters) = values[values.size() == 1 ? 0 : k];
  return true;
}

std::vector<std::string> parameter_paths(const MechanismDescription& mechanism) {
  std::vector<std::string> paths;
  for (const Entry& e : all_entries(mechanism)) paths.push_back(e.path);
  return paths;
}

std::vector<std::string> single_paths(const MechanismDescription& mechanism, const std::string& path) {
  if (path.find('*') == std::string::npos) return {path};
  Parameters marked = nominal_parameters(mechanism);
  ParameterPath(mechanism, path).set(marked, std::numeric_limits<double>::quiet_NaN());
  std::vector<std::string> single;
  for (const std::string& one : parameter_paths(mechanism))
    if (std::isnan(ParameterPath(mechanism, one).get(marked))) single.push_back(one);
  return single;
}

bool names_scales(const MechanismDescription& mechanism, const std::string& path) {
  bool any = false;
  for (const ErrorDescription& e : mechanism.errors) {
    if (!matches(path, "error." + e.name)) continue;
    if (!is_scale(e)) return false;
    any = true;
  }
  return any;
}

std::string differing_in_words(const std::vector<double>& values, const std::string& unit) {
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  char text[100];
  std::snprintf(text, sizeof text, "values from %.6g to %.6g%s%s", *low, *high, unit == "1" ? "" : " ",
                unit == "1" ? "" : unit.c_str());
  return text;
}

Parameters nominal_parameters(const MechanismDescription& mechanism) {
  Parameters p;
  p.gravity = mechanism.gravity;
  p.payload_mass = mechanism.payload ? mechanism.payload->mass : 0.0;
  if (mechanism.payload) p.payload_center = mechanism.payload->center_of_mass;
  for (const BodyDescription& b : mechanism.bodies) {
    p.body_mass.push_back(b.mass);
    p.body_center.push_back(b.center_of_mass);
  }
  for (const ClearanceDescription& c : mechanism.clearances) p.clearance.push_back(c.parameters);
  for (const SpringDescription& s : mechanism.springs) p.spring.push_back(s.parameters);
  for (const ErrorDescription& e : mechanism.errors) p.error.push_back(e.value);
  return p;
}

}  // namespace boresight
