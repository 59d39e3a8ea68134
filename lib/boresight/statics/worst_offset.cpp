#include "boresight/statics/worst_offset.hpp"

#include <Eigen/Eigenvalues>
#include <cmath>
#include <numbers>

namespace boresight {
namespace {

using Gain = Eigen::Matrix<double, 3, 3>;

// The offset in a joint's gap (a cylinder of radius `radial`, half length `axial`, axis y) with the largest |G xi|. A convex
// function is largest on the rim; its square is a second-order trigonometric polynomial of the angle, so the best of 32
// starts followed by Newton steps is the global maximum.
Vec3 worst_offset(const Gain& G, double radial, double axial) {
  const Vec3 gx = radial * G.col(0), gz = radial * G.col(2), gy = axial * G.col(1);
  const auto value = [&](double s) { return (std::cos(s) * gx + std::sin(s) * gz + gy).squaredNorm(); };
  double best = 0.0;
  for (int k = 1; k < 32; ++k) {
    const double s = k * std::numbers::pi / 16.0;
    if (value(s) > value(best)) best = s;
  }
  for (int k = 0; k < 8; ++k) {
    const Vec3 g = std::cos(best) * gx + std::sin(best) * gz + gy;
    const Vec3 d = -std::sin(best) * gx + std::cos(best) * gz, dd = gy - g;
    const double slope = 2.0 * g.dot(d), curvature = 2.0 * (d.squaredNorm() + g.dot(dd));
    if (!(curvature < 0.0)) break;
    const double next = best - slope / curvature;
    if (!(value(next) >= value(best))) break;
    best = next;
  }
  return {radial * std::cos(best), axial, radial * std::sin(best)};
}

}  // namespace

// The same in a part of any shape. In a ball it lies along the direction that G stretches most.
Vec3 worst_offset(const Gain& G, const GapPart& part) {
  if (part.shape == GapPart::Shape::cylinder) return worst_offset(G, part.radial, part.axial);
  if (part.shape == GapPart::Shape::double_cone) {
    // A convex function is largest on the rim or at a tip.
    const Vec3 rim = worst_offset(G, part.radial, 0.0), tip(0.0, part.axial, 0.0);
    return (G * rim).norm() > (G * tip).norm() ? rim : tip;
  }
  if (part.shape == GapPart::Shape::octahedron) {
    Vec3 worst(part.radial, 0.0, 0.0);
    for (const Vec3& tip : {Vec3(0.0, part.axial, 0.0), Vec3(0.0, 0.0, part.radial)})
      if ((G * tip).norm() > (G * worst).norm()) worst = tip;
    return worst;
  }
  const Eigen::SelfAdjointEigenSolver<Gain> stretch(G.transpose() * G);
  return part.radial * stretch.eigenvectors().col(2);
}

PlayOffsets worst_corner(const Eigen::Matrix<double, 3, kMostOffsets>& G, const std::vector<PlayOffsets>& lines) {
  PlayOffsets worst = PlayOffsets::Zero();
  double largest = -1.0;
  // A corner and its opposite displace alike: the first line keeps its sign.
  for (unsigned signs = 0; signs < 1U << (lines.size() - 1); ++signs) {
    PlayOffsets corner = lines.front();
    for (std::size_t k = 1; k < lines.size(); ++k) corner += (signs >> (k - 1) & 1U ? -1.0 : 1.0) * lines[k];
    if (const double size = (G * corner).squaredNorm(); size > largest) {
      largest = size;
      worst = corner;
    }
  }
  return worst;
}

}  // namespace boresight
