#include "exchange/assembly.hpp"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <numeric>
#include <set>

#include "boresight/mechanism/error.hpp"

namespace boresight::app {
namespace {

const Origin kCommandLine{"command line", 0};

// Names of bodies and joints stand in paths.
std::string path_name(const std::string& name, const std::set<std::string>& taken) {
  std::string clean;
  for (const char c : name) {
    const bool bad =
        static_cast<unsigned char>(c) < 0x20 || c == 0x7f || std::string(".*=,{}\"'[]").find(c) != std::string::npos;
    clean += bad ? '_' : c;
  }
  while (!clean.empty() && clean.back() == ' ') clean.pop_back();
  while (!clean.empty() && clean.front() == ' ') clean.erase(0, 1);
  constexpr std::size_t kLongest = 90;  // bytes; a name may have a hundred, with its number
  if (clean.size() > kLongest) {
    std::size_t end = kLongest;
    while (end > 0 && (static_cast<unsigned char>(clean[end]) & 0xc0) == 0x80) --end;  // no letter of UTF-8 in two
    clean.resize(end);
  }
  if (clean.empty()) clean = "unnamed";
  if (clean == "ground") clean = "ground_link";
  std::string own = clean;
  for (int k = 2; taken.count(own) != 0; ++k) own = clean + "_" + std::to_string(k);
  return own;
}

class Assembler {
 public:
  Assembler(Drawing drawing, const ImportChoices& choices) : drawing_(std::move(drawing)), choices_(choices) {
    result_.assumed = std::move(drawing_.assumed);
    result_.left_out = std::move(drawing_.left_out);
    result_.mechanism.name = drawing_.name.empty() ? "imported mechanism" : drawing_.name;
    result_.mechanism.gravity = drawing_.gravity;
    result_.mechanism.origin = {drawing_.file, 0};
  }

  Assembly assemble() {
    join_fixed_parts();
    make_bodies();
    make_joints();
    drop_what_nothing_holds();
    if (result_.mechanism.bodies.empty())
      throw InputError({drawing_.file, 0}, "joint", "nothing that moves", "a mechanism: parts that joints let move");
    // Equations are dense: their time grows with the cube of the bodies' number, and a cloth of thousands takes all memory.
    constexpr std::size_t kMostBodies = 500;
    if (const std::size_t n = result_.mechanism.bodies.size(); n > kMostBodies)
      throw InputError({drawing_.file, 0}, "body", std::to_string(n) + " bodies that move",
                       "a mechanism of at most " + std::to_string(kMostBodies));
    choose_boresight();
    choose_drives();
    for (SpringDescription spring : drawing_.springs) {
      spring.first = body_of(spring.first);
      spring.second = body_of(spring.second);
      result_.mechanism.springs.push_back(spring);
    }
    return std::move(result_);
  }

 private:
  int ground() const { return static_cast<int>(drawing_.parts.size()); }
  int slot(int part) const { return part == kGround ? ground() : part; }
  int leader(int part) const {
    while (leader_[part] != part) part = leader_[part];
    return part;
  }
  int body_of(int part) const { return body_of_[leader(slot(part))]; }

  int part_asked_for(const std::string& option, const std::string& name) const {
    const int part = part_named(drawing_, name);
    if (part >= 0) return part;
    if (const std::size_t colon = name.rfind(':');
        colon != std::string::npos && part_named(drawing_, name.substr(0, colon)) >= 0)
      throw InputError(kCommandLine, option,
                       "\"" + name.substr(colon + 1) + "\" as the axis of " + name.substr(0, colon),
                       "x, y, z, -x, -y or -z");
    std::vector<std::string> names;
    for (const Part& p : drawing_.parts) names.push_back(p.name);
    throw InputError(kCommandLine, option, "\"" + name + "\"", "the name of a link in " + drawing_.file,
                     nearest_name(name, names));
  }

  void join_fixed_parts() {
    leader_.resize(drawing_.parts.size() + 1);
    std::iota(leader_.begin(), leader_.end(), 0);
    const auto join = [&](int a, int b) {
      a = leader(slot(a));
      b = leader(slot(b));
      if (a == b) return;
      if (b == ground() || (a != ground() && b < a)) std::swap(a, b);
      leader_[b] = a;  // the ground leads, then what the file names first
    };
    for (const Connection& c : drawing_.connections)
      if (c.type == JointType::fixed) join(c.first, c.second);
    if (!choices_.ground.empty()) join(kGround, part_asked_for("--ground", choices_.ground));
  }

