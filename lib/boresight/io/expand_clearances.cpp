// What a [[clearance]] on two bearings stands for, written out: a bearing pair on a revolute joint, a cross on a universal one.
//
//   pair       NAME revolute, with drive and play, half a span before or behind the joint's point; NAME.floating cylindrical, at the other end;
//              where it is preloaded, a spring along the shaft
//   universal  a body NAME.cross, which carries the journals; NAME.first revolute between the first body and the cross, along axis;
//              NAME.second revolute between the cross and the second body, along second_axis
//
// Users' names have no dots, so these are nobody else's. What comes out is what the rest of the program knows anyway.
#include <algorithm>
#include <charconv>
#include <map>

#include "boresight/io/mechanism_sections.hpp"
#include "boresight/keys/mechanism_keys.hpp"
#include "boresight/keys/numbers_together.hpp"
#include "boresight/mechanism/error.hpp"

namespace boresight {
namespace {

using Members = std::vector<std::pair<std::string, Node>>;

Node text_node(const std::string& text, int line) {
  Node node;
  node.kind = Node::Kind::string;
  node.text = text;
  node.line = line;
  return node;
}

Node list_node(const std::vector<std::string>& texts, int line) {
  Node node;
  node.kind = Node::Kind::array;
  node.line = line;
  for (const std::string& text : texts) node.items.push_back(text_node(text, line));
  return node;
}

// So that reading it gives the same number.
std::string written(double value, const char* unit) {
  char text[40];
  return std::string(text, std::to_chars(text, text + sizeof text, value).ptr) + " " + unit;
}

void put(Node& table, const std::string& key, Node value) {
  for (auto& [name, node] : table.members)
    if (name == key) {
      node = std::move(value);
      return;
    }
  table.members.emplace_back(key, std::move(value));
}

// The table without the keys that only a shorthand has.
Node without_shorthand(const Node& table) {
  const std::vector<std::string> own = two_bearing_keys();
  Node plain = table;
  std::erase_if(plain.members,
                [&](const auto& member) { return std::find(own.begin(), own.end(), member.first) != own.end(); });
  return plain;
}

void refuse(const Cursor& cursor, const std::vector<const char*>& keys, const std::string& found,
            const std::string& expected) {
  for (const char* key : keys)
    if (cursor.has_by_name(key)) cursor.fail_found(key, found, expected);
}

class Expansion {
 public:
  explicit Expansion(MechanismDescription& mechanism) : mechanism_(mechanism) {}

  std::vector<Cursor> of(const Cursor& clearance) {
    Cursor cursor = clearance;
    cursor.only(clearance_keys());
    const std::string name = cursor.text("joint");
    if (const auto before = lines_.find(name); before != lines_.end())
      cursor.fail_found("joint",
                        in_quotes(name) + " a second time (first in line " + std::to_string(before->second) + ")",
                        "one clearance per joint");
    const auto joint = std::find_if(mechanism_.joints.begin(), mechanism_.joints.end(),
                                    [&](const JointDescription& j) { return j.name == name; });
    if (joint == mechanism_.joints.end()) return {clearance};
    const auto index = static_cast<std::size_t>(joint - mechanism_.joints.begin());
    cursor.rename("clearance." + name);
    const bool pair = cursor.choice("bearing") == "pair", universal = joint->type == JointType::universal;
    if (pair && joint->type != JointType::revolute)
      cursor.fail_found("bearing", "\"pair\" on " + in_quotes(name) + ", a " + to_string(joint->type) + " joint",
                        "it on a revolute joint: a shaft that turns in two bearings");
    if (!pair)
      refuse(cursor, {"span", "fixed_end", "floating", "preload", "preload_stiffness"}, "it on a single bearing",
             "it with bearing = \"pair\"");
    if (!universal)
      refuse(cursor, {"cross_mass", "cross_radius", "cross_inertia"},
             "it on " + in_quotes(name) + ", a " + to_string(joint->type) + " joint", "it on a universal joint");
    if (!pair && !universal) return {clearance};
    lines_[name] = cursor.origin().line;
    return pair ? of_pair(cursor, index) : of_universal(cursor, index);
  }

 private:
  std::vector<Cursor> of_pair(Cursor& cursor, std::size_t index) {
    const std::string name = mechanism_.joints[index].name;
    const double span = cursor.quantity("span");
    const double way = cursor.choice("fixed_end") == "start" ? 0.5 * span : -0.5 * span;
    Node fixed = without_shorthand(cursor.node());
    if (fixed.member("axes") == nullptr) put(fixed, "axes", text_node("free", fixed.line));

    Node floating = fixed;
    put(floating, "joint", text_node(name + ".floating", fixed.line));
    std::erase_if(floating.members,
                  [](const auto& member) { return member.first == "axial" || member.first == "cap_radius"; });
    if (cursor.has("floating")) {
      Cursor own = cursor.table("floating");
      own.only(floating_bearing_keys());
      for (const auto& [key, node] : own.node().members) put(floating, key, node);
    }
    std::vector<Cursor> both = {cursor.standing_for(std::move(fixed), cursor.path()),
                                cursor.standing_for(std::move(floating), cursor.path() + ".floating")};
    check_span(cursor, span, both);

    JointDescription& joint = mechanism_.joints[index];
    JointDescription other = joint;
    other.name = name + ".floating";
    other.type = JointType::cylindrical;
    other.driven = false;
    other.origin = cursor.origin();
    joint.point -= way * joint.axis;
    other.point += way * joint.axis;
    add_preload(cursor, joint, other.point);
    mechanism_.joints.insert(mechanism_.joints.begin() + static_cast<std::ptrdiff_t>(index) + 1, std::move(other));
    return both;
  }

