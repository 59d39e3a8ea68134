// Where a pad rests in its slot under a force F along the normal and a couple g on its slopes.
//
//   parallel             |e_y| = c + |F| / K                                                             Hooke
//   tilting              with q = g / (R |F|), and cos a = -d0 / A as in ring_contact.hpp:
//     q <= 1/2           the whole rim touches one face: d0 = |F| / K, A = 2 g / (K R)
//     1/2 < q < 1        a part of it does: q = (a - sin a cos a) / (2 (sin a - a cos a)), A = pi |F| / (K (sin a - a cos a))
//     as far as the other face allows; else opposite parts of the rim touch both faces, where the elastic energy less the work of F and g
//     is least: it is convex, and falls to its least along each of e_y and A.
// Where nothing pushes it, it stays where it was.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "boresight/play/pad/pad_in_slot.hpp"

namespace boresight {
namespace {

constexpr int kHalvings = 60;

// Where a rising function is zero, between `low` and `high`.
template <typename Rising>
double zero_of(const Rising& f, double low, double high) {
  for (int k = 0; k < kHalvings; ++k) {
    const double middle = 0.5 * (low + high);
    (f(middle) > 0.0 ? high : low) = middle;
  }
  return 0.5 * (low + high);
}

struct Pressed {
  double depth, swing;  // d0 on the face that is pressed, A [m]
};

// On one face, as if there were no other.
Pressed on_one_face(double stiffness, double force, double couple) {
  const double q = couple / force;
  if (q <= 0.5) return {force / stiffness, 2.0 * couple / stiffness};
  const auto shape = [](double a) { return std::sin(a) - a * std::cos(a); };
  // q falls from 1 at a = 0 to 1/2 at a = pi.
  const double a =
      zero_of([&](double x) { return 2.0 * q * shape(x) - (x - std::sin(x) * std::cos(x)); }, 0.0, std::numbers::pi);
  const double swing = std::numbers::pi * force / (stiffness * shape(a));
  return {-swing * std::cos(a), swing};
}

// Between both, room = 2 c apart: d0 of the other face is -room - d0.
Pressed between_faces(double stiffness, double room, double force, double couple) {
  const auto ring = [&](double depth, double swing) { return ring_contact(stiffness, depth, swing); };
  const auto depth_at = [&](double swing) {
    const auto excess = [&](double depth) {
      return ring(depth, swing).force - ring(-room - depth, swing).force - force;
    };
    return zero_of(excess, -0.5 * room, swing + force / stiffness);
  };
  const auto excess = [&](double swing) {
    const double depth = depth_at(swing);
    const RingForce<double> here = ring(depth, swing), there = ring(-room - depth, swing);
    return here.force * here.moment_arm + there.force * there.moment_arm - couple;
  };
  double most = 0.5 * room + (force + couple) / stiffness;
  while (excess(most) < 0.0) most *= 2.0;
  const double swing = zero_of(excess, 0.0, most);
  return {depth_at(swing), swing};
}

}  // namespace

RestingPlay PadInSlot::rest_under(const PlayOffsets& load, const JointCoordinates&, const RestingPlay& before) const {
  RestingPlay rest;
  const double force = std::abs(load[1]);
  const Vec2T<double> g = tilts ? Vec2T<double>(load.segment<2>(3)) : Vec2T<double>(Vec2T<double>::Zero());
  const double couple = g.norm() / radius;  // as a force on the rim [N]
  double& y = rest.motion.e.y();
  if (!(force > 0.0) && !(couple > 0.0)) {
    y = std::clamp(before.motion.e.y(), -clearance, clearance);
    const double tilt = before.motion.slope.norm(), room = (clearance - std::abs(y)) / radius;
    rest.motion.slope = tilt > room ? Vec2T<double>(room / tilt * before.motion.slope) : before.motion.slope;
  } else {
    const double side = load[1] < 0.0 ? -1.0 : 1.0;
    Pressed at{force / law.stiffness, 0.0};
    if (couple > 0.0) {
      const double room = 2.0 * clearance;
      const bool one = couple < force;
      if (one) at = on_one_face(law.stiffness, force, couple);
      if (!one || at.swing - at.depth > room) at = between_faces(law.stiffness, room, force, couple);
      rest.motion.slope = at.swing / (radius * g.norm()) * g;
    }
    y = side * (clearance + at.depth);
  }
  PlayWrench<double> elastic;
  elastic_only().wrench(rest.motion, kSlowImpacts, SlidingFriction<double>{elastic_only().friction}, elastic);
  rest.contact = elastic.contact;
  rest.axial_reach = std::max(clearance + force / law.stiffness, std::abs(y) + radius * rest.motion.slope.norm());
  return rest;
}

}  // namespace boresight