  void make_bodies() {
    body_of_.assign(leader_.size(), kGround);
    double total = 0.0;
    for (const Part& p : drawing_.parts) total += p.mass;
    Eigen::AlignedBox3d box;
    for (const Connection& c : drawing_.connections) box.extend(c.p_WJ);
    length_ = box.isEmpty() || !(box.diagonal().norm() > 0.0) ? 1.0 : box.diagonal().norm();
    for (int i = 0; i < ground(); ++i) {
      if (leader(i) != i) continue;
      body_of_[i] = static_cast<int>(result_.mechanism.bodies.size());
      result_.mechanism.bodies.push_back(body_led_by(i, total));
      names_.insert(result_.mechanism.bodies.back().name);
    }
  }

  // The first of the parts that are one body, but for what weighs hardly anything beside the others: it only stands for a joint.
  int name_giver(int lead) const {
    constexpr double kHardly = 1e-3;
    double heaviest = 0.0;
    for (int i = 0; i < ground(); ++i)
      if (leader(i) == lead) heaviest = std::max(heaviest, drawing_.parts[i].mass);
    for (int i = 0; i < ground(); ++i)
      if (leader(i) == lead && (drawing_.parts[i].mass == 0.0 || drawing_.parts[i].mass >= kHardly * heaviest))
        return i;
    return lead;
  }

  BodyDescription body_led_by(int lead, double total) {
    const int named = name_giver(lead);
    const Part& first = drawing_.parts[named];
    BodyDescription body;
    body.name = path_name(first.name, names_);
    body.origin = first.origin;
    body.axes = first.X_WP.R;
    std::string joined;
    Vec3 moment = Vec3::Zero();
    for (int i = 0; i < ground(); ++i) {
      if (leader(i) != lead) continue;
      body.mass += drawing_.parts[i].mass;
      moment += drawing_.parts[i].mass * drawing_.parts[i].p_WC;
      if (i != named) joined += (joined.empty() ? "" : ", ") + drawing_.parts[i].name;
    }
    if (!joined.empty())
      result_.assumed.push_back({first.origin.line, first.name + " carries what is fixed to it: " + joined});
    body.center_of_mass = body.mass > 0.0 ? Vec3(moment / body.mass) : first.p_WC;
    Mat3 inertia = Mat3::Zero();
    for (int i = 0; i < ground(); ++i) {
      if (leader(i) != lead) continue;
      const Part& part = drawing_.parts[i];
      const Vec3 r = part.p_WC - body.center_of_mass;
      inertia += part.inertia + part.mass * (r.squaredNorm() * Mat3::Identity() - r * r.transpose());
    }
    give_least_mass(body, inertia, first, total);
    body.inertia = body.axes.transpose() * inertia * body.axes;
    body.inertia = (0.5 * (body.inertia + body.inertia.transpose())).eval();
    return body;
  }

  // A body needs some mass and some inertia. What has none gets so little that it does not matter.
  void give_least_mass(BodyDescription& body, Mat3& inertia, const Part& first, double total) {
    constexpr double kLeastShare = 1e-9;   // of the mechanism's mass: below what any pointing error shows
    constexpr double kLeastRadius = 1e-3;  // of gyration, of the mechanism's size
    if (!(body.mass > 0.0)) {
      body.mass = std::max(kLeastShare * total, 1e-9);
      inertia = body.mass * length_ * length_ * 1e-2 * Mat3::Identity();
      result_.assumed.push_back(
          {first.origin.line, fmt::format("{} has no mass, and got {:.3g} kg", first.name, body.mass)});
      return;
    }
    const Vec3 principal = Eigen::SelfAdjointEigenSolver<Mat3>(inertia, Eigen::EigenvaluesOnly).eigenvalues();
    const double least = body.mass * length_ * length_ * kLeastRadius * kLeastRadius;
    const double lacking = principal[2] * (1.0 - 1e-10) - principal[0] - principal[1];
    if (principal[0] > 1e-9 * principal[2] && principal[2] > 0.0 && lacking <= 0.0) return;
    const double added = std::max(principal[0] > 1e-9 * principal[2] ? 0.0 : least, 1.001 * lacking);
    inertia += added * Mat3::Identity();
    result_.assumed.push_back(
        {first.origin.line, fmt::format("{} had {} inertia; {:.3g} kg m^2 about every axis were added", first.name,
                                        principal[2] > 0.0 ? "too little" : "no", added)});
  }

