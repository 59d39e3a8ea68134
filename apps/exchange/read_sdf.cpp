#include <fmt/format.h>

#include <array>
#include <charconv>
#include <map>

#include "boresight/mechanism/error.hpp"
#include "exchange/readers.hpp"
#include "exchange/sdf_frames.hpp"
#include "exchange/xml_element.hpp"

namespace boresight::app {
namespace {

// "1.5" -> {1, 5}.
std::pair<int, int> version_of(const XmlElement& sdf) {
  const std::string text = sdf.text("version", "1.0");
  int major = 0, minor = 0;
  const char* const end = text.data() + text.size();
  const auto [dot, fault] = std::from_chars(text.data(), end, major);
  if (fault != std::errc() || dot == end || *dot != '.' || std::from_chars(dot + 1, end, minor).ec != std::errc())
    sdf.fail("sdf.version", "\"" + text + "\"", "a version such as 1.9");
  if (major != 1) sdf.fail("sdf.version", "\"" + text + "\"", "version 1");
  return {major, minor};
}

// Models: the parts and joints that their frames place.
class SdfReader {
 public:
  SdfReader(const XmlElement& root, const std::string& filename) : root_(root) {
    drawing_.file = filename;
    drawing_.format = "SDF";
    drawing_.gravity = Vec3(0.0, 0.0, -9.8);  // the specification's default
  }

  Drawing read() {
    version_ = version_of(root_);
    const std::vector<XmlElement> worlds = root_.children("world");
    for (std::size_t i = 1; i < worlds.size(); ++i) leave_out(worlds[i], "a second world");
    const XmlElement& place = worlds.empty() ? root_ : worlds.front();
    read_gravity(place);
    std::vector<XmlElement> models = place.children("model");
    for (const XmlElement& include : place.children("include")) left_include(include);
    if (models.empty()) place.fail("model", "no <model>", "a model with links");
    int moving = 0;
    for (const XmlElement& model : models) moving += is_static(model) ? 0 : 1;
    for (const XmlElement& model : models) {
      if (is_static(model)) {
        leave_out(model, model.text("name", "a model") + ": it is static");
        continue;
      }
      const std::string name = model.text("name");
      if (drawing_.name.empty()) drawing_.name = name;
      add_model(model, "", moving > 1 ? name : "", Placement(), true);
    }
    if (!worlds.empty())
      for (const XmlElement& joint : place.children("joint"))
        joint.fail("joint", "a joint between models", "joints within models");
    bool drives = false;
    for (Connection& c : drawing_.connections) drives = drives || c.driven;
    if (!drives) drawing_.drives = "no joint is driven: the file names no controller; --drive names joints that are";
    return std::move(drawing_);
  }

 private:
  struct Model {
    SdfFrames frames;
    std::string prefix;  // of its parts' names
    Placement X_WM;
  };

  void leave_out(const XmlElement& at, const std::string& what) { drawing_.left_out.push_back({at.line(), what}); }

  static bool is_static(const XmlElement& model) {
    const auto given = model.child("static");
    return given && given->content_flag();
  }

  void left_include(const XmlElement& include) {
    const auto uri = include.child("uri");
    leave_out(include,
              "the included model " + (uri ? uri->content() : std::string("without a name")) + ": import its own file");
  }

  void read_gravity(const XmlElement& place) {
    auto gravity = place.child("gravity");
    if (const auto physics = place.child("physics"); !gravity && physics) gravity = physics->child("gravity");
    if (gravity)
      drawing_.gravity = gravity->content_vector();
    else
      drawing_.assumed.push_back({0, "gravity is 9.8 m/s^2 against z, SDF's default"});
  }

  // outer: the name of the model that this one stands in, of a nested one; prefix: of its parts' names.
  void add_model(const XmlElement& element, const std::string& outer, const std::string& prefix, const Placement& X_WO,
                 bool with_pose) {
    Model model{SdfFrames(element), prefix.empty() ? "" : prefix + "::", X_WO};
    if (with_pose)
      if (const auto pose = element.child("pose")) {
        if (!pose->text("relative_to", "").empty() && outer.empty())
          pose->fail("pose.relative_to", "a model's pose in a frame of the world", "a pose in the world");
        model.X_WM = X_WO * raw_pose(*pose);
      }
    if (element.has("placement_frame"))
      element.fail("model.placement_frame", "a placement frame", "a model placed by its own frame");
    model.frames.check_canonical_link();
    for (const XmlElement& link : element.children("link")) add_link(link, model);
    for (const XmlElement& inner : element.children("model")) add_nested(inner, model);
    for (const XmlElement& include : element.children("include")) left_include(include);
    for (const XmlElement& joint : element.children("joint")) add_joint(joint, model);
    for (const char* tag : {"gripper", "actor"})
      for (const XmlElement& other : element.children(tag))
        leave_out(other, "<" + other.tag() + ">: nothing of a mechanism file");
    read_drives(element, model);
  }

