// Mechanisms with more constraints than they need, beyond bearing pairs: parallelograms with a third bar, Sarrus' linkage, doors
// on three hinges, and planar loops of six bars.
#include <fmt/format.h>

#include "families.hpp"

namespace boresight::gauntlet {
namespace {

void draw_parallelogram(Draw& draw, Scene& scene) {
  const double s = scene.size, phi = draw.between(0.7, 2.4), l = s * draw.between(0.4, 0.8);
  const Vec3 arm(l * std::cos(phi), l * std::sin(phi), 0);
  const int table = scene.add_body("table"), bars = draw.whole(2, 4);
  for (int k = 0; k < bars; ++k) {
    const Vec3 foot(s * k / (bars - 1.0), 0, k == 1 && bars > 2 ? 0.2 * s : 0.0);
    const int bar = scene.add_body(fmt::format("bar{}", k + 1));
    SceneJoint low{fmt::format("low{}", k + 1), "revolute", kGroundBody, bar, foot, Vec3::UnitZ()};
    if (k == 0) low.law = turning_law(draw, scene, s);
    scene.add_joint(low);
    scene.add_joint({fmt::format("high{}", k + 1), "revolute", bar, table, foot + arm, Vec3::UnitZ()});
  }
  scene.boresight_body = table;
  scene.about = fmt::format("A table on {} parallel bars", bars);
}

// Two pairs of plates in planes across each other: the table can only go up.
void draw_sarrus(Draw& draw, Scene& scene) {
  const double s = scene.size, height = s * draw.between(0.5, 1.0), out = s * draw.between(0.3, 0.6);
  const int table = scene.add_body("table");
  for (int k = 0; k < 2; ++k) {
    const Vec3 radial = k == 0 ? Vec3::UnitX() : Vec3::UnitY(), axis = Vec3::UnitZ().cross(radial);
    const std::string i = std::to_string(k + 1);
    const int low = scene.add_body("low" + i), high = scene.add_body("high" + i);
    SceneJoint foot{"foot" + i, "revolute", kGroundBody, low, 0.4 * s * radial, axis};
    if (k == 0) foot.law = turning_law(draw, scene, s);
    scene.add_joint(foot);
    scene.add_joint({"knee" + i, "revolute", low, high, (0.4 * s + out) * radial + 0.5 * height * Vec3::UnitZ(), axis});
    scene.add_joint({"hand" + i, "revolute", high, table, 0.4 * s * radial + height * Vec3::UnitZ(), axis});
  }
  scene.boresight_body = table;
  scene.about = "Sarrus' linkage";
}

void draw_door(Draw& draw, Scene& scene) {
  const int panel = scene.add_body("panel"), hinges = draw.whole(2, 3);
  const bool driven = draw.chance(0.6);
  const double s = scene.size;
  for (int k = 0; k < hinges; ++k) {
    SceneJoint h{fmt::format("hinge{}", k + 1),
                 "revolute",
                 kGroundBody,
                 panel,
                 Vec3(0, 0, s * (k / (hinges - 1.0) - 0.5)),
                 Vec3::UnitZ()};
    if (k == 0 && driven) h.law = turning_law(draw, scene, s);
    const int joint = scene.add_joint(h);
    if (k == 0 && !driven) scene.rates.push_back({joint, draw.between(-1.0, 1.0)});
  }
  SceneBody& b = scene.bodies[panel];
  b.center_of_mass = {0.5 * s, 0, 0.05 * s};
  b.mass = 5.0 * std::pow(s / 0.3, 2.3);
  b.inertia = b.mass * s * s / 12.0 * Vec3(1.0, 2.0, 1.02);
  b.complete = true;
  if (!driven) {
    SceneSpring spring;
    spring.second = panel;
    spring.first_point = Vec3(-0.2, 0.5, 0) * s;
    spring.second_point = Vec3(0.4, 0, 0) * s;
    spring.stiffness = 10.0 * b.mass * 9.8 / s;
    spring.damping = draw.chance(0.5) ? 0.0 : 0.1 * std::sqrt(spring.stiffness * b.mass);
    spring.free_length = 0.7 * s;
    scene.springs.push_back(spring);
    scene.undriven_freedoms = 1;
  }
  scene.boresight_body = panel;
  scene.about = fmt::format("A panel on {} hinges, {}", hinges, driven ? "driven" : "opened by a spring");
}

// Watt: a second loop on two bars of the first. Stephenson: from the coupler to the ground.
void draw_six_bar(Draw& draw, Scene& scene) {
  const double s = scene.size;
  const bool watt = draw.chance(0.5);
  const Vec3 n = Vec3::UnitZ(), A(0, 0, 0), B(0.1 * s, 0.3 * s, 0), C(0.9 * s, 0.7 * s, 0), D(s, 0, 0);
  const Vec3 E = watt ? Vec3(1.25 * s, 0.55 * s, 0) : Vec3(0.45 * s, 0.8 * s, 0);
  const Vec3 G = watt ? Vec3(2.0 * s, 0, 0) : Vec3(0.2 * s, 1.6 * s, 0),
             F = watt ? Vec3(1.95 * s, 0.7 * s, 0) : Vec3(0.9 * s, 1.4 * s, 0);
  const int crank = scene.add_body("crank"), coupler = scene.add_body("coupler"), rocker = scene.add_body("rocker"),
            link = scene.add_body("link"), output = scene.add_body("output");
  scene.add_joint({"A", "revolute", kGroundBody, crank, A, n, Vec3::UnitX(), turning_law(draw, scene, s)});
  scene.add_joint({"B", "revolute", crank, coupler, B, n});
  scene.add_joint({"C", "revolute", coupler, rocker, C, n});
  scene.add_joint({"D", "revolute", kGroundBody, rocker, D, n});
  scene.add_joint({"E", "revolute", watt ? rocker : coupler, link, E, n});
  scene.add_joint({"F", "revolute", link, output, F, n});
  scene.add_joint({"G", "revolute", kGroundBody, output, G, n});
  scene.boresight_body = output;
  scene.about = watt ? "Watt's chain of six bars" : "Stephenson's chain of six bars";
}

}  // namespace

void draw_redundant(Draw& draw, Scene& scene) {
  switch (draw.whole(0, 3)) {
    case 0:
      draw_parallelogram(draw, scene);
      break;
    case 1:
      draw_sarrus(draw, scene);
      break;
    case 2:
      draw_door(draw, scene);
      break;
    default:
      draw_six_bar(draw, scene);
  }
  scene.boresight = draw.direction();
}

}  // namespace boresight::gauntlet