  void make_joints() {
    std::set<std::string> names;
    for (const Connection& c : drawing_.connections) {
      if (c.type == JointType::fixed) continue;
      const int first = body_of(c.first), second = body_of(c.second);
      if (first == second) {
        result_.left_out.push_back({c.origin.line, c.name + ": it connects what is fixed to each other"});
        continue;
      }
      JointDescription joint;
      joint.name = path_name(c.name, names);
      names.insert(joint.name);
      joint_of_[c.name] = joint.name;
      joint.type = c.type;
      joint.first = first;
      joint.second = second;
      joint.point = c.p_WJ;
      joint.axis = c.axis;
      joint.second_axis = c.second_axis;
      joint.driven = c.driven;
      joint.origin = c.origin;
      if (c.mimic) mimics_[joint.name] = *c.mimic;
      result_.mechanism.joints.push_back(joint);
    }
  }

  // A body that neither a joint nor a spring holds is a part of the scenery: it would only fall.
  void drop_what_nothing_holds() {
    if (result_.mechanism.joints.empty()) return;
    const auto is_held = [&](int body) {
      return std::any_of(result_.mechanism.joints.begin(), result_.mechanism.joints.end(),
                         [&](const JointDescription& j) { return j.first == body || j.second == body; }) ||
             std::any_of(drawing_.springs.begin(), drawing_.springs.end(), [&](const SpringDescription& s) {
               return body_of(s.first) == body || body_of(s.second) == body;
             });
    };
    for (int b = static_cast<int>(result_.mechanism.bodies.size()) - 1; b >= 0; --b) {
      if (is_held(b)) continue;
      const BodyDescription& body = result_.mechanism.bodies[b];
      result_.left_out.push_back({body.origin.line, body.name + ": neither a joint nor a spring holds it"});
      result_.mechanism.bodies.erase(result_.mechanism.bodies.begin() + b);
      for (int& index : body_of_)
        if (index == b)
          index = kGround;
        else if (index > b)
          --index;
      for (JointDescription& j : result_.mechanism.joints) {
        if (j.first > b) --j.first;
        if (j.second > b) --j.second;
      }
    }
  }

  // The body that is most joints away from the ground; of several, the last.
  int furthest_body() const {
    const int n = static_cast<int>(result_.mechanism.bodies.size());
    std::vector<int> depth(n, -1);
    for (int at = 0, last = 0; at <= n; ++at)
      for (const JointDescription& j : result_.mechanism.joints)
        for (const auto& [from, to] : {std::pair(j.first, j.second), std::pair(j.second, j.first)})
          if (to != kGround && depth[to] < 0 && (from == kGround ? at == 0 : depth[from] == at - 1 && at > 0))
            depth[to] = last = at;
    int best = 0;
    for (int b = 0; b < n; ++b)
      if (depth[b] >= depth[best]) best = b;
    return best;
  }

  void choose_boresight() {
    int body = kGround;
    Vec3 axis;
    if (choices_.boresight_part.empty()) {
      body = furthest_body();
      axis = result_.mechanism.bodies[body].axes.col(0);
      result_.assumed.push_back({result_.mechanism.bodies[body].origin.line,
                                 "the boresight is the x axis of " + result_.mechanism.bodies[body].name +
                                     ", the part furthest from the ground; --boresight LINK:AXIS names another"});
    } else {
      const int part = part_asked_for("--boresight", choices_.boresight_part);
      body = body_of(part);
      axis = drawing_.parts[part].X_WP.R * choices_.boresight_axis.normalized();
      if (body == kGround)
        throw InputError(kCommandLine, "--boresight", "\"" + choices_.boresight_part + "\", which stands still",
                         "a link that moves");
    }
    result_.mechanism.bodies[body].boresight = axis.normalized();
  }

