#include <fmt/format.h>
#include <tinyxml2.h>

#include <algorithm>
#include <map>
#include <set>

#include "boresight/mechanism/error.hpp"
#include "exchange/shown_shapes.hpp"
#include "exchange/writers.hpp"

namespace boresight::app {
namespace {

std::string numbers(const Vec3& v) { return fmt::format("{} {} {}", v[0] + 0.0, v[1] + 0.0, v[2] + 0.0); }

// x y z and the quaternion x y z w: angles of three turns lose digits near their poles.
std::string pose_numbers(const Vec3& p, const Mat3& R) {
  const Quat q = Quat(R).normalized();
  return fmt::format("{} {} {} {} {}", numbers(p), q.x(), q.y(), q.z(), q.w());
}

class SdfWriter {
 public:
  explicit SdfWriter(const Mechanism& mechanism) : mechanism_(mechanism), m_(mechanism.description()) {}

  Written write() {
    open("sdf");
    printer_.PushAttribute("version", "1.9");
    open("world");
    attribute("name", "world");
    element("gravity", numbers(m_.gravity));
    open("model");
    attribute("name", sdf_name(m_.name));
    const std::vector<MassProperties> masses = mechanism_.mass_properties(mechanism_.parameters());
    for (int b = 0; b < mechanism_.bodies(); ++b) write_body(b, masses[b]);
    for (const JointDescription& joint : m_.joints) write_joint(joint);
    for (const JointDescription& joint : m_.joints)
      if (joint.driven) write_controller(joint);
    for (int k = 0; k < 3; ++k) printer_.CloseElement();
    Written written{printer_.CStr(), not_written(mechanism_, false)};
    if (between_ > 0)
      written.left_out.push_back(
          fmt::format("nothing of {} cylindrical and planar joints, but SDF has no such: links of {:.2g} kg stand "
                      "between the joints that they are made of",
                      between_, between_mass(mechanism_)));
    return written;
  }

 private:
  void open(const char* tag) { printer_.OpenElement(tag); }
  void attribute(const char* name, const std::string& text) { printer_.PushAttribute(name, text.c_str()); }
  void element(const char* tag, const std::string& text) {
    open(tag);
    printer_.PushText(text.c_str());
    printer_.CloseElement();
  }
  void pose(const Vec3& p, const Mat3& R, const char* in = nullptr) {
    open("pose");
    if (in != nullptr) printer_.PushAttribute("relative_to", in);
    attribute("rotation_format", "quat_xyzw");
    printer_.PushText(pose_numbers(p, R).c_str());
    printer_.CloseElement();
  }

  // SDF keeps "world", "::" and names with two underscores in front for itself, and has one list of names in a model.
  std::string sdf_name(std::string name) {
    for (std::size_t at; (at = name.find("::")) != std::string::npos;) name.replace(at, 2, "_");
    if (name == "world" || name.starts_with("__")) name = "a" + name;
    return name;
  }
  std::string own_name(const std::string& wanted) {
    std::string name = sdf_name(wanted);
    for (int k = 2; !taken_.insert(name).second; ++k) name = sdf_name(wanted) + "_" + std::to_string(k);
    return name;
  }
  std::string link_name(int body) const { return body == kGround ? "world" : links_[body]; }

  void inertial(double mass, const Vec3& c, const Mat3& inertia) {
    open("inertial");
    pose(c, Mat3::Identity());
    element("mass", fmt::format("{}", mass));
    open("inertia");
    const char* const tags[] = {"ixx", "iyy", "izz", "ixy", "ixz", "iyz"};
    const int rows[] = {0, 1, 2, 0, 0, 1}, columns[] = {0, 1, 2, 1, 2, 2};
    for (int k = 0; k < 6; ++k) element(tags[k], fmt::format("{}", inertia(rows[k], columns[k])));
    printer_.CloseElement();
    printer_.CloseElement();
  }

  void write_body(int b, const MassProperties& mass) {
    const BodyDescription& body = m_.bodies[b];
    links_.push_back(own_name(body.name));
    open("link");
    attribute("name", links_.back());
    pose(body.center_of_mass, body.axes);
    inertial(mass.mass, mass.c, mass.inertia);
    int count = 0;
    for (const Bar& bar : bars_of(mechanism_, b)) {
      open("visual");
      attribute("name", fmt::format("{}{}", bar.pointer ? "boresight" : "bar", ++count));
      pose(0.5 * (bar.from_B + bar.to_B),
           Quat::FromTwoVectors(Vec3::UnitZ(), bar.to_B - bar.from_B).toRotationMatrix());
      open("geometry");
      open("cylinder");
      element("radius", fmt::format("{:.4g}", bar_radius(mechanism_) * (bar.pointer ? 0.4 : 1.0)));
      element("length", fmt::format("{:.6g}", (bar.to_B - bar.from_B).norm()));
      for (int k = 0; k < 3; ++k) printer_.CloseElement();
    }
    printer_.CloseElement();
  }

