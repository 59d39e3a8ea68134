// Spatial loops: revolute - universal - spherical - revolute, revolute - spherical - cylindrical - revolute, the Bennett loop
// that moves against the count, and a shaft through universal joints.
#include <fmt/format.h>

#include "families.hpp"

namespace boresight::gauntlet {
namespace {

void draw_four_links(Draw& draw, Scene& scene, bool with_universal) {
  const double s = scene.size;
  const Vec3 first_axis = draw.direction();
  const Vec3 last_axis = (first_axis + 1.2 * draw.direction()).normalized();
  const Vec3 O = Vec3::Zero(), D = s * draw.between(0.8, 1.2) * across(first_axis);
  const Vec3 A = O + 0.25 * s * turned(across(first_axis), first_axis, draw.between(1.0, 2.1)) + 0.1 * s * first_axis;
  Vec3 swing = D - A - last_axis * last_axis.dot(D - A);
  const Vec3 B = D + s * draw.between(0.5, 0.8) * turned(swing.normalized(), last_axis, 1.57 * draw.between(0.7, 1.3));
  const int crank = scene.add_body("crank"), rod = scene.add_body("rod"), rocker = scene.add_body("rocker");
  const Vec3 along = (B - A).normalized();
  scene.add_joint(
      {"O", "revolute", kGroundBody, crank, O, first_axis, Vec3::UnitX(), turning_law(draw, scene, 0.5 * s)});
  if (with_universal) {
    Vec3 across_rod = along.cross(first_axis).normalized();
    scene.add_joint({"A", "universal", crank, rod, A, along.cross(across_rod).normalized(), across_rod});
    scene.add_joint({"B", "spherical", rod, rocker, B});
  } else {
    scene.add_joint({"A", "spherical", crank, rod, A});
    Vec3 pin = (last_axis - 0.9 * along * along.dot(last_axis)).normalized();
    scene.add_joint({"B", "cylindrical", rod, rocker, B, pin});
  }
  scene.add_joint({"D", "revolute", kGroundBody, rocker, D, last_axis});
  scene.boresight_body = rocker;
  scene.about = with_universal ? "A spatial loop of revolute, universal, ball and revolute"
                               : "A spatial loop of revolute, ball, pin and revolute";
}

// Bennett (1903): opposite links a, b with twists alpha, beta, a / sin alpha = b / sin beta. The pose for the angle theta at the
// first joint follows from tan(theta / 2) tan(phi / 2) = sin((beta + alpha) / 2) / sin((beta - alpha) / 2).
void draw_bennett(Draw& draw, Scene& scene) {
  const double alpha = draw.between(0.5, 0.9), beta = draw.between(1.1, 1.5), a = 0.5 * scene.size,
               b = a * std::sin(beta) / std::sin(alpha);
  const double theta = draw.between(1.2, 1.9);
  const double phi =
      2.0 * std::atan(std::sin(0.5 * (beta + alpha)) / std::sin(0.5 * (beta - alpha)) / std::tan(0.5 * theta));
  // Denavit and Hartenberg: turn by the joint's angle about z, then length along and twist about the new x.
  Eigen::Isometry3d frame = Eigen::Isometry3d::Identity();
  const double angles[] = {theta, phi, -theta, -phi}, lengths[] = {a, b, a, b}, twists[] = {alpha, beta, alpha, beta};
  int inner = kGroundBody;
  std::vector<Vec3> points, axes;
  for (int k = 0; k < 4; ++k) {
    points.push_back(frame.translation());
    axes.push_back(frame.linear().col(2));
    frame.rotate(Eigen::AngleAxisd(angles[k], Vec3::UnitZ()));
    frame.translate(Vec3(lengths[k], 0, 0));
    frame.rotate(Eigen::AngleAxisd(twists[k], Vec3::UnitX()));
  }
  // The link between the last joint and the first is the ground.
  for (int k = 0; k < 4; ++k) {
    const int outer = k == 3 ? kGroundBody : scene.add_body(fmt::format("bar{}", k + 1));
    SceneJoint j{fmt::format("j{}", k), "revolute", inner, outer, points[k], axes[k]};
    if (k == 0) j.law = turning_law(draw, scene, scene.size);
    scene.add_joint(j);
    inner = outer;
  }
  scene.boresight_body = 1;
  scene.about = "A Bennett loop";
}

void draw_cardan_shaft(Draw& draw, Scene& scene) {
  const double s = scene.size, bend = draw.between(0.15, 0.5);
  const Vec3 in = Vec3::UnitX(), middle = turned(in, Vec3::UnitZ(), bend),
             out = draw.chance(0.5) ? in : turned(middle, Vec3::UnitY(), draw.between(0.1, 0.4));
  const Vec3 A(0.4 * s, 0, 0), B = A + 0.6 * s * middle, C = B + 0.4 * s * out;
  const int driver = scene.add_body("driver"), shaft = scene.add_body("shaft"), driven = scene.add_body("driven");
  scene.add_joint(
      {"input", "revolute", kGroundBody, driver, Vec3::Zero(), in, Vec3::UnitX(), turning_law(draw, scene, 0.3 * s)});
  const auto fork = [](const Vec3& one, const Vec3& other) { return one.cross(other).normalized(); };
  const Vec3 first = fork(in, middle);
  scene.add_joint({"cross1", "universal", driver, shaft, A, first, first.cross(middle).normalized()});
  const Vec3 second = (middle - out).norm() > 0.05 ? fork(middle, out) : Vec3(Vec3::UnitZ());
  scene.add_joint({"cross2", "universal", shaft, driven, B, second, second.cross(out).normalized()});
  scene.add_joint({"output", "cylindrical", kGroundBody, driven, C, out});
  scene.boresight_body = driven;
  scene.about = "A shaft through two universal joints";
}

}  // namespace

void draw_spatial_loop(Draw& draw, Scene& scene) {
  switch (draw.whole(0, 3)) {
    case 0:
      draw_four_links(draw, scene, true);
      break;
    case 1:
      draw_four_links(draw, scene, false);
      break;
    case 2:
      draw_bennett(draw, scene);
      break;
    default:
      draw_cardan_shaft(draw, scene);
  }
  scene.boresight = draw.direction();
}

}  // namespace boresight::gauntlet