  // A spring from the housing at the floating bearing to the shaft at the fixed one, a span long at home.
  void add_preload(Cursor& cursor, const JointDescription& fixed, const Vec3& floating) {
    if (!cursor.has("preload")) {
      refuse(cursor, {"preload_stiffness"}, "it without a preload", "it with preload");
      return;
    }
    SpringDescription spring;
    spring.preloads = fixed.name;
    spring.origin = cursor.origin();
    const int shaft = read_journal(cursor, mechanism_, fixed);
    spring.first = shaft == fixed.first ? fixed.second : fixed.first;
    spring.second = shaft;
    spring.first_point = floating;
    spring.second_point = fixed.point;
    if (cursor.has("preload_stiffness")) spring.parameters.stiffness = cursor.quantity("preload_stiffness");
    spring.parameters.free_length = (fixed.point - floating).norm();
    spring.parameters.preload = cursor.quantity("preload");
    mechanism_.springs.push_back(spring);
  }

  static void check_span(const Cursor& cursor, double span, std::vector<Cursor> bearings) {
    double sleeves = 0.0;
    for (Cursor& bearing : bearings) {
      bearing.only(clearance_keys());
      if (bearing.has("sleeve_length")) sleeves += 0.5 * bearing.quantity("sleeve_length");
    }
    cursor.require(span >= sleeves, "span", kSleevesApart);
  }

  std::vector<Cursor> of_universal(Cursor& cursor, std::size_t index) {
    const JointDescription joint = mechanism_.joints[index];
    refuse(cursor, {"journal"}, "it on " + in_quotes(joint.name) + ", a universal joint",
           "no journal: the cross carries the journals of both bearings");
    const int cross = add_cross(cursor, joint);
    JointDescription first = joint, second = joint;
    first.type = second.type = JointType::revolute;
    first.origin = second.origin = cursor.origin();
    first.second_axis = second.second_axis = JointDescription().second_axis;
    first.name = joint.name + ".first";
    first.second = cross;
    second.name = joint.name + ".second";
    second.first = cross;
    second.axis = joint.second_axis;
    mechanism_.joints[index] = first;
    mechanism_.joints.insert(mechanism_.joints.begin() + static_cast<std::ptrdiff_t>(index) + 1, second);

    std::vector<Cursor> both;
    for (const char* part : {".first", ".second"}) {
      Node table = without_shorthand(cursor.node());
      put(table, "joint", text_node(joint.name + part, table.line));
      put(table, "journal", text_node(joint.name + ".cross", table.line));
      both.push_back(cursor.standing_for(std::move(table), cursor.path() + part));
    }
    return both;
  }

  // Its axes are the joint's two and the one across both. Two thin rods of half the mass and of length 2 r each, crossing in their
  // middles, have m r^2 / 6 about either rod and m r^2 / 3 across both.
  int add_cross(Cursor& cursor, const JointDescription& joint) {
    const double mass = cursor.quantity("cross_mass");
    const bool inertia = cursor.has("cross_inertia"), radius = cursor.has("cross_radius");
    if (inertia && radius) cursor.fail_found("cross_radius", "both cross_inertia and cross_radius", "one of the two");
    if (!inertia && !radius)
      cursor.fail_found("cross_radius", "neither cross_radius nor cross_inertia", "one of the two");
    std::vector<double> moments;
    if (inertia) {
      moments = cursor.quantities("cross_inertia");
    } else {
      const double r = cursor.quantity("cross_radius");
      moments = {mass * r * r / 6.0, mass * r * r / 6.0, mass * r * r / 3.0};
    }
    const int line = cursor.origin().line;
    Node table;
    table.line = line;
    put(table, "mass", text_node(written(mass, "kg"), line));
    std::vector<std::string> point, inertias;
    for (const double x : joint.point) point.push_back(written(x, "m"));
    for (const double moment : moments) inertias.push_back(written(moment, "kg m^2"));
    put(table, "center_of_mass", list_node(point, line));
    put(table, "inertia", list_node(inertias, line));

    BodyDescription body;
    body.name = joint.name + ".cross";
    body.origin = cursor.origin();
    Cursor numbers = cursor.standing_for(std::move(table), "body." + body.name);
    numbers.only(body_keys());
    read_mass_and_axes(numbers, body);
    body.axes << joint.axis, joint.second_axis, joint.axis.cross(joint.second_axis);
    mechanism_.bodies.push_back(std::move(body));
    return static_cast<int>(mechanism_.bodies.size()) - 1;
  }

  MechanismDescription& mechanism_;
  std::map<std::string, int> lines_;  // joints whose clearance has been written out
};

}  // namespace

std::vector<Cursor> expand_clearances(const std::vector<Cursor>& clearances, MechanismDescription& mechanism) {
  std::vector<Cursor> all;
  Expansion expansion(mechanism);
  for (const Cursor& clearance : clearances)
    for (Cursor& one : expansion.of(clearance)) all.push_back(std::move(one));
  return all;
}

}  // namespace boresight