  void add_link(const XmlElement& link, Model& model) {
    const std::string name = link.text("name");
    if (drawing_.parts.size() == kMostParts)
      link.fail("link", "more than " + std::to_string(kMostParts) + " links", "fewer");
    Part part;
    part.name = model.prefix + name;
    part.origin = link.origin();
    part.X_WP = model.X_WM * model.frames.placement(name, link, "link.name");
    double mass = 1.0;
    Mat3 inertia = Mat3::Identity();
    Placement X_PC;
    Origin origin = link.origin();
    if (const auto inertial = link.child("inertial")) {
      origin = inertial->origin();
      if (const auto pose = inertial->child("pose")) {
        const std::string in = pose->text("relative_to", pose->text("frame", ""));
        X_PC = raw_pose(*pose);
        if (!in.empty())
          X_PC = part.X_WP.inverse() * model.X_WM * model.frames.placement(in, *pose, "pose.relative_to") * X_PC;
      }
      // Resolved by SDF's own library from shapes and densities, of which nothing is read here.
      if (inertial->text("auto", "false") == "true" || inertial->text("auto", "false") == "1")
        inertial->fail("inertial.auto", "true", "mass and moments of inertia as numbers");
      if (const auto given = inertial->child("mass"))
        mass = given->content_number();
      else
        drawing_.assumed.push_back({origin.line, name + " has 1 kg, SDF's default"});
      const auto moments = inertial->child("inertia");
      const auto moment = [&](const char* tag, double otherwise) {
        const auto given = moments ? moments->child(tag) : std::nullopt;
        return given ? given->content_number() : otherwise;
      };
      inertia.diagonal() << moment("ixx", 1.0), moment("iyy", 1.0), moment("izz", 1.0);
      inertia(0, 1) = inertia(1, 0) = moment("ixy", 0.0);
      inertia(0, 2) = inertia(2, 0) = moment("ixz", 0.0);
      inertia(1, 2) = inertia(2, 1) = moment("iyz", 0.0);
      std::string missing;
      for (const char* tag : {"ixx", "iyy", "izz"})
        if (!moments || !moments->child(tag)) missing += (missing.empty() ? "" : ", ") + std::string(tag);
      if (!moments)
        drawing_.assumed.push_back({origin.line, name + " has moments of inertia of 1 kg m^2, SDF's default"});
      else if (!missing.empty())
        drawing_.assumed.push_back({moments->origin().line, name + " has " + missing + " of 1 kg m^2, SDF's default"});
    } else {
      drawing_.assumed.push_back({origin.line, name + " has 1 kg and moments of inertia of 1 kg m^2, SDF's default"});
    }
    set_mass(part, mass, X_PC, inertia, origin);
    drawing_.parts.push_back(part);
    for (const XmlElement& inside : link.children()) {
      if (inside.tag() == "visual" || inside.tag() == "collision") leave_out(inside, "shapes: no body has one here");
      if (inside.tag() == "sensor") leave_out(inside, "a sensor of " + name);
      if (inside.tag() == "gravity" && !inside.content_flag())
        leave_out(inside, name + " without gravity: it has it here");
    }
  }

  void add_nested(const XmlElement& inner, Model& model) {
    const std::string name = inner.text("name");
    const Placement X_WM = model.X_WM * model.frames.placement(name, inner, "model.name");
    add_model(inner, model.prefix + name, model.prefix + name, X_WM, false);
  }

  // The part that a joint connects; a frame stands for the link that it is attached to.
  int part_connected(const XmlElement& joint, const std::string& tag, Model& model) {
    const XmlElement element = joint.needed(tag);
    const std::optional<std::string> link = model.frames.link_of(element.content());
    if (link == "world") return kGround;
    if (const int part = link ? part_named(drawing_, model.prefix + *link) : -1; part >= 0) return part;
    std::vector<std::string> names;
    for (const Part& part : drawing_.parts) names.push_back(part.name);
    element.fail("joint." + tag, "\"" + element.content() + "\"", "the name of a link, or world",
                 nearest_name(element.content(), names));
  }

