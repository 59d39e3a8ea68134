#include "exchange/mechanism_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace boresight::app {
namespace {

// A TOML string; names and texts come from files of others.
std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f)
      out += fmt::format("\\u{:04x}", static_cast<unsigned char>(c));
    else
      out += c;
  }
  return out + "\"";
}

// For a comment, which ends with its line.
std::string one_line(std::string text) {
  for (char& c : text)
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = ' ';
  return text;
}

// Twelve digits; what is nothing beside `size` is zero, as rotated axes leave it behind.
std::string number(double value, double size) {
  return std::abs(value) <= 1e-13 * size ? "0" : fmt::format("{:.12g}", value);
}

std::string quantities(const Vec3& v, const std::string& unit, double size) {
  return fmt::format("[\"{0} {3}\", \"{1} {3}\", \"{2} {3}\"]", number(v[0], size), number(v[1], size),
                     number(v[2], size), unit);
}

std::string direction(const Vec3& v) {
  return fmt::format("[{}, {}, {}]", number(v[0], 1.0), number(v[1], 1.0), number(v[2], 1.0));
}

double size_of(const MechanismDescription& m) {
  double size = 1e-3;  // [m]
  for (const BodyDescription& b : m.bodies) size = std::max(size, b.center_of_mass.norm());
  for (const JointDescription& j : m.joints) size = std::max(size, j.point.norm());
  return size;
}

std::string body_text(const BodyDescription& body, double size) {
  std::string text = fmt::format("\n[[body]]\nname = {}\nmass = \"{:.12g} kg\"\ncenter_of_mass = {}\n",
                                 quoted(body.name), body.mass, quantities(body.center_of_mass, "m", size));
  if (!body.axes.isIdentity(1e-12))
    text += fmt::format("axes = {{ x = {}, z = {} }}\n", direction(body.axes.col(0)), direction(body.axes.col(2)));
  const Mat3& I = body.inertia;
  const double largest = I.cwiseAbs().maxCoeff();
  std::string list;
  for (const double moment : {I(0, 0), I(1, 1), I(2, 2), I(0, 1), I(0, 2), I(1, 2)})
    list += fmt::format("{}\"{} kg m^2\"", list.empty() ? "" : ", ", number(moment, largest));
  text += "inertia = [" + list + "]   # xx yy zz xy xz yz\n";
  if (body.boresight) text += "boresight = " + direction(*body.boresight) + "\n";
  return text;
}

std::string joint_text(const JointDescription& joint, const MechanismDescription& m, double size) {
  const auto name = [&](int body) { return quoted(body == kGround ? "ground" : m.bodies[body].name); };
  std::string text =
      fmt::format("\n[[joint]]\nname = {}\ntype = \"{}\"\nconnects = [{}, {}]\npoint = {}\n", quoted(joint.name),
                  to_string(joint.type), name(joint.first), name(joint.second), quantities(joint.point, "m", size));
  if (joint.type != JointType::spherical) text += "axis = " + direction(joint.axis) + "\n";
  if (joint.type == JointType::universal) text += "second_axis = " + direction(joint.second_axis) + "\n";
  if (joint.driven) text += "driven = true\n";
  return text;
}

std::string spring_text(const SpringDescription& spring, const MechanismDescription& m, double size) {
  const auto name = [&](int body) { return quoted(body == kGround ? "ground" : m.bodies[body].name); };
  const SpringParameters& p = spring.parameters;
  return fmt::format(
      "\n[[spring]]\nconnects = [{}, {}]\npoints = [{}, {}]\nstiffness = \"{:.12g} N/m\"\ndamping = \"{:.12g} N s/m\"\n"
      "free_length = \"{:.12g} m\"\n",
      name(spring.first), name(spring.second), quantities(spring.first_point, "m", size),
      quantities(spring.second_point, "m", size), p.stiffness, p.damping, p.free_length);
}

