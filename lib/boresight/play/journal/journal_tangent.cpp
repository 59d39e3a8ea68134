// How stiff a journal's contacts are where they stand. A radial contact has one column: the root of the elastic slope (Hertz:
// 1.5 K sqrt(d)) times the gradient of its penetration. A face that tilts has three: with cos a = -d0 / A (a = pi in full contact)
// the energy's second derivatives are (K_c / pi) [a, sin a; sin a, (a + sin a cos a) / 2] in (d0, A), and
// (K_c / 2 pi) (a - sin a cos a) for a slope across the tilt. Derivatives of ring_contact.hpp.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "boresight/play/journal/journal_in_sleeve.hpp"

namespace boresight {
namespace {

using Column = PlayOffsets;

void add_ring(const TiltedJournal& joint, const PlayMotion<double>& m, int side, double penetration,
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
  tangent.add(place, p * depth_gradient + q * swing_gradient);
  tangent.add(place, r * swing_gradient);
  tangent.add(place, std::sqrt(std::max(0.0, 0.5 * k * (a - s * c))) * across);
}

}  // namespace

ContactTangent JournalInSleeve::tangent(const PlayMotion<double>& m) const {
  ContactTangent tangent;
  ContactStates<double> contact;
  penetrations(m, contact);
  const auto depth = [&](ContactPlace place) { return contact[static_cast<int>(place)].penetration; };
  if (!tilts) {
    if (const double d = depth(ContactPlace::radial); d > 0.0) {
      const double root = std::sqrt(radial_law.elastic_slope(d)) / std::hypot(m.e.x(), m.e.z());
      tangent.add(ContactPlace::radial, Column(root * m.e.x(), 0.0, root * m.e.z(), 0.0, 0.0));
    }
    for (ContactPlace face : {ContactPlace::axial_minus, ContactPlace::axial_plus})
      if (depth(face) > 0.0) tangent.add(face, Column(0.0, std::sqrt(face_stiffness), 0.0, 0.0, 0.0));
    return tangent;
  }
  for (int side : {-1, 1}) {
    const ContactPlace end = TiltedJournal::radial_place(side);
    if (const double d = depth(end); d > 0.0) {
      const bool slides = tilted.slides;
      const double reach = side * half_length - (slides ? m.e.y() : 0.0);
      const double x = m.e.x() + reach * m.slope[0], z = m.e.z() + reach * m.slope[1];
      const double root = std::sqrt(tilted.end_law.elastic_slope(d)) / std::hypot(x, z);
      Column n;
      n << x, slides ? -x * m.slope[0] - z * m.slope[1] : 0.0, z, reach * x, reach * z;
      tangent.add(end, root * n);
    }
    if (!has_faces) continue;
    const double d = depth(TiltedJournal::axial_place(side));
    if (d > 0.0) add_ring(tilted, m, side, d, tangent);
  }
  return tangent;
}

}  // namespace boresight
