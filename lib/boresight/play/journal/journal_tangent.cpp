// How stiff a journal's contacts are where they stand. A radial contact has one column: the root of the elastic slope (Hertz:
// 1.5 K sqrt(d)) times the gradient of its penetration. A face that tilts has three: ring_tangent.hpp.
#include <cmath>

#include "boresight/play/journal/journal_in_sleeve.hpp"
#include "boresight/play/journal/ring_tangent.hpp"

namespace boresight {
namespace {

using Column = PlayOffsets;

}  // namespace

ContactTangent JournalInSleeve::tangent(const PlayMotion<double>& m) const {
  ContactTangent tangent;
  ContactStates<double> contact;
  penetrations(m, contact);
  const auto depth = [&](ContactPlace place) { return contact[static_cast<int>(place)].penetration; };
  if (!tilts) {
    if (const double d = depth(ContactPlace::radial); d > 0.0) {
      const double root = std::sqrt(radial_law.elastic_slope(d)) / std::hypot(m.e.x(), m.e.z());
      tangent.add(ContactPlace::radial, Column(root * m.e.x(), 0.0, root * m.e.z(), 0.0, 0.0, 0.0));
    }
    for (ContactPlace face : {ContactPlace::axial_minus, ContactPlace::axial_plus})
      if (depth(face) > 0.0) tangent.add(face, Column(0.0, std::sqrt(face_stiffness), 0.0, 0.0, 0.0, 0.0));
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
      n << x, slides ? -x * m.slope[0] - z * m.slope[1] : 0.0, z, reach * x, reach * z, 0.0;
      tangent.add(end, root * n);
    }
    if (!has_faces) continue;
    const double d = depth(TiltedJournal::axial_place(side));
    if (d > 0.0)
      add_ring_tangent(tilted.face_stiffness, tilted.ring_radius, d, m.slope, -side, TiltedJournal::axial_place(side),
                       tangent);
  }
  return tangent;
}

}  // namespace boresight
