#include <map>
#include <set>

#include "boresight/mechanism/error.hpp"
#include "exchange/readers.hpp"
#include "exchange/xml_element.hpp"

namespace boresight::app {
namespace {

Placement origin_in(const XmlElement& parent) {
  const std::optional<XmlElement> origin = parent.child("origin");
  if (!origin) return {};
  return {turned_by(origin->vector("rpy", Vec3::Zero())), origin->vector("xyz", Vec3::Zero())};
}

// A joint with what its place follows from; angles and lengths are in its file's frames.
struct UrdfJoint {
  XmlElement element;
  std::string name, type, parent, child;
  Placement X_PC;  // of the child link in the parent link, at home
};

class UrdfReader {
 public:
  UrdfReader(const XmlElement& robot, const std::string& filename) : robot_(robot) {
    drawing_.file = filename;
    drawing_.format = "URDF";
    drawing_.name = robot.text("name", "");
    drawing_.assumed.push_back({0, "gravity is 9.81 m/s^2 against z: URDF does not say"});
  }

  Drawing read() {
    refuse_macros();
    for (const XmlElement& link : robot_.children("link")) add_link(link);
    if (drawing_.parts.empty()) robot_.fail("link", "no <link>", "a robot with links");
    if (part_named(drawing_, "world") < 0) add_world();
    for (const XmlElement& joint : robot_.children("joint")) add_joint(joint);
    place_links();
    for (std::size_t i = 0; i < drawing_.parts.size(); ++i) read_mass(static_cast<int>(i));
    for (const UrdfJoint& joint : joints_) connect(joint);
    read_drives();
    name_the_rest();
    return std::move(drawing_);
  }

 private:
  void refuse_macros() const {
    for (const XmlElement& element : robot_.children())
      if (element.tag().starts_with("xacro:"))
        element.fail(element.tag(), "a macro of xacro", "a URDF without macros: xacro FILE > FILE.urdf");
  }

  void add_link(const XmlElement& link) {
    const std::string name = link.text("name");
    if (part_named(drawing_, name) >= 0) link.fail("link.name", "\"" + name + "\" a second time", "a name of its own");
    if (drawing_.parts.size() == kMostParts)
      link.fail("link", "more than " + std::to_string(kMostParts) + " links", "fewer");
    Part& part = drawing_.parts.emplace_back();
    part.name = name;
    part.origin = link.origin();
    links_.push_back(link);
    for (const XmlElement& inside : link.children())
      if (inside.tag() == "visual" || inside.tag() == "collision")
        drawing_.left_out.push_back({inside.line(), "shapes: no body has one here"});
  }

  // What is fixed to "world" stands still, in files without a link of this name, too.
  void add_world() {
    for (const XmlElement& joint : robot_.children("joint"))
      if (const auto parent = joint.child("parent"); parent && parent->text("link", "") == "world") {
        Part& part = drawing_.parts.emplace_back();
        part.name = "world";
        part.origin = parent->origin();
        links_.push_back(*parent);
        return;
      }
  }

  std::string link_of(const XmlElement& joint, const std::string& tag) const {
    const XmlElement element = joint.needed(tag);
    const std::string name = element.text("link");
    if (part_named(drawing_, name) < 0) {
      std::vector<std::string> names;
      for (const Part& part : drawing_.parts) names.push_back(part.name);
      element.fail(tag + ".link", "\"" + name + "\"", "the name of a link", nearest_name(name, names));
    }
    return name;
  }

  void add_joint(const XmlElement& joint) {
    UrdfJoint read{
        joint,           joint.text("name"), joint.text("type"), link_of(joint, "parent"), link_of(joint, "child"),
        origin_in(joint)};
    for (const UrdfJoint& other : joints_) {
      if (other.name == read.name) joint.fail("joint.name", "\"" + read.name + "\" a second time", "a name of its own");
      if (other.child == read.child)
        joint.fail("child.link", "\"" + read.child + "\", which " + other.name + " moves already",
                   "a link that no other joint moves: URDF holds no loops");
    }
    joints_.push_back(std::move(read));
  }

  // From the link that no joint moves outwards.
  void place_links() {
    std::set<std::string> children;
    for (const UrdfJoint& joint : joints_) children.insert(joint.child);
    int root = -1;
    for (std::size_t i = 0; i < drawing_.parts.size(); ++i) {
      if (children.count(drawing_.parts[i].name) != 0) continue;
      if (root >= 0)
        links_[i].fail("link.name", "\"" + drawing_.parts[i].name + "\", which no joint connects",
                       "one link, not two, that no joint moves (" + drawing_.parts[root].name + " is one)");
      root = static_cast<int>(i);
    }
    if (root < 0) robot_.fail("joint", "joints in a circle", "one link that no joint moves");
    std::vector<bool> placed(drawing_.parts.size(), false);
    placed[root] = true;
    for (bool more = true; more;) {
      more = false;
      for (const UrdfJoint& joint : joints_) {
        const int parent = part_named(drawing_, joint.parent), child = part_named(drawing_, joint.child);
        if (!placed[parent] || placed[child]) continue;
        drawing_.parts[child].X_WP = drawing_.parts[parent].X_WP * joint.X_PC;
        placed[child] = more = true;
      }
    }
    for (std::size_t i = 0; i < placed.size(); ++i)
      if (!placed[i])
        links_[i].fail("link.name", "\"" + drawing_.parts[i].name + "\" in a circle of joints", "a tree of links");
    Connection& ground = drawing_.connections.emplace_back();
    ground.name = "ground of " + drawing_.parts[root].name;
    ground.type = JointType::fixed;
    ground.second = root;
    ground.origin = drawing_.parts[root].origin;
    if (links_[root].child("inertial"))
      drawing_.assumed.push_back(
          {ground.origin.line, drawing_.parts[root].name + " stands still: no joint moves it. Its mass is not needed"});
  }

