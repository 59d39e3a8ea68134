// How stiff the ring contact of ring_contact.hpp is where it stands, as columns of a ContactTangent: with cos a = -d0 / A (a = pi in full
// contact) the energy's second derivatives are (K_c / pi) [a, sin a; sin a, (a + sin a cos a) / 2] in (d0, A), and
// (K_c / 2 pi) (a - sin a cos a) for a slope across the tilt.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "boresight/play/contact_tangent.hpp"

namespace boresight {

// stiffness K_c [N/m]; radius: of the ring [m]; penetration d0 + A > 0 [m]; slope: of the insert's axis; closing: +1 or -1, by how much d0
// grows with the offset along the axis.
inline void add_ring_tangent(double stiffness, double radius, double penetration, const Vec2T<double>& slope,
                             double closing, ContactPlace place, ContactTangent& tangent) {
  const double tilt = slope.norm(), swing = radius * tilt, depth = penetration - swing;
  const double a = depth >= swing ? std::numbers::pi : std::acos(std::clamp(-depth / swing, -1.0, 1.0));
  const double s = std::sin(a), c = std::cos(a), k = stiffness / std::numbers::pi;
  const double ux = tilt > 0.0 ? slope[0] / tilt : 1.0, uz = tilt > 0.0 ? slope[1] / tilt : 0.0;
  PlayOffsets depth_gradient, swing_gradient, across;
  depth_gradient << 0.0, closing, 0.0, 0.0, 0.0, 0.0;
  swing_gradient << 0.0, 0.0, 0.0, radius * ux, radius * uz, 0.0;
  across << 0.0, 0.0, 0.0, -radius * uz, radius * ux, 0.0;
  // Cholesky factor of the two by two matrix: [p 0; q r].
  const double p = std::sqrt(k * a), q = p > 0.0 ? k * s / p : 0.0;
  const double r = std::sqrt(std::max(0.0, 0.5 * k * (a + s * c) - q * q));
  tangent.add(place, p * depth_gradient + q * swing_gradient);
  tangent.add(place, r * swing_gradient);
  tangent.add(place, std::sqrt(std::max(0.0, 0.5 * k * (a - s * c))) * across);
}

}  // namespace boresight
