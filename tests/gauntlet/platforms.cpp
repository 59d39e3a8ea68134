// Parallel platforms: planar 3-RRR, hexapod 6-UPS, a tilting platform of three legs as the paper's, three driven arms with
// universal joints (after Delta).
#include <fmt/format.h>

#include <numbers>

#include "families.hpp"

namespace boresight::gauntlet {
namespace {

constexpr double kThird = 2.0 * std::numbers::pi / 3.0;

Vec3 around(double radius, double angle, double height) {
  return {radius * std::cos(angle), radius * std::sin(angle), height};
}

void draw_3rrr(Draw& draw, Scene& scene) {
  const double s = scene.size, twist = draw.between(0.3, 0.7);
  const int platform = scene.add_body("platform");
  for (int leg = 0; leg < 3; ++leg) {
    const double at = leg * kThird;
    const int arm = scene.add_body(fmt::format("arm{}", leg + 1)), rod = scene.add_body(fmt::format("rod{}", leg + 1));
    const Vec3 base = around(s, at, 0), hand = around(0.25 * s, at + twist, 0), middle = 0.5 * (base + hand);
    const Vec3 elbow = middle + 0.35 * s * Vec3::UnitZ().cross(hand - base).normalized();
    SceneJoint A{fmt::format("A{}", leg + 1), "revolute", kGroundBody, arm, base, Vec3::UnitZ()};
    A.law = turning_law(draw, scene, s);
    scene.add_joint(A);
    scene.add_joint({fmt::format("B{}", leg + 1), "revolute", arm, rod, elbow, Vec3::UnitZ()});
    scene.add_joint({fmt::format("C{}", leg + 1), "revolute", rod, platform, hand, Vec3::UnitZ()});
  }
  scene.boresight_body = platform;
  scene.boresight = Vec3(0.995, 0.0998, 0.0).normalized();
  scene.about = "A planar platform 3-RRR";
}

void draw_hexapod(Draw& draw, Scene& scene) {
  const double s = scene.size, height = s * draw.between(0.8, 1.4), base = s * draw.between(0.6, 0.8),
               top = s * draw.between(0.3, 0.5), spread = draw.between(0.15, 0.3);
  const int platform = scene.add_body("platform");
  for (int leg = 0; leg < 6; ++leg) {
    const double third = kThird * (leg / 2), side = leg % 2 == 0 ? -1.0 : 1.0;
    const Vec3 foot = around(base, third + side * spread, 0),
               hand = around(top, third + side * (0.5 * kThird - spread), height);
    const Vec3 along = (hand - foot).normalized(), across_leg = along.cross(Vec3::UnitZ()).normalized();
    const int cylinder = scene.add_body(fmt::format("cylinder{}", leg + 1)),
              rod = scene.add_body(fmt::format("rod{}", leg + 1));
    scene.add_joint({fmt::format("U{}", leg + 1), "universal", kGroundBody, cylinder, foot, across_leg,
                     along.cross(across_leg).normalized()});
    SceneJoint P{fmt::format("P{}", leg + 1), "prismatic", cylinder, rod, 0.5 * (foot + hand), along};
    P.law = sliding_law(draw, scene, 0.3 * s);
    scene.add_joint(P);
    scene.add_joint({fmt::format("S{}", leg + 1), "spherical", rod, platform, hand});
  }
  scene.boresight_body = platform;
  scene.boresight = Vec3::UnitZ();
  // A hexapod has no journals of its own: the instrument turns in a driven bearing on the platform.
  if (draw.chance(0.7)) {
    const int instrument = scene.add_body("instrument");
    const Vec3 axis = draw.chance(0.5) ? Vec3(Vec3::UnitX()) : draw.direction();
    scene.add_joint({"rotator", "revolute", platform, instrument, Vec3(0, 0, 1.15 * height), axis, Vec3::UnitX(),
                     turning_law(draw, scene, s)});
    scene.boresight_body = instrument;
  }
  scene.about = "A hexapod 6-UPS";
}

// The paper's legs with other dimensions: crank, carriage, tube, rod; joints R R C P R.
void draw_rrcpr(Draw& draw, Scene& scene) {
  const double s = scene.size, eta = -draw.between(0.35, 0.9), r_C = 0.2 * s * draw.between(0.8, 1.2),
               r_F = 0.6 * s * draw.between(0.85, 1.15), height = s * draw.between(0.8, 1.2);
  const int platform = scene.add_body("platform");
  for (int leg = 0; leg < 3; ++leg) {
    const Mat3 R = Eigen::AngleAxisd(leg * kThird, Vec3::UnitZ()).toRotationMatrix();
    const Vec3 a = R * Vec3(std::cos(eta), 0, std::sin(eta)), b = R * Vec3(-std::sin(eta), 0, std::cos(eta)),
               tangent = R * Vec3::UnitY();
    const Vec3 C = R * Vec3(r_C, 0, r_C * std::tan(eta)), F = R * Vec3(r_F, 0, height);
    const std::string i = std::to_string(leg + 1);
    const int crank = scene.add_body("crank" + i), carriage = scene.add_body("carriage" + i),
              tube = scene.add_body("tube" + i), rod = scene.add_body("rod" + i);
    scene.add_joint(
        {"A" + i, "revolute", kGroundBody, crank, Vec3::Zero(), a, Vec3::UnitX(), turning_law(draw, scene, s)});
    scene.add_joint({"B" + i, "revolute", crank, carriage, C, b});
    scene.add_joint({"C" + i, "cylindrical", carriage, tube, C, tangent});
    scene.add_joint({"P" + i, "prismatic", tube, rod, 0.5 * (C + F), (F - C).normalized(), Vec3::UnitX(),
                     sliding_law(draw, scene, 0.3 * s)});
    scene.add_joint({"F" + i, "revolute", rod, platform, F, tangent});
  }
  scene.boresight_body = platform;
  scene.boresight = Vec3::UnitZ();
  scene.about = "A tilting platform of three legs, 3-RRCPR";
}

void draw_delta(Draw& draw, Scene& scene) {
  const double s = scene.size, base = 0.35 * s, hand = 0.15 * s, arm_length = 0.45 * s,
               drop = draw.between(0.7, 0.9) * s;
  const int platform = scene.add_body("platform");
  for (int leg = 0; leg < 3; ++leg) {
    const Mat3 R = Eigen::AngleAxisd(leg * kThird, Vec3::UnitZ()).toRotationMatrix();
    const std::string i = std::to_string(leg + 1);
    const Vec3 tangent = R * Vec3::UnitY(), shoulder = R * Vec3(base, 0, 0),
               elbow = shoulder + R * (arm_length * Vec3(std::cos(0.4), 0, -std::sin(0.4))),
               wrist = R * Vec3(hand, 0, -drop);
    const Vec3 across_rod = tangent.cross(wrist - elbow).normalized();
    const int arm = scene.add_body("arm" + i), rod = scene.add_body("rod" + i);
    scene.add_joint(
        {"A" + i, "revolute", kGroundBody, arm, shoulder, tangent, Vec3::UnitX(), turning_law(draw, scene, s)});
    scene.add_joint({"U" + i, "universal", arm, rod, elbow, tangent, across_rod});
    scene.add_joint({"V" + i, "universal", rod, platform, wrist, across_rod, tangent});
  }
  scene.boresight_body = platform;
  scene.boresight = Vec3(0.0998, 0, -0.995).normalized();
  scene.about = "Three driven arms with universal joints, after Delta";
}

}  // namespace

void draw_platform(Draw& draw, Scene& scene) {
  switch (draw.whole(0, 3)) {
    case 0:
      draw_3rrr(draw, scene);
      break;
    case 1:
      draw_hexapod(draw, scene);
      break;
    case 2:
      draw_rrcpr(draw, scene);
      break;
    default:
      draw_delta(draw, scene);
  }
}

}  // namespace boresight::gauntlet
