#include <fmt/format.h>
#include <tinyxml2.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <set>

#include "exchange/shown_shapes.hpp"
#include "exchange/writers.hpp"

namespace boresight::app {
namespace {

std::string list(const Vec3& v) { return fmt::format("{} {} {}", v[0] + 0.0, v[1] + 0.0, v[2] + 0.0); }

std::string quaternion(const Mat3& R) {
  const Quat q = Quat(R).normalized();
  return fmt::format("{} {} {} {}", q.w(), q.x(), q.y(), q.z());
}

// Bodies hang in each other by the joints of a tree; what a tree lacks of a loop is an equality: a ball connects, and another joint
// gets a body of hardly any mass, which hangs by that joint and is welded to where it belongs.
class MjcfWriter {
 public:
  explicit MjcfWriter(const Mechanism& mechanism)
      : mechanism_(mechanism), m_(mechanism.description()), masses_(mechanism.mass_properties(mechanism.parameters())) {
    // Names of one kind differ. Those of the file come first, so that what is added makes way for them.
    for (const BodyDescription& body : m_.bodies) body_names_.push_back(own_name(taken_by_bodies_, body.name));
    for (const JointDescription& joint : m_.joints) taken_by_joints_.insert(joint.name);
    for (const JointDescription& joint : m_.joints) ends_.push_back(own_name(taken_by_bodies_, joint.name + " end"));
  }

  Written write() {
    choose_tree();
    open("mujoco");
    attribute("model", m_.name);
    open("compiler");
    printer_.PushAttribute("angle", "radian");
    printer_.PushAttribute("autolimits", "true");
    printer_.CloseElement();
    open("option");
    attribute("gravity", list(m_.gravity));
    printer_.CloseElement();
    open("default");
    open("geom");
    printer_.PushAttribute("contype", "0");
    printer_.PushAttribute("conaffinity", "0");
    printer_.CloseElement();
    printer_.CloseElement();
    open("worldbody");
    write_sites(kGround);
    for (int b = 0; b < mechanism_.bodies(); ++b)
      if (parent_[b] == kGround) write_body(b);
    write_cuts(kGround);
    printer_.CloseElement();
    write_equalities();
    write_tendons();
    write_actuators();
    printer_.CloseElement();
    Written written{printer_.CStr(), not_written(mechanism_, true)};
    return written;
  }

 private:
  void open(const char* tag) { printer_.OpenElement(tag); }
  void attribute(const char* name, const std::string& text) { printer_.PushAttribute(name, text.c_str()); }

  static std::string own_name(std::set<std::string>& taken, const std::string& wanted) {
    std::string name = wanted;
    for (int k = 2; !taken.insert(name).second; ++k) name = fmt::format("{} {}", wanted, k);
    return name;
  }

  // From the ground outwards; balls are the last that the tree takes, as they close a loop best.
  void choose_tree() {
    const int n = mechanism_.bodies();
    parent_.assign(n, kGround);
    by_.assign(n, -1);
    std::vector<bool> reached(n, false);
    const auto is_reached = [&](int body) { return body == kGround || reached[body]; };
    const auto grow = [&] {
      for (const bool with_balls : {false, true})
        for (std::size_t j = 0; j < m_.joints.size(); ++j) {
          const JointDescription& joint = m_.joints[j];
          if (!with_balls && joint.type == JointType::spherical) continue;
          if (is_reached(joint.first) == is_reached(joint.second)) continue;
          const int child = is_reached(joint.first) ? joint.second : joint.first;
          parent_[child] = child == joint.second ? joint.first : joint.second;
          by_[child] = static_cast<int>(j);
          reached[child] = true;
          return true;
        }
      return false;
    };
    for (int free = 0; free < n; ++free) {
      while (grow()) {
      }
      if (!reached[free]) reached[free] = true;  // hangs by nothing: free
    }
    while (grow()) {
    }
    in_tree_.assign(m_.joints.size(), false);
    for (const int j : by_)
      if (j >= 0) in_tree_[j] = true;
  }

