// Tables that slide on a plane: held by springs, pushed by a crank, or led by three driven arms that hold them a second time.
#include <fmt/format.h>

#include <numbers>

#include "families.hpp"

namespace boresight::gauntlet {
namespace {

SceneJoint on_plane(int table) {
  return {"plane", "planar", kGroundBody, table, Vec3::Zero(), Vec3::UnitZ(), Vec3::UnitX()};
}

// Three springs in the plane, stretched, so that the table comes back and does not turn far.
void hold_by_springs(Draw& draw, Scene& scene, int table) {
  const double s = scene.size, period = scene.duration * draw.between(0.4, 3.0);
  const double stiffness = 10.0 * std::pow(s / 0.3, 2.3) * std::pow(6.283 / period, 2);
  const double damping = draw.chance(0.5) ? 0.0 : draw.between(0.02, 0.6) * stiffness * period / 6.283;
  for (int k = 0; k < 3; ++k) {
    const double angle = 2.0 * std::numbers::pi * k / 3.0;
    const Vec3 out(std::cos(angle), std::sin(angle), 0.0);
    SceneSpring spring;
    spring.second = table;
    spring.first_point = s * out;
    spring.second_point = 0.3 * s * out;
    spring.stiffness = stiffness;
    spring.damping = damping;
    spring.free_length = 0.6 * s;
    scene.springs.push_back(spring);
  }
}

void draw_sprung_table(Draw& draw, Scene& scene) {
  const int table = scene.add_body("table"), head = scene.add_body("head");
  scene.add_joint(on_plane(table));
  scene.add_joint({"hinge", "revolute", table, head, Vec3(0.1, 0.0, 0.2) * scene.size, draw.direction(), Vec3::UnitX(),
                   turning_law(draw, scene, 0.5 * scene.size)});
  hold_by_springs(draw, scene, table);
  scene.boresight_body = head;
  scene.undriven_freedoms = 3;
  scene.about = "A table on a plane between springs, with a driven head";
}

// The crank's ball leads the table, which may still turn about it.
void draw_pushed_table(Draw& draw, Scene& scene) {
  const double s = scene.size;
  const int crank = scene.add_body("crank"), table = scene.add_body("table");
  scene.add_joint({"crank", "revolute", kGroundBody, crank, Vec3(-0.6, 0.0, 0.1) * s, Vec3::UnitZ(), Vec3::UnitX(),
                   turning_law(draw, scene, s)});
  scene.add_joint({"ball", "spherical", crank, table, Vec3(-0.3, 0.2, 0.1) * s});
  scene.add_joint(on_plane(table));
  hold_by_springs(draw, scene, table);
  scene.boresight_body = table;
  scene.undriven_freedoms = 1;
  scene.about = "A table on a plane that a crank pushes";
}

// The plane holds what the arms' hinges hold already.
void draw_led_table(Draw& draw, Scene& scene) {
  const double s = scene.size;
  const int table = scene.add_body("table");
  for (int k = 0; k < 3; ++k) {
    const double angle = 2.0 * std::numbers::pi * k / 3.0 + draw.between(-0.2, 0.2);
    const Vec3 out(std::cos(angle), std::sin(angle), 0.0), base = s * out, hand = 0.3 * s * out;
    const Vec3 elbow = 0.5 * (base + hand) + 0.35 * s * Vec3::UnitZ().cross(out);
    const std::string i = std::to_string(k + 1);
    const int upper = scene.add_body("upper" + i), lower = scene.add_body("lower" + i);
    scene.add_joint(
        {"base" + i, "revolute", kGroundBody, upper, base, Vec3::UnitZ(), Vec3::UnitX(), turning_law(draw, scene, s)});
    scene.add_joint({"elbow" + i, "revolute", upper, lower, elbow, Vec3::UnitZ()});
    scene.add_joint({"hand" + i, "revolute", lower, table, hand, Vec3::UnitZ()});
  }
  scene.add_joint(on_plane(table));
  scene.boresight_body = table;
  scene.about = "A table on a plane that three driven arms lead";
}

}  // namespace

void draw_stage(Draw& draw, Scene& scene) {
  switch (draw.whole(0, 2)) {
    case 0:
      draw_sprung_table(draw, scene);
      break;
    case 1:
      draw_pushed_table(draw, scene);
      break;
    default:
      draw_led_table(draw, scene);
  }
  scene.boresight = draw.direction();
}

}  // namespace boresight::gauntlet
