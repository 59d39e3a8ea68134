#include "scene.hpp"

#include <fmt/format.h>

namespace boresight::gauntlet {
namespace {

std::string length(const Vec3& v) {
  return fmt::format("[\"{:.17g} m\", \"{:.17g} m\", \"{:.17g} m\"]", v.x(), v.y(), v.z());
}

std::string numbers(const Vec3& v) { return fmt::format("[{:.17g}, {:.17g}, {:.17g}]", v.x(), v.y(), v.z()); }

bool has_axis(const std::string& type) { return type != "spherical" && type != "fixed"; }

}  // namespace

int Scene::add_body(const std::string& body_name) {
  bodies.push_back({});
  bodies.back().name = body_name;
  return static_cast<int>(bodies.size()) - 1;
}

int Scene::add_joint(const SceneJoint& joint) {
  joints.push_back(joint);
  return static_cast<int>(joints.size()) - 1;
}

void Scene::move(const Mat3& R, const Vec3& p) {
  const auto place = [&](Vec3& x) { x = (R * x + p).eval(); };
  const auto turn = [&](Vec3& d) { d = (R * d).eval(); };
  for (SceneBody& b : bodies) {
    place(b.center_of_mass);
    b.axes = (R * b.axes).eval();
  }
  for (SceneJoint& j : joints) {
    place(j.point);
    turn(j.axis);
    turn(j.second_axis);
  }
  for (SceneSpring& s : springs) {
    place(s.first_point);
    place(s.second_point);
  }
  for (SceneLoad& l : loads) place(l.point);
  turn(boresight);
  turn(gravity);
}

std::string Scene::toml() const {
  std::string out = fmt::format("# {}\n\nformat = 1\nname = \"{}\"\n", about, name);
  const auto line = [&](const std::string& text) { out += text + '\n'; };
  const auto body_name = [&](int b) { return b == kGroundBody ? std::string("ground") : bodies[b].name; };
  const auto connects = [&](int a, int b) {
    return fmt::format("connects = [\"{}\", \"{}\"]", body_name(a), body_name(b));
  };
  line(fmt::format("gravity = [\"{:.17g} m/s^2\", \"{:.17g} m/s^2\", \"{:.17g} m/s^2\"]", gravity.x(), gravity.y(),
                   gravity.z()));

  for (std::size_t k = 0; k < bodies.size(); ++k) {
    const SceneBody& b = bodies[k];
    line(fmt::format("\n[[body]]\nname = \"{}\"\nmass = \"{:.17g} kg\"\ncenter_of_mass = {}", b.name, b.mass,
                     length(b.center_of_mass)));
    line(fmt::format("axes = {{ x = {}, z = {} }}", numbers(b.axes.col(0)), numbers(b.axes.col(2))));
    line(fmt::format("inertia = [\"{:.17g} kg m^2\", \"{:.17g} kg m^2\", \"{:.17g} kg m^2\"]", b.inertia.x(),
                     b.inertia.y(), b.inertia.z()));
    if (static_cast<int>(k) == boresight_body) line("boresight = " + numbers(boresight));
  }
  if (payload_body >= 0) {
    const SceneBody& b = bodies[payload_body];
    const double gyration = std::sqrt(b.inertia.mean() / b.mass);
    line(fmt::format("\n[payload]\nbody = \"{}\"\nmass = \"{:.17g} kg\"\ncenter_of_mass = {}\ngyration = {}", b.name,
                     payload_mass, length(b.center_of_mass), length(Vec3::Constant(0.7 * gyration))));
  }
  for (const SceneJoint& j : joints) {
    line(fmt::format("\n[[joint]]\nname = \"{}\"\ntype = \"{}\"\n{}\npoint = {}", j.name, j.type,
                     connects(j.first, j.second), length(j.point)));
    if (has_axis(j.type)) line("axis = " + numbers(j.axis));
    if (j.type == "universal") line("second_axis = " + numbers(j.second_axis));
    if (!j.law.empty()) line("driven = true");
  }
  line(fmt::format("\n[motion]\nduration = \"{:.17g} s\"", duration));
  std::string laws;
  for (const SceneJoint& j : joints)
    if (!j.law.empty()) laws += fmt::format("{}{} = \"{}\"", laws.empty() ? "" : ", ", j.name, j.law);
  if (!laws.empty()) line("drives = { " + laws + " }");
  if (!rates.empty() || journals_centred) line("\n[initial]");
  if (journals_centred) line("journals = \"centred\"");
  if (!rates.empty()) {
    std::string text;
    for (const SceneRate& r : rates) {
      const bool slides = joints[r.joint].type == "prismatic";
      text += fmt::format("{}{} = \"{:.17g} {}\"", text.empty() ? "" : ", ", joints[r.joint].name, r.rate,
                          slides ? "m/s" : "rad/s");
    }
    line("rates = { " + text + " }");
  }
  if (sight > 0.0) line(fmt::format("\n[pointing]\ndistance = \"{:.17g} m\"", sight));
  for (const SceneSpring& s : springs)
    line(
        fmt::format("\n[[spring]]\n{}\npoints = [{}, {}]\nstiffness = \"{:.17g} N/m\"\ndamping = \"{:.17g} N "
                    "s/m\"\nfree_length = \"{:.17g} m\"",
                    connects(s.first, s.second), length(s.first_point), length(s.second_point), s.stiffness, s.damping,
                    s.free_length));
  for (const SceneLoad& l : loads) {
    if (l.joint >= 0)
      line(fmt::format("\n[[load]]\njoint = \"{}\"\n{} = \"{}\"", joints[l.joint].name,
                       joints[l.joint].type == "prismatic" ? "force" : "torque", l.along));
    else
      line(fmt::format("\n[[load]]\nbody = \"{}\"\npoint = {}\nforce = [\"{}\", \"{}\", \"{}\"]", bodies[l.body].name,
                       length(l.point), l.force[0], l.force[1], l.force[2]));
  }
  for (const ScenePlay& p : plays) {
    const SceneJoint& j = joints[p.joint];
    line(fmt::format("\n[[clearance]]\njoint = \"{}\"\njournal = \"{}\"\nradial = \"{:.17g} m\"", j.name,
                     body_name(p.journal), p.radial));
    if (p.axial > 0.0) line(fmt::format("axial = \"{:.17g} m\"\ncap_radius = \"{:.17g} m\"", p.axial, p.cap_radius));
    line(fmt::format("journal_radius = \"{:.17g} m\"\nsleeve_length = \"{:.17g} m\"\naxes = \"{}\"", p.journal_radius,
                     p.sleeve_length, p.free_axes ? "free" : "parallel"));
    const SceneContact& c = p.contact;
    line(fmt::format("  [clearance.contact]\n  law = \"{}\"", c.law));
    if (!c.dissipation.empty()) line(fmt::format("  dissipation = \"{}\"", c.dissipation));
    if (c.law == "kelvin-voigt")
      line(fmt::format("  stiffness = \"{:.17g} N/m\"\n  damping = \"{:.17g} N s/m\"", c.stiffness, c.damping));
    line(fmt::format(
        "  restitution = {:.17g}\n  young = [\"{:.17g} Pa\", \"{:.17g} Pa\"]\n  poisson = [{:.17g}, {:.17g}]",
        c.restitution, c.young[0], c.young[1], c.poisson[0], c.poisson[1]));
    line(fmt::format("  density = \"{:.17g} kg/m^3\"\n  minimum_impact_speed = \"{:.17g} m/s\"", c.density,
                     c.minimum_impact_speed));
    const SceneFriction& f = p.friction;
    line(fmt::format("  [clearance.friction]\n  law = \"{}\"", f.law));
    if (f.law == "none") continue;
    line(fmt::format("  coefficient = {:.17g}\n  static_speed = \"{:.17g} m/s\"\n  dynamic_speed = \"{:.17g} m/s\"",
                     f.coefficient, f.static_speed, f.dynamic_speed));
    if (f.static_coefficient > 0.0) line(fmt::format("  static_coefficient = {:.17g}", f.static_coefficient));
  }
  return out;
}

}  // namespace boresight::gauntlet
