#include "dress.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "boresight/contact/friction_law.hpp"
#include "boresight/contact/normal_law.hpp"

namespace boresight::gauntlet {
namespace {

constexpr double kGravity = 9.80665;

SceneContact draw_contact(Draw& draw, const Scene& scene, const ScenePlay& play) {
  SceneContact c;
  if (draw.chance(0.5)) {
    std::vector<std::string> names;
    for (const NormalLawEntry& law : normal_laws()) names.push_back(law.name);
    c.law = draw.one_of(names);
  }
  c.restitution = draw.chance(0.1) ? 1.0 : draw.between(0.3, 0.95);
  const std::vector<std::array<double, 3>> materials = {
      {210e9, 0.3, 7800}, {72e9, 0.33, 2700}, {110e9, 0.34, 4500}, {3e9, 0.4, 1400}};
  const auto journal = draw.one_of(materials), sleeve = draw.one_of(materials);
  c.young = {journal[0], sleeve[0]};
  c.poisson = {journal[1], sleeve[1]};
  c.density = sleeve[2];
  c.minimum_impact_speed = draw.log_between(1e-4, 1e-2);
  const bool line = normal_law(c.law).geometry == ContactGeometry::line;
  if (line && draw.chance(0.3))
    c.dissipation = draw.one_of<std::string>({"hunt-crossley", "lankarani-nikravesh", "exact"});
  if (c.law == "kelvin-voigt") {
    double mass = 1e300;
    for (const SceneBody& b : scene.bodies) mass = std::min(mass, b.mass);
    // A deflection of a twentieth of the play under a few weights, damped by a tenth to a half.
    c.stiffness = 40.0 * mass * kGravity / play.radial;
    c.damping = 2.0 * draw.between(0.05, 0.5) * std::sqrt(c.stiffness * mass);
  }
  return c;
}

SceneFriction draw_friction(Draw& draw) {
  SceneFriction f;
  if (draw.chance(0.2)) return f;
  std::vector<std::string> names;
  for (const FrictionLawEntry& law : friction_laws())
    if (law.name != std::string("none")) names.push_back(law.name);
  f.law = draw.chance(0.4) ? "modified-coulomb" : draw.one_of(names);
  f.coefficient = draw.log_between(0.01, 0.4);
  f.static_speed = draw.log_between(5e-5, 5e-4);
  f.dynamic_speed = f.static_speed * draw.between(4.0, 20.0);
  if (friction_law(f.law).peak && draw.chance(0.6)) f.static_coefficient = f.coefficient * draw.between(1.0, 1.6);
  return f;
}

}  // namespace

void finish_bodies(Draw& draw, Scene& scene) {
  for (std::size_t k = 0; k < scene.bodies.size(); ++k) {
    SceneBody& b = scene.bodies[k];
    if (b.complete) continue;
    std::vector<Vec3> points;
    for (const SceneJoint& j : scene.joints)
      if (j.first == static_cast<int>(k) || j.second == static_cast<int>(k)) points.push_back(j.point);
    Vec3 mean = Vec3::Zero();
    for (const Vec3& p : points) mean += p / static_cast<double>(points.size());
    double extent = 0.25 * scene.size;
    for (const Vec3& p : points) extent = std::max(extent, 2.0 * (p - mean).norm());
    b.center_of_mass = mean + draw.inside_box(0.15 * extent);
    b.mass = 5.0 * std::pow(extent / 0.3, 2.3) * draw.log_between(0.2, 3.0);
    const Vec3 sides = extent * Vec3(draw.between(0.7, 1.1), draw.between(0.15, 0.6), draw.between(0.15, 0.6)),
               squares = sides.cwiseProduct(sides);
    b.inertia = b.mass / 12.0 * Vec3(squares.y() + squares.z(), squares.x() + squares.z(), squares.x() + squares.y());
    b.axes = draw.rotation();
  }
  if (draw.chance(0.3)) {
    scene.payload_body = scene.boresight_body;
    scene.payload_mass = scene.bodies[scene.boresight_body].mass * draw.log_between(0.05, 3.0);
  }
}

void add_plays(Draw& draw, Scene& scene) {
  std::vector<int> bearings;
  for (std::size_t k = 0; k < scene.joints.size(); ++k) {
    const SceneJoint& j = scene.joints[k];
    if (j.bears && (j.type == "revolute" || j.type == "cylindrical")) bearings.push_back(static_cast<int>(k));
  }
  if (bearings.empty() || draw.chance(0.04)) return;
  const int kind = draw.whole(0, 9);  // one joint, a subset, all
  std::vector<int> chosen;
  if (kind < 5) {
    chosen = {draw.one_of(bearings)};
  } else if (kind < 9) {
    const double share = draw.between(0.2, 0.8);
    for (int j : bearings)
      if (draw.chance(share)) chosen.push_back(j);
    if (chosen.empty()) chosen = {bearings.front()};
  } else {
    chosen = bearings;
  }
  const double free_axes = draw.one_of<double>({0.0, 0.5, 1.0});
  for (int joint : chosen) {
    const SceneJoint& j = scene.joints[joint];
    ScenePlay p;
    p.joint = joint;
    p.journal = draw.chance(0.5) ? j.first : j.second;
    p.journal_radius = scene.size * draw.between(0.02, 0.06);
    p.radial = p.journal_radius * draw.log_between(1e-3, 2e-2);
    p.sleeve_length = p.journal_radius * draw.between(1.5, 8.0);
    p.free_axes = draw.chance(free_axes);
    if (j.type == "revolute") {
      p.axial = p.radial * draw.log_between(0.3, 3.0);
      p.cap_radius = (p.journal_radius + p.radial) * draw.between(1.2, 1.8);
    }
    p.contact = draw_contact(draw, scene, p);
    p.friction = draw_friction(draw);
    scene.plays.push_back(p);
  }
}

void add_forces(Draw& draw, Scene& scene) {
  if (scene.floats) return;  // forces from outside would change its momentum
  if (draw.chance(0.75)) scene.gravity = kGravity * (draw.chance(0.5) ? Vec3(0, 0, -1) : draw.direction());
  double mass = 0.0;
  for (const SceneBody& b : scene.bodies) mass += b.mass;
  if (draw.chance(0.2)) {
    SceneSpring s;
    s.second = draw.whole(0, static_cast<int>(scene.bodies.size()) - 1);
    s.first = draw.chance(0.6) ? kGroundBody : draw.whole(-1, static_cast<int>(scene.bodies.size()) - 1);
    if (s.first == s.second) s.first = kGroundBody;
    s.second_point = scene.bodies[s.second].center_of_mass;
    s.first_point = s.second_point + scene.size * draw.between(0.4, 1.2) * draw.direction();
    const double length = (s.first_point - s.second_point).norm();
    s.stiffness = mass * kGravity / (scene.size * draw.log_between(0.02, 0.5));
    s.damping = draw.chance(0.5) ? 0.0 : draw.between(0.02, 0.5) * std::sqrt(s.stiffness * mass);
    s.free_length = length * draw.between(0.85, 1.15);
    scene.springs.push_back(s);
  }
  if (draw.chance(0.2)) {
    SceneLoad l;
    const double w = 6.283 / scene.duration * draw.between(0.3, 2.0),
                 weight = 0.5 * mass * kGravity * draw.log_between(0.05, 1.0);
    l.body = draw.whole(0, static_cast<int>(scene.bodies.size()) - 1);
    l.point = scene.bodies[l.body].center_of_mass + draw.inside_box(0.2 * scene.size);
    l.force = {fmt::format("{:.6g}*sin({:.6g}*t)", weight * draw.between(-1, 1), w),
               fmt::format("{:.6g}", weight * draw.between(-1, 1)),
               fmt::format("{:.6g}*cos({:.6g}*t)", weight * draw.between(-1, 1), w)};
    scene.loads.push_back(l);
  }
}

void place_in_space(Draw& draw, Scene& scene) {
  const Mat3 R = draw.chance(0.3) ? Mat3(Mat3::Identity()) : draw.rotation();
  const Vec3 p = draw.chance(0.3) ? Vec3(Vec3::Zero()) : Vec3(draw.inside_box(3.0 * scene.size));
  scene.move(R, p);
}

}  // namespace boresight::gauntlet