  // Of a body's frame, at its centre of mass along its axes, in its parent's.
  void place(const Vec3& p_W, const Mat3& R_W, int parent) {
    const Vec3 p = parent == kGround ? Vec3(Vec3::Zero()) : m_.bodies[parent].center_of_mass;
    const Mat3 R = parent == kGround ? Mat3(Mat3::Identity()) : m_.bodies[parent].axes;
    attribute("pos", list(R.transpose() * (p_W - p)));
    attribute("quat", quaternion(R.transpose() * R_W));
  }
  Vec3 in_body(int body, const Vec3& p_W) const {
    return body == kGround ? p_W : Vec3(m_.bodies[body].axes.transpose() * (p_W - m_.bodies[body].center_of_mass));
  }

  void write_body(int b) {
    const BodyDescription& body = m_.bodies[b];
    open("body");
    attribute("name", body_names_[b]);
    place(body.center_of_mass, body.axes, parent_[b]);
    if (by_[b] >= 0) {
      write_joints(m_.joints[by_[b]], m_.joints[by_[b]].second == b, body.center_of_mass, body.axes);
    } else {
      open("freejoint");
      printer_.CloseElement();
    }
    write_inertial(masses_[b].mass, masses_[b].c, masses_[b].inertia);
    for (const Bar& bar : bars_of(mechanism_, b)) {
      open("geom");
      printer_.PushAttribute("type", "capsule");
      attribute("fromto", list(bar.from_B) + " " + list(bar.to_B));
      attribute("size", fmt::format("{:.4g}", bar_radius(mechanism_) * (bar.pointer ? 0.4 : 1.0)));
      if (bar.pointer) printer_.PushAttribute("rgba", "0.8 0.1 0.1 1");
      printer_.CloseElement();
    }
    write_sites(b);
    for (int child = 0; child < mechanism_.bodies(); ++child)
      if (parent_[child] == b) write_body(child);
    write_cuts(b);
    printer_.CloseElement();
  }

  void write_inertial(double mass, const Vec3& c, Mat3 I) {
    // MuJoCo takes no plate whose moments miss A + B = C by rounding.
    constexpr double kSpare = 1e-12;
    const Vec3 moments = Eigen::SelfAdjointEigenSolver<Mat3>(I, Eigen::EigenvaluesOnly).eigenvalues();
    if (const double lack = moments[2] * (1.0 + kSpare) - moments[0] - moments[1]; lack > 0.0)
      I.diagonal().array() += lack;
    open("inertial");
    attribute("pos", list(c));
    attribute("mass", fmt::format("{}", mass));
    attribute("fullinertia", fmt::format("{} {} {} {} {} {}", I(0, 0), I(1, 1), I(2, 2), I(0, 1), I(0, 2), I(1, 2)));
    printer_.CloseElement();
  }

  // The joints of MJCF that one joint is, in a body of which the frame is given.
  void write_joints(const JointDescription& joint, bool child_is_second, const Vec3& p_WB, const Mat3& R_WB) {
    const double sign = child_is_second ? 1.0 : -1.0;
    int count = 0;
    const auto one = [&](const char* type, const Vec3& axis) {
      open("joint");
      attribute("name",
                ++count == 1 ? joint.name : own_name(taken_by_joints_, fmt::format("{} {}", joint.name, count)));
      printer_.PushAttribute("type", type);
      attribute("pos", list(R_WB.transpose() * (joint.point - p_WB)));
      if (std::string(type) != "ball") attribute("axis", list(R_WB.transpose() * axis));
      printer_.CloseElement();
    };
    const Vec3 along = sign * joint.axis;
    switch (joint.type) {
      case JointType::revolute:
        return one("hinge", along);
      case JointType::prismatic:
        return one("slide", along);
      case JointType::cylindrical:
        one("slide", along);
        return one("hinge", along);
      case JointType::universal:  // the axis that is fixed in the parent comes first
        one("hinge", child_is_second ? joint.axis : joint.second_axis);
        return one("hinge", child_is_second ? joint.second_axis : joint.axis);
      case JointType::spherical:
        return one("ball", along);
      case JointType::planar: {
        const Vec3 u = joint.axis.unitOrthogonal();
        one("slide", u);
        one("slide", joint.axis.cross(u));
        return one("hinge", along);
      }
      case JointType::fixed:
        return;
    }
  }