  void axis(const char* tag, const Vec3& direction) {
    open(tag);
    open("xyz");
    printer_.PushAttribute("expressed_in", "__model__");
    printer_.PushText(numbers(direction).c_str());
    printer_.CloseElement();
    printer_.CloseElement();
  }

  void one_joint(const std::string& name, const char* type, const std::string& parent, const std::string& child,
                 const Vec3& point, const Vec3* first, const Vec3* second) {
    const std::string own = own_name(name);
    joints_.emplace(name, own);
    open("joint");
    attribute("name", own);
    printer_.PushAttribute("type", type);
    pose(point, Mat3::Identity(), "__model__");
    element("parent", parent);
    element("child", child);
    if (first != nullptr) axis("axis", *first);
    if (second != nullptr) axis("axis2", *second);
    printer_.CloseElement();
  }

  // A link that stands for nothing but a freedom more.
  std::string between(const JointDescription& joint) {
    const double mass = between_mass(mechanism_), radius = 0.1 * mechanism_.characteristic_length();
    const std::string name = own_name(joint.name + " between");
    open("link");
    attribute("name", name);
    pose(joint.point, Mat3::Identity());
    inertial(mass, Vec3::Zero(), mass * radius * radius * Mat3::Identity());
    printer_.CloseElement();
    return name;
  }

  void write_joint(const JointDescription& j) {
    std::string first = link_name(j.first), second = link_name(j.second);
    Vec3 along = j.axis, second_axis = j.second_axis;
    if (j.second == kGround) {  // a joint's child is a link
      std::swap(first, second);
      along = j.type == JointType::universal ? j.second_axis : Vec3(-j.axis);
      second_axis = j.axis;
    }
    switch (j.type) {
      case JointType::revolute:
        return one_joint(j.name, "revolute", first, second, j.point, &along, nullptr);
      case JointType::prismatic:
        return one_joint(j.name, "prismatic", first, second, j.point, &along, nullptr);
      case JointType::universal:
        return one_joint(j.name, "universal", first, second, j.point, &along, &second_axis);
      case JointType::spherical:
        return one_joint(j.name, "ball", first, second, j.point, nullptr, nullptr);
      case JointType::fixed:
        return one_joint(j.name, "fixed", first, second, j.point, nullptr, nullptr);
      case JointType::cylindrical: {
        ++between_;
        const std::string link = between(j);
        one_joint(j.name + " slide", "prismatic", first, link, j.point, &along, nullptr);
        return one_joint(j.name + " turn", "revolute", link, second, j.point, &along, nullptr);
      }
      case JointType::planar: {
        ++between_;
        const Vec3 u = along.unitOrthogonal(), v = along.cross(u);
        const std::string one = between(j), two = between(j);
        one_joint(j.name + " slide", "prismatic", first, one, j.point, &u, nullptr);
        one_joint(j.name + " slide across", "prismatic", one, two, j.point, &v, nullptr);
        return one_joint(j.name + " turn", "revolute", two, second, j.point, &along, nullptr);
      }
    }
  }

  // Holds a driven joint where it is told to be; the import finds by it which joints are driven.
  void write_controller(const JointDescription& joint) {
    open("plugin");
    printer_.PushAttribute("filename", "gz-sim-joint-position-controller-system");
    printer_.PushAttribute("name", "gz::sim::systems::JointPositionController");
    element("joint_name", joints_.at(joint.name));
    printer_.CloseElement();
  }

  const Mechanism& mechanism_;
  const MechanismDescription& m_;
  tinyxml2::XMLPrinter printer_;
  std::set<std::string> taken_;
  std::vector<std::string> links_;             // of the bodies
  std::map<std::string, std::string> joints_;  // names here by their names in the mechanism
  int between_ = 0;
};

}  // namespace

Written sdf_of(const Mechanism& mechanism) { return SdfWriter(mechanism).write(); }

}  // namespace boresight::app