  void add_joint(const XmlElement& joint, Model& model) {
    static const std::map<std::string, JointType> kTypes = {
        {"revolute", JointType::revolute}, {"continuous", JointType::revolute}, {"prismatic", JointType::prismatic},
        {"ball", JointType::spherical},    {"universal", JointType::universal}, {"revolute2", JointType::universal},
        {"fixed", JointType::fixed}};
    const std::string word = joint.text("type"), name = joint.text("name");
    const auto type = kTypes.find(word);
    if (type == kTypes.end())
      joint.fail("joint.type", "\"" + word + "\"",
                 "revolute, continuous, prismatic, ball, universal, revolute2 or fixed");
    Connection made;
    made.name = model.prefix + name;
    made.type = type->second;
    made.origin = joint.origin();
    made.first = part_connected(joint, "parent", model);
    made.second = part_connected(joint, "child", model);
    if (made.first == made.second) joint.fail("joint.child", "the link that is the parent, too", "another link");
    const Placement X_MJ = model.frames.placement(name, joint, "joint.name");
    made.p_WJ = (model.X_WM * X_MJ).p;
    if (made.type != JointType::fixed && made.type != JointType::spherical) {
      made.axis = axis_of(joint, "axis", X_MJ, model);
      if (const auto axis = joint.child("axis"); axis && axis->child("mimic")) {
        const XmlElement mimic = *axis->child("mimic");
        const auto number = [&](const char* tag, double otherwise) {
          const auto given = mimic.child(tag);
          return given ? given->content_number() : otherwise;
        };
        // Follower = multiplier (leader - reference) + offset (SDF 1.11).
        const double multiplier = number("multiplier", 1.0);
        if (made.type == JointType::universal)
          leave_out(mimic, name + " moving with " + mimic.text("joint"));
        else
          made.mimic = Mimic{model.prefix + mimic.text("joint"), multiplier,
                             number("offset", 0.0) - multiplier * number("reference", 0.0)};
      }
      if (made.type == JointType::universal) {
        made.second_axis = axis_of(joint, "axis2", X_MJ, model);
        if (std::abs(made.axis.dot(made.second_axis)) > 1e-6)
          joint.fail("joint.axis2", "axes that are not perpendicular", "perpendicular axes of a " + word + " joint");
      }
    }
    drawing_.connections.push_back(made);
  }

  // World axes. Up to 1.4 given in the model's frame, from 1.5 on in the joint's, or that which it names.
  Vec3 axis_of(const XmlElement& joint, const std::string& tag, const Placement& X_MJ, Model& model) {
    const auto axis = joint.child(tag);
    Vec3 given = Vec3::UnitZ();
    Mat3 R_MA = version_.second <= 4 ? Mat3(Mat3::Identity()) : X_MJ.R;
    if (axis) {
      if (const auto xyz = axis->child("xyz")) {
        given = xyz->content_vector();
        if (const std::string in = xyz->text("expressed_in", ""); !in.empty())
          R_MA = model.frames.placement(in, *xyz, "xyz.expressed_in").R;
      }
      if (const auto old = axis->child("use_parent_model_frame"); old && old->content_flag()) R_MA.setIdentity();
      if (axis->child("limit")) leave_out(*axis->child("limit"), "limits of joints: they go where [motion] says");
      if (const auto dynamics = axis->child("dynamics"))
        for (const char* what : {"damping", "friction", "spring_stiffness"})
          if (const auto value = dynamics->child(what); value && value->content_number() != 0.0)
            leave_out(*value, std::string(what) + " of " + joint.text("name"));
    }
    return model.X_WM.R * (R_MA * joint.direction(given, tag + ".xyz"));
  }

  // Joints that a controller among the plugins names.
  void read_drives(const XmlElement& element, const Model& model) {
    for (const XmlElement& plugin : element.children("plugin")) {
      bool used = false;
      for (const XmlElement& inside : plugin.children()) {
        if (inside.tag() != "joint_name" && inside.tag() != "jointName") continue;
        for (Connection& c : drawing_.connections)
          if (c.name == model.prefix + inside.content() &&
              (c.type == JointType::revolute || c.type == JointType::prismatic) &&
              plugin.text("name", "").find("ontroller") != std::string::npos)
            c.driven = used = true;
      }
      if (!used) leave_out(plugin, "<plugin>: nothing of a mechanism file");
    }
  }

  XmlElement root_;
  std::pair<int, int> version_;
  Drawing drawing_;
};

}  // namespace

Drawing read_sdf(const std::string& text, const std::string& filename) {
  XmlElement root = XmlElement::root_of(text, filename);
  if (root.tag() != "sdf") root.fail(root.tag(), "<" + root.tag() + ">, a format before SDF 1.0's <sdf>", "<sdf>");
  return SdfReader(root, filename).read();
}

}  // namespace boresight::app