// What the file has none of yet, ready to be uncommented.
std::string play_text(const MechanismDescription& m) {
  const auto joint = std::find_if(m.joints.begin(), m.joints.end(),
                                  [](const JointDescription& j) { return j.type == JointType::revolute; });
  if (joint == m.joints.end()) return "";
  const int journal = joint->second == kGround ? joint->first : joint->second;
  return fmt::format(
      "\n# No joint has play yet. Without the #, this gives {0} some; its dimensions are to be changed into yours.\n"
      "# [[clearance]]\n# joint = {1}\n# journal = {2}\n# radial = \"20 um\"\n# axial = \"20 um\"\n"
      "# journal_radius = \"10 mm\"\n# cap_radius = \"15 mm\"\n# sleeve_length = \"20 mm\"\n# axes = \"parallel\"\n"
      "#   [clearance.contact]\n#   law = \"flores\"\n#   restitution = 0.9\n#   young = [\"206 GPa\", \"206 GPa\"]\n"
      "#   poisson = [0.3, 0.3]\n#   density = \"7800 kg/m^3\"\n#   [clearance.friction]\n#   law = "
      "\"modified-coulomb\"\n"
      "#   coefficient = 0.05\n#   static_speed = \"0.1 mm/s\"\n#   dynamic_speed = \"1 mm/s\"\n",
      one_line(joint->name), one_line(quoted(joint->name)), one_line(quoted(m.bodies[journal].name)));
}

std::string comments(const std::string& title, const std::vector<Remark>& remarks) {
  if (remarks.empty()) return "";
  std::string text = "#\n# " + title + "\n";
  for (const std::string& line : grouped(remarks)) text += "#   " + one_line(line) + "\n";
  return text;
}

}  // namespace

std::vector<std::string> grouped(const std::vector<Remark>& remarks) {
  std::vector<std::pair<std::string, std::vector<int>>> groups;
  for (const Remark& remark : remarks) {
    auto group = std::find_if(groups.begin(), groups.end(), [&](const auto& g) { return g.first == remark.text; });
    if (group == groups.end()) group = groups.insert(groups.end(), {remark.text, {}});
    if (remark.line > 0) group->second.push_back(remark.line);
  }
  std::vector<std::string> lines;
  for (auto& [text, at] : groups) {
    std::sort(at.begin(), at.end());
    std::string where;
    for (std::size_t i = 0; i < at.size(); ++i)
      where += (i == 0               ? (at.size() == 1 ? "line " : "lines ")
                : i + 1 == at.size() ? " and "
                                     : ", ") +
               std::to_string(at[i]);
    lines.push_back(where.empty() ? text : where + ": " + text);
  }
  return lines;
}

std::string mechanism_text(const Assembly& assembly, const std::string& source, const std::string& duration) {
  const MechanismDescription& m = assembly.mechanism;
  const double size = size_of(m);
  std::string text =
      fmt::format("# {}, imported from {}: its bodies, joints and gravity, at home, where every joint is at zero.\n",
                  one_line(m.name), one_line(source));
  text += comments("Assumed, to be checked:", assembly.assumed);
  text += comments("Left out:", assembly.left_out);
  text += fmt::format("\nformat = 1\nname = {}\ngravity = {}\n", quoted(m.name),
                      quantities(m.gravity, "m/s^2", std::max(1e-3, m.gravity.norm())));
  for (const BodyDescription& body : m.bodies) text += body_text(body, size);
  for (const JointDescription& joint : m.joints) text += joint_text(joint, m, size);
  for (const SpringDescription& spring : m.springs) text += spring_text(spring, m, size);
  text += "\n[motion]\nduration = " + quoted(duration) + "\n";
  if (!assembly.drives.empty()) {
    text += "[motion.drives]   # angles in rad, displacements in m, from home; t in s\n";
    for (const auto& [joint, course] : assembly.drives) text += quoted(joint) + " = " + quoted(course) + "\n";
  }
  return text + play_text(m);
}

}  // namespace boresight::app
