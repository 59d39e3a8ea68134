// Planar loops drawn in space: four-bars, slider-cranks, five-bars with two drives. With revolutes everywhere they repeat
// constraints; with a ball and a sliding pin they do not.
#include <fmt/format.h>

#include "families.hpp"

namespace boresight::gauntlet {
namespace {

// Pivots of a chain from ground to ground in the plane z = 0, far from its change points.
std::vector<Vec3> pivots(Draw& draw, const Scene& scene, int bars) {
  std::vector<Vec3> p;
  const double s = scene.size;
  if (bars == 3) {
    const double crank = s * draw.between(0.15, 0.35), height = s * draw.between(0.5, 1.0);
    p = {{0, 0, 0},
         crank * Vec3(std::cos(1.2), std::sin(1.2), 0),
         {s * draw.between(0.7, 1.0), height, 0},
         {s * draw.between(0.9, 1.3), 0, 0}};
  } else {
    const double w = s * draw.between(0.2, 0.5);
    p = {{-w, 0, 0},
         {-w - 0.4 * s, s * draw.between(0.5, 0.7), 0},
         {s * draw.between(-0.1, 0.1), s * draw.between(1.0, 1.2), 0},
         {w + 0.4 * s, s * draw.between(0.5, 0.7), 0},
         {w, 0, 0}};
  }
  return p;
}

}  // namespace

void draw_planar_loop(Draw& draw, Scene& scene) {
  const int kind = draw.whole(0, 2);
  const Vec3 normal = Vec3::UnitZ();
  const bool redundant = draw.chance(0.5);
  if (kind == 2) {  // slider-crank
    const double r = scene.size * draw.between(0.15, 0.3), l = scene.size * draw.between(0.6, 1.0),
                 phi = draw.between(0.6, 1.5);
    const Vec3 O = Vec3::Zero(), A(r * std::cos(phi), r * std::sin(phi), 0);
    const Vec3 B(A.x() + std::sqrt(l * l - A.y() * A.y()), 0, 0);
    const int crank = scene.add_body("crank"), rod = scene.add_body("rod"), slider = scene.add_body("slider");
    scene.add_joint({"O", "revolute", kGroundBody, crank, O, normal, Vec3::UnitX(), turning_law(draw, scene, r)});
    scene.add_joint({"A", redundant ? "revolute" : "spherical", crank, rod, A, normal, Vec3::UnitX(), ""});
    scene.add_joint({"B", redundant ? "revolute" : "cylindrical", rod, slider, B, normal, Vec3::UnitX(), ""});
    scene.add_joint({"P", "prismatic", kGroundBody, slider, B, Vec3::UnitX(), Vec3::UnitX(), ""});
    scene.boresight_body = draw.chance(0.5) ? slider : rod;
    scene.about = "A slider-crank drawn in space";
  } else {
    const int bars = kind == 0 ? 3 : 4;
    const std::vector<Vec3> p = pivots(draw, scene, bars);
    for (int k = 0; k < bars; ++k) scene.add_body(fmt::format("bar{}", k + 1));
    for (int k = 0; k <= bars; ++k) {
      SceneJoint j{fmt::format("j{}", k),       "revolute", k == 0 ? kGroundBody : k - 1,
                   k == bars ? kGroundBody : k, p[k],       normal};
      if (!redundant && k == 1) j.type = "spherical";
      if (!redundant && k == bars - 1) j.type = "cylindrical";
      if (k == 0) j.law = turning_law(draw, scene, scene.size);
      if (bars == 4 && k == 4) {  // the fifth bar's drive turns the bar against the ground
        j.first = kGroundBody;
        j.second = k - 1;
        j.law = turning_law(draw, scene, scene.size);
      }
      scene.add_joint(j);
    }
    scene.boresight_body = draw.whole(1, bars - 1);
    scene.about = fmt::format("A planar loop of {} bars drawn in space", bars);
  }
  scene.boresight = draw.direction();
}

}  // namespace boresight::gauntlet