  // Of the joints beyond the tree: what hangs in their first body.
  void write_cuts(int body) {
    for (std::size_t j = 0; j < m_.joints.size(); ++j) {
      const JointDescription& joint = m_.joints[j];
      if (in_tree_[j] || joint.first != body || joint.type == JointType::spherical || joint.type == JointType::fixed)
        continue;
      const double mass = between_mass(mechanism_), radius = 0.1 * mechanism_.characteristic_length();
      open("body");
      attribute("name", ends_[j]);
      place(joint.point, Mat3::Identity(), body);
      write_joints(joint, true, joint.point, Mat3::Identity());
      write_inertial(mass, Vec3::Zero(), mass * radius * radius * Mat3::Identity());
      printer_.CloseElement();
    }
  }

  void write_equalities() {
    open("equality");
    std::set<std::string> taken;
    for (std::size_t j = 0; j < m_.joints.size(); ++j) {
      const JointDescription& joint = m_.joints[j];
      if (in_tree_[j]) continue;
      const bool ball = joint.type == JointType::spherical;
      const int first = joint.first, second = joint.second;
      open(ball ? "connect" : "weld");
      attribute("name", own_name(taken, joint.name + (ball ? "" : " closed")));
      if (ball || joint.type == JointType::fixed) {
        // The first body that is named is one that moves.
        const int a = first == kGround ? second : first, b = first == kGround ? first : second;
        attribute("body1", body_names_[a]);
        if (b != kGround) attribute("body2", body_names_[b]);
        if (ball) attribute("anchor", list(in_body(a, joint.point)));
      } else {
        attribute("body1", ends_[j]);
        if (second != kGround) attribute("body2", body_names_[second]);
      }
      printer_.CloseElement();
    }
    printer_.CloseElement();
  }

  std::string site(std::size_t spring, int end) const {
    return fmt::format("spring {} {}", spring + 1, end == 0 ? "from" : "to");
  }

  void write_sites(int body) {
    for (std::size_t s = 0; s < m_.springs.size(); ++s)
      for (int end = 0; end < 2; ++end) {
        if ((end == 0 ? m_.springs[s].first : m_.springs[s].second) != body) continue;
        open("site");
        attribute("name", site(s, end));
        attribute("pos", list(in_body(body, end == 0 ? m_.springs[s].first_point : m_.springs[s].second_point)));
        printer_.CloseElement();
      }
  }

  void write_tendons() {
    open("tendon");
    for (std::size_t s = 0; s < m_.springs.size(); ++s) {
      const SpringParameters& p = m_.springs[s].parameters;
      // A force that no length changes: a spring as soft as its own length lets it be.
      const double stiffness = p.preload > 0.0 && p.stiffness == 0.0 ? p.preload / p.free_length : p.stiffness;
      open("spatial");
      attribute("name", fmt::format("spring {}", s + 1));
      attribute("stiffness", fmt::format("{}", stiffness));
      attribute("damping", fmt::format("{}", p.damping));
      attribute("springlength",
                fmt::format("{}", p.preload > 0.0 ? p.free_length + p.preload / stiffness : p.free_length));
      for (int end = 0; end < 2; ++end) {
        open("site");
        attribute("site", site(s, end));
        printer_.CloseElement();
      }
      printer_.CloseElement();
    }
    printer_.CloseElement();
  }

  void write_actuators() {
    open("actuator");
    for (const JointDescription& joint : m_.joints) {
      if (!joint.driven) continue;
      open("motor");
      attribute("name", joint.name);
      attribute("joint", joint.name);
      printer_.CloseElement();
    }
    printer_.CloseElement();
  }

  const Mechanism& mechanism_;
  const MechanismDescription& m_;
  const std::vector<MassProperties> masses_;
  tinyxml2::XMLPrinter printer_;
  std::vector<int> parent_, by_;  // of bodies: parent and joint in the tree, or -1
  std::vector<bool> in_tree_;     // of joints
  std::set<std::string> taken_by_bodies_ = {"world"}, taken_by_joints_;
  std::vector<std::string> body_names_,
      ends_;  // of bodies; of joints beyond the tree, the bodies of hardly any mass that hang by them
};

}  // namespace

Written mjcf_of(const Mechanism& mechanism) { return MjcfWriter(mechanism).write(); }

}  // namespace boresight::app
