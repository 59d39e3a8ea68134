// Open chains: driven arms of revolutes, slides and pins, and what nothing drives: pendulums, a mass on springs, a chain that
// floats free in space.
#include <fmt/format.h>

#include "families.hpp"

namespace boresight::gauntlet {

void draw_arm(Draw& draw, Scene& scene) {
  const int links = draw.whole(2, 5);
  Vec3 at = Vec3::Zero(), along = draw.direction();
  int inner = kGroundBody;
  for (int k = 1; k <= links; ++k) {
    const int body = scene.add_body(fmt::format("link{}", k));
    const bool slides = draw.chance(0.2);
    SceneJoint j{fmt::format("joint{}", k), slides ? "prismatic" : "revolute", inner, body, at, draw.direction()};
    j.law = slides ? sliding_law(draw, scene, scene.size / links) : turning_law(draw, scene, scene.size);
    scene.add_joint(j);
    along = (along + 0.8 * draw.direction()).normalized();
    at += scene.size / links * draw.between(0.6, 1.2) * along;
    inner = body;
  }
  scene.boresight_body = inner;
  scene.boresight = draw.direction();
  scene.about = fmt::format("An arm of {} driven joints", links);
}

void draw_pendulum(Draw& draw, Scene& scene) {
  const int links = draw.whole(1, 3);
  Vec3 at = Vec3::Zero();
  const Vec3 down = draw.direction();
  Vec3 axis = across(down);
  int inner = kGroundBody;
  for (int k = 1; k <= links; ++k) {
    const int body = scene.add_body(fmt::format("link{}", k));
    const int joint = scene.add_joint({fmt::format("joint{}", k), "revolute", inner, body, at, axis, Vec3::UnitX()});
    if (k == 1 || draw.chance(0.5))
      scene.rates.push_back({joint, draw.between(-1.0, 1.0) * std::sqrt(9.8 / scene.size)});
    at += scene.size / links * (down + 0.5 * draw.direction()).normalized();
    if (draw.chance(0.5)) axis = (axis + 0.7 * draw.direction()).normalized();
    inner = body;
  }
  scene.boresight_body = inner;
  scene.boresight = draw.direction();
  scene.undriven_freedoms = links;
  scene.about = fmt::format("A pendulum of {} links that nothing drives", links);
}

void draw_sprung_slide(Draw& draw, Scene& scene) {
  const Vec3 along = draw.direction(), axis = across(along);
  const int carriage = scene.add_body("carriage"), head = scene.add_body("head");
  const int slide = scene.add_joint({"slide", "prismatic", kGroundBody, carriage, Vec3::Zero(), along, Vec3::UnitX()});
  scene.add_joint({"hinge", "revolute", carriage, head, 0.2 * scene.size * axis, axis, Vec3::UnitX(),
                   turning_law(draw, scene, 0.5 * scene.size)});
  scene.rates.push_back({slide, draw.between(-0.5, 0.5) * std::sqrt(9.8 * scene.size)});
  SceneSpring s;
  s.second = carriage;
  s.first_point = -scene.size * along;
  s.second_point = 0.05 * scene.size * along;
  const double period = scene.duration * draw.between(0.4, 3.0);
  s.stiffness = 10.0 * std::pow(scene.size / 0.3, 2.3) * std::pow(6.283 / period, 2);
  s.damping = draw.chance(0.5) ? 0.0 : draw.between(0.02, 0.6) * s.stiffness * period / 6.283;
  s.free_length = scene.size * draw.between(0.95, 1.15);
  scene.springs.push_back(s);
  scene.boresight_body = head;
  scene.boresight = draw.direction();
  scene.undriven_freedoms = 1;
  scene.about = "A carriage on a spring with a driven head";
}

// Nothing holds it: its momentum stays what it was.
void draw_free_chain(Draw& draw, Scene& scene) {
  const int links = draw.whole(2, 4);
  Vec3 at = Vec3::Zero();
  int inner = scene.add_body("hub");
  for (int k = 1; k <= links; ++k) {
    at += scene.size * draw.between(0.3, 0.8) * draw.direction();
    const int body = scene.add_body(fmt::format("link{}", k));
    SceneJoint j{fmt::format("joint{}", k), "revolute", inner, body, at, draw.direction()};
    if (k == 1 || draw.chance(0.7)) {
      j.law = turning_law(draw, scene, scene.size);
    } else {
      ++scene.undriven_freedoms;
    }
    scene.add_joint(j);
    inner = body;
  }
  scene.floats = true;
  scene.undriven_freedoms += 6;
  scene.boresight_body = draw.whole(0, links);
  scene.boresight = draw.direction();
  scene.about = fmt::format("A chain of {} links that floats free", links);
}

}  // namespace boresight::gauntlet
