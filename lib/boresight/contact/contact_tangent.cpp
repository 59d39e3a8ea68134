#include "boresight/contact/contact_tangent.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace boresight {
namespace {

using Column = Eigen::Matrix<double, 5, 1>;

void add_ring(const TiltedJournal& joint, const JournalMotion<double>& m, int side, double penetration,
              ContactTangent& tangent) {
  const ContactPlace place = TiltedJournal::axial_place(side);
  const double tilt = m.slope.norm(), swing = joint.ring_radius * tilt, depth = penetration - swing;
  const double a = depth >= swing ? std::numbers::pi : std::acos(std::clamp(-depth / swing, -1.0, 1.0));
  const double s = std::sin(a), c = std::cos(a), k = joint.face_stiffness / std::numbers::pi;
  const double ux = tilt > 0.0 ? m.slope[0] / tilt : 1.0, uz = tilt > 0.0 ? m.slope[1] / tilt : 0.0;
  Column depth_gradient, swing_gradient, across;
  depth_gradient << 0.0, -side, 0.0, 0.0, 0.0;
  swing_gradient << 0.0, 0.0, 0.0, joint.ring_radius * ux, joint.ring_radius * uz;
  across << 0.0, 0.0, 0.0, -joint.ring_radius * uz, joint.ring_radius * ux;
  // Cholesky factor of the two by two matrix: [p 0; q r].
  const double p = std::sqrt(k * a), q = p > 0.0 ? k * s / p : 0.0;
  const double r = std::sqrt(std::max(0.0, 0.5 * k * (a + s * c) - q * q));
  tangent.column[tangent.count++] = {place, p * depth_gradient + q * swing_gradient};
  tangent.column[tangent.count++] = {place, r * swing_gradient};
  tangent.column[tangent.count++] = {place, std::sqrt(std::max(0.0, 0.5 * k * (a - s * c))) * across};
}

}  // namespace

ContactTangent contact_tangent(const JournalInSleeve& joint, const JournalMotion<double>& m) {
  ContactTangent tangent;
  std::array<ContactState<double>, kContactPlaces> contact;
  joint.penetrations(m, contact);
  const auto depth = [&](ContactPlace place) { return contact[static_cast<int>(place)].penetration; };
  if (!joint.tilts) {
    if (const double d = depth(ContactPlace::radial); d > 0.0) {
      const double root = std::sqrt(joint.radial_law.elastic_slope(d)) / std::hypot(m.e.x(), m.e.z());
      tangent.column[tangent.count++] = {ContactPlace::radial, Column(root * m.e.x(), 0.0, root * m.e.z(), 0.0, 0.0)};
    }
    for (ContactPlace face : {ContactPlace::axial_minus, ContactPlace::axial_plus})
      if (depth(face) > 0.0)
        tangent.column[tangent.count++] = {face, Column(0.0, std::sqrt(joint.face_stiffness), 0.0, 0.0, 0.0)};
    return tangent;
  }
  for (int side : {-1, 1}) {
    const ContactPlace end = TiltedJournal::radial_place(side);
    if (const double d = depth(end); d > 0.0) {
      const bool slides = joint.tilted.slides;
      const double reach = side * joint.half_length - (slides ? m.e.y() : 0.0);
      const double x = m.e.x() + reach * m.slope[0], z = m.e.z() + reach * m.slope[1];
      const double root = std::sqrt(joint.tilted.end_law.elastic_slope(d)) / std::hypot(x, z);
      Column n;
      n << x, slides ? -x * m.slope[0] - z * m.slope[1] : 0.0, z, reach * x, reach * z;
      tangent.column[tangent.count++] = {end, root * n};
    }
    if (!joint.has_faces) continue;
    const double d = depth(TiltedJournal::axial_place(side));
    if (d > 0.0) add_ring(joint.tilted, m, side, d, tangent);
  }
  return tangent;
}

}  // namespace boresight
