#include "boresight/mechanism/mechanism.hpp"

#include <cmath>
#include <set>

#include "boresight/mechanism/error.hpp"

namespace boresight {
namespace {

// Columns x, y (the axis), z: see the header for the choice of z. A rectangular guide or pad has its width along x.
Mat3 joint_axes(const Vec3& axis, const ClearanceDescription* clearance) {
  constexpr double kCosine25Degrees = 0.9063077870366499;
  const Vec3 y = axis.normalized();
  if (clearance != nullptr && has_width(*clearance)) {
    const Vec3 x = (clearance->width_direction - y * y.dot(clearance->width_direction)).normalized();
    Mat3 R;
    R << x, y, x.cross(y);
    return R;
  }
  const bool upright = std::abs(y.z()) > kCosine25Degrees;
  const Vec3 towards = upright ? Vec3(Vec3::UnitX()) : Vec3(Vec3::UnitZ());
  const Vec3 z = (towards - y * y.dot(towards)).normalized();
  Mat3 R;
  R << y.cross(z), y, z;
  return R;
}

// Cosine of two directions that are perpendicular, as far as they are typed.
constexpr double kMostAlongAxis = 1e-3;

JointFrame frame_in(const MechanismDescription& mechanism, int body, const Vec3& point, const Mat3& R_WJ) {
  if (body == kGround) return {kGround, point, R_WJ};
  const BodyDescription& b = mechanism.bodies[body];
  return {body, b.axes.transpose() * (point - b.center_of_mass), b.axes.transpose() * R_WJ};
}

void check_names(const MechanismDescription& m) {
  std::set<std::string> seen;
  for (const BodyDescription& b : m.bodies)
    if (!seen.insert(b.name).second)
      throw InputError(b.origin, "body.name", '"' + b.name + "\" twice", "a name of its own");
  seen.clear();
  for (const JointDescription& j : m.joints)
    if (!seen.insert(j.name).second)
      throw InputError(j.origin, "joint.name", '"' + j.name + "\" twice", "a name of its own");
}

void check_joints(const MechanismDescription& m) {
  const int n = static_cast<int>(m.bodies.size());
  for (const JointDescription& j : m.joints) {
    const std::string key = "joint." + j.name;
    if (j.first < kGround || j.first >= n || j.second < kGround || j.second >= n)
      throw InputError(j.origin, key + ".connects", "a body that does not exist", "two bodies of the mechanism");
    if (j.first == j.second)
      throw InputError(j.origin, key + ".connects", "the same body twice", "two different bodies");
    if (std::abs(j.axis.norm() - 1.0) > 1e-9)
      throw InputError(j.origin, key + ".axis", "not a unit vector", "a unit vector");
    if (j.type == JointType::universal && j.axis.cross(j.second_axis).norm() < 1e-9)
      throw InputError(j.origin, key + ".second_axis", "parallel to axis", "an axis across the first one");
    if (j.driven && j.type != JointType::revolute && j.type != JointType::prismatic)
      throw InputError(j.origin, key + ".driven", std::string("true on a ") + to_string(j.type) + " joint",
                       "a revolute or prismatic joint");
  }
}

void check_clearances(const MechanismDescription& m) {
  std::set<int> seen;
  for (const ClearanceDescription& c : m.clearances) {
    if (c.joint < 0 || c.joint >= static_cast<int>(m.joints.size()))
      throw InputError(c.origin, "clearance.joint", "a joint that does not exist", "a joint of the mechanism");
    const JointDescription& j = m.joints[c.joint];
    const std::string key = "clearance." + j.name;
    if (!seen.insert(c.joint).second)
      throw InputError(c.origin, key, "a second clearance on the same joint", "one clearance per joint");
    if (!can_have_play(j.type))
      throw InputError(c.origin, key + ".joint", std::string("a ") + to_string(j.type) + " joint", kTypesWithPlay);
    if (!keeps_axis(j.type) && c.axes == JournalAxes::free)
      throw InputError(c.origin, key + ".axes", std::string("it on a ") + to_string(j.type) + " joint",
                       "nothing: a ball turns freely");
    if (!keeps_axis(j.type) && c.friction_law == "lugre")
      throw InputError(c.origin, key + ".friction.law", std::string("\"lugre\" on a ") + to_string(j.type) + " joint",
                       "a law of the sliding speed: bristles have no lasting directions on a ball");
    if (c.guide == GuideShape::rectangular) {
      if (j.type != JointType::prismatic)
        throw InputError(c.origin, key + ".guide", std::string("\"rectangular\" on a ") + to_string(j.type) + " joint",
                         "a prismatic joint");
    }
    if (c.pad == PadShape::rectangular && j.type != JointType::planar)
      throw InputError(c.origin, key + ".pad", std::string("a rectangular one on a ") + to_string(j.type) + " joint",
                       "a planar joint");
    if (has_width(c)) {
      if (!(std::abs(c.width_direction.dot(j.axis)) < kMostAlongAxis))
        throw InputError(c.origin, key + ".width_direction",
                         "a direction that is not perpendicular to the joint's axis", "perpendicular directions");
    }
    if (c.journal != j.first && c.journal != j.second)
      throw InputError(c.origin, key + ".journal", "a body that the joint does not connect",
                       "one of the joint's two bodies");
  }
}

LineOfSight line_of_sight_of(const LineOfSightDescription& d, const BodyDescription& body) {
  const Vec3 line = d.target - d.from;
  if (!(line.norm() > 0.0))
    throw InputError(d.origin, "pointing.target", "the reference point itself",
                     "a point away from the reference point");
  return {
      .from_B = body.axes.transpose() * (d.from - body.center_of_mass), .target = d.target, .reversed = line.z() < 0.0};
}

}  // namespace

Mechanism::Mechanism(MechanismDescription description) : description_(std::move(description)) {
  const MechanismDescription& m = description_;
  if (m.bodies.empty()) throw InputError(m.origin, "body", "no body", "at least one [[body]]");
  check_names(m);
  check_joints(m);
  check_clearances(m);
  parameters_ = nominal_parameters(m);

  clearance_of_.assign(m.joints.size(), -1);
  for (std::size_t c = 0; c < m.clearances.size(); ++c) clearance_of_[m.clearances[c].joint] = static_cast<int>(c);
  geometry_.reserve(m.joints.size());
  for (const JointDescription& j : m.joints) {
    const int clearance = clearance_of_[geometry_.size()];
    const Mat3 R_WJ = joint_axes(j.axis, clearance < 0 ? nullptr : &m.clearances[static_cast<std::size_t>(clearance)]);
    JointGeometry g{frame_in(m, j.first, j.point, R_WJ), frame_in(m, j.second, j.point, R_WJ)};
    g.second_axis = j.second == kGround ? j.second_axis : Vec3(m.bodies[j.second].axes.transpose() * j.second_axis);
    geometry_.push_back(g);
  }

  boresight_body_ = -1;
  for (int b = 0; b < bodies(); ++b) {
    if (!m.bodies[b].boresight) continue;
    if (boresight_body_ >= 0)
      throw InputError(m.bodies[b].origin, "body." + m.bodies[b].name + ".boresight", "a second boresight",
                       "a boresight on one body only");
    boresight_body_ = b;
    pointing_.boresight_B = (m.bodies[b].axes.transpose() * *m.bodies[b].boresight).normalized();
  }
  if (boresight_body_ < 0) throw InputError(m.origin, "body.boresight", "none", "the pointing axis on one body");
  if (m.line_of_sight) pointing_.line_of_sight = line_of_sight_of(*m.line_of_sight, m.bodies[boresight_body_]);

  characteristic_length_ = 0.0;
  for (const JointDescription& a : m.joints)
    for (const JointDescription& b : m.joints)
      characteristic_length_ = std::max(characteristic_length_, (a.point - b.point).norm());
  // Where joints lie close together, as those of a gimbal do, the bodies that they carry are larger.
  for (const JointDescription& j : m.joints)
    for (const int b : {j.first, j.second})
      if (b != kGround)
        characteristic_length_ = std::max(characteristic_length_, (m.bodies[b].center_of_mass - j.point).norm());
  if (characteristic_length_ <= 0.0) characteristic_length_ = 1.0;
}

Mechanism::Mechanism(const Mechanism& drawn, std::vector<JointGeometry> geometry, std::map<int, TimeFunctionPtr> drives,
                     std::shared_ptr<const OffsetChoice> choice)
    : Mechanism(drawn) {
  description_.motion.pose.reset();
  description_.motion.drives = std::move(drives);
  geometry_ = std::move(geometry);
  built_ = true;
  offset_choice_ = std::move(choice);
}

int Mechanism::body_index(const std::string& name) const {
  for (int b = 0; b < bodies(); ++b)
    if (description_.bodies[b].name == name) return b;
  return -1;
}

std::vector<MassProperties> Mechanism::mass_properties(const Parameters& parameters) const {
  std::vector<MassProperties> result(bodies());
  for (int b = 0; b < bodies(); ++b) {
    const BodyDescription& body = description_.bodies[b];
    result[b] = {parameters.body_mass[b], body.axes.transpose() * (parameters.body_center[b] - body.center_of_mass),
                 body.inertia};
  }
  if (description_.payload && parameters.payload_mass > 0.0) {
    const PayloadDescription& payload = *description_.payload;
    const BodyDescription& carrier = description_.bodies[payload.body];
    MassProperties& body = result[payload.body];
    const Vec3 c0 = body.c;
    const Vec3 c = carrier.axes.transpose() * (parameters.payload_center - carrier.center_of_mass) - c0;
    const double m0 = body.mass, m1 = parameters.payload_mass, total = m0 + m1;
    // Two masses about their common centre: the reduced mass at the distance between them (Huygens, Steiner).
    body.inertia += m1 * Mat3(payload.gyration.array().square().matrix().asDiagonal());
    body.inertia += m0 * m1 / total * (c.squaredNorm() * Mat3::Identity() - c * c.transpose());
    body.c = c0 + m1 / total * c;
    body.mass = total;
  }
  return result;
}

}  // namespace boresight