  void choose_drives() {
    auto& joints = result_.mechanism.joints;
    std::vector<std::string> names;
    for (const JointDescription& j : joints) names.push_back(j.name);
    if (choices_.drives_given) {
      for (JointDescription& j : joints) j.driven = false;
      for (const auto& [name, course] : choices_.drives) {
        const auto known = joint_of_.find(name);
        const auto joint = std::find_if(joints.begin(), joints.end(), [&](const JointDescription& j) {
          return j.name == (known == joint_of_.end() ? name : known->second);
        });
        if (joint == joints.end())
          throw InputError(kCommandLine, "--drive", "\"" + name + "\"", "the name of a joint that moves",
                           nearest_name(name, names));
        if (joint->type != JointType::revolute && joint->type != JointType::prismatic)
          throw InputError(kCommandLine, "--drive", name + ", a " + to_string(joint->type) + " joint",
                           "a revolute or prismatic joint");
        joint->driven = true;
        // By its name in the file and by that in the mechanism.
        if (!result_.drives.emplace(joint->name, course).second)
          throw InputError(kCommandLine, "--drive", "\"" + joint->name + "\" twice", "each joint once");
      }
    } else {
      if (!drawing_.drives.empty()) result_.assumed.push_back({0, drawing_.drives});
      for (const JointDescription& j : joints)
        if (j.driven) result_.drives[j.name] = "0";
      if (!result_.drives.empty())
        result_.assumed.push_back({0, "drives stand still: write their courses in [motion]"});
    }
    leave_out_circles();
    for (const auto& [name, mimic] : mimics_) follow(name, mimic);
  }

  // The joint that one moves with, as the mechanism names it; "": it is none of the mechanism's, or follows none.
  std::string leader_of(const std::string& name) const {
    const auto mimic = mimics_.find(name);
    if (mimic == mimics_.end()) return {};
    const auto leads = joint_of_.find(mimic->second.joint);
    return leads == joint_of_.end() ? std::string() : leads->second;
  }

  // Joints that move with each other in a circle, or with themselves: that says of none how it moves, unless the user does of one.
  void leave_out_circles() {
    const auto given = [&](const std::string& name) {
      return choices_.drives_given && result_.drives.count(name) != 0;
    };
    std::vector<std::string> circling;
    for (const auto& [name, mimic] : mimics_) {
      std::string circle = name, at = name;
      bool moved = given(name);
      for (std::size_t steps = 0; steps < mimics_.size(); ++steps) {
        at = leader_of(at);
        if (at.empty() || at == name) break;
        moved = moved || given(at);
        circle += ", " + at;
      }
      if (at != name || moved) continue;
      circling.push_back(name);
      result_.left_out.push_back(
          {joint_called(name).origin.line,
           name + " moving with " + mimic.joint + ": mimics in a circle (" + circle + ", " + name + ")"});
    }
    for (const std::string& name : circling) mimics_.erase(name);
  }

  JointDescription& joint_called(const std::string& name) {
    return *std::find_if(result_.mechanism.joints.begin(), result_.mechanism.joints.end(),
                         [&](const JointDescription& j) { return j.name == name; });
  }

  // Of a joint that moves with another one, the course follows from the other's.
  void follow(const std::string& name, const Mimic& mimic) {
    if (!followed_.insert(name).second) return;
    if (choices_.drives_given && result_.drives.count(name) != 0) return;  // the user says how it moves
    // The other may follow a third one, and first of all has to.
    if (const auto leads = joint_of_.find(mimic.joint); leads != joint_of_.end())
      if (const auto other = mimics_.find(leads->second); other != mimics_.end()) follow(other->first, other->second);
    JointDescription& joint = joint_called(name);
    const auto leading = joint_of_.find(mimic.joint);
    const auto course = leading == joint_of_.end() ? result_.drives.end() : result_.drives.find(leading->second);
    if (course == result_.drives.end()) {
      result_.left_out.push_back({joint.origin.line, name + " moving with " + mimic.joint + ", which is not driven"});
      joint.driven = false;
      result_.drives.erase(name);
      return;
    }
    joint.driven = true;
    result_.drives[name] = course->second == "0"
                               ? fmt::format("{}", mimic.offset)
                               : fmt::format("{}*({}) + {}", mimic.multiplier, course->second, mimic.offset);
  }

  Drawing drawing_;
  const ImportChoices& choices_;
  Assembly result_;
  std::vector<int> leader_, body_of_;  // of parts; the ground behind the last of them
  std::set<std::string> names_;
  std::map<std::string, std::string> joint_of_;  // as the file names it -> as the mechanism does
  std::map<std::string, Mimic> mimics_;
  std::set<std::string> followed_;  // of them, those whose course is known
  double length_ = 1.0;             // diagonal of the box that holds all joints [m]
};

}  // namespace

Assembly assembled(Drawing drawing, const ImportChoices& choices) {
  return Assembler(std::move(drawing), choices).assemble();
}

}  // namespace boresight::app