  void read_mass(int index) {
    Part& part = drawing_.parts[index];
    const std::optional<XmlElement> inertial = links_[index].child("inertial");
    if (!inertial) {
      part.p_WC = part.X_WP.p;
      return;
    }
    Mat3 inertia = Mat3::Zero();
    if (const auto given = inertial->child("inertia")) {
      inertia.diagonal() << given->number("ixx"), given->number("iyy"), given->number("izz");
      inertia(0, 1) = inertia(1, 0) = given->number("ixy", 0.0);
      inertia(0, 2) = inertia(2, 0) = given->number("ixz", 0.0);
      inertia(1, 2) = inertia(2, 1) = given->number("iyz", 0.0);
    }
    set_mass(part, inertial->needed("mass").number("value"), origin_in(*inertial), inertia, inertial->origin());
  }

  void connect(const UrdfJoint& joint) {
    static const std::map<std::string, JointType> kTypes = {
        {"revolute", JointType::revolute}, {"continuous", JointType::revolute}, {"prismatic", JointType::prismatic},
        {"planar", JointType::planar},     {"fixed", JointType::fixed},         {"spherical", JointType::spherical}};
    if (joint.type == "floating") return;  // the link is free
    const auto type = kTypes.find(joint.type);
    if (type == kTypes.end())
      joint.element.fail("joint.type", "\"" + joint.type + "\"",
                         "revolute, continuous, prismatic, planar, fixed or floating");
    Connection& made = drawing_.connections.emplace_back();
    made.name = joint.name;
    made.type = type->second;
    made.origin = joint.element.origin();
    made.first = part_named(drawing_, joint.parent);
    made.second = part_named(drawing_, joint.child);
    const Placement& X_WC = drawing_.parts[made.second].X_WP;
    made.p_WJ = X_WC.p;
    if (made.type == JointType::fixed) return;
    const auto axis = joint.element.child("axis");
    const Vec3 given = axis ? axis->vector("xyz", Vec3::UnitX()) : Vec3(Vec3::UnitX());
    if (made.type != JointType::spherical)
      made.axis = X_WC.R * (axis ? *axis : joint.element).direction(given, "axis.xyz");
    read_extras(joint, made);
  }

  void read_extras(const UrdfJoint& joint, Connection& made) {
    const XmlElement& element = joint.element;
    if (const auto limit = element.child("limit")) {
      drawing_.left_out.push_back({limit->line(), "limits of joints: they go where [motion] says"});
      const double lower = limit->number("lower", 0.0), upper = limit->number("upper", 0.0);
      if (joint.type != "continuous" && lower < upper && (lower > 0.0 || upper < 0.0))
        drawing_.assumed.push_back(
            {limit->line(), "home is where " + joint.name + " is at zero, which is outside its limits"});
    }
    if (const auto dynamics = element.child("dynamics"))
      if (dynamics->number("damping", 0.0) != 0.0 || dynamics->number("friction", 0.0) != 0.0)
        drawing_.left_out.push_back({dynamics->line(), "damping and friction of " + joint.name});
    if (const auto mimic = element.child("mimic")) {
      made.mimic = Mimic{mimic->text("joint"), mimic->number("multiplier", 1.0), mimic->number("offset", 0.0)};
      bool known = false;
      for (const UrdfJoint& other : joints_) known = known || other.name == made.mimic->joint;
      if (!known) mimic->fail("mimic.joint", "\"" + made.mimic->joint + "\"", "the name of a joint");
    }
  }

  // What <transmission> and <ros2_control> move; where there is neither, everything that can be driven.
  void read_drives() {
    std::set<std::string> driven;
    bool named = false;
    for (const char* tag : {"transmission", "ros2_control"})
      for (const XmlElement& element : robot_.children(tag))
        for (const XmlElement& joint : element.children("joint")) {
          named = true;
          // What is only measured there moves as it likes.
          if (std::string(tag) == "transmission" || joint.child("command_interface")) driven.insert(joint.text("name"));
        }
    if (!named) drawing_.drives = "every joint that can be driven is: the file names no transmission";
    for (Connection& c : drawing_.connections)
      c.driven = (c.type == JointType::revolute || c.type == JointType::prismatic) &&
                 (!named || driven.count(c.name) != 0 || c.mimic.has_value());
  }

  void name_the_rest() {
    static const std::set<std::string> kKnown = {"link", "joint", "material", "transmission", "ros2_control"};
    for (const XmlElement& element : robot_.children())
      if (kKnown.count(element.tag()) == 0)
        drawing_.left_out.push_back({element.line(), "<" + element.tag() + ">: nothing of a mechanism file"});
  }

  XmlElement robot_;
  Drawing drawing_;
  std::vector<XmlElement> links_;  // of the parts
  std::vector<UrdfJoint> joints_;
};

}  // namespace

Drawing read_urdf(const std::string& text, const std::string& filename) {
  return UrdfReader(XmlElement::root_of(text, filename), filename).read();
}

}  // namespace boresight::app
