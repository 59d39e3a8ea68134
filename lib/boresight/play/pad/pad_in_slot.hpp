// A round pad between two parallel faces: the play of a planar joint.
//
// In the slot's frame, y along the normal of its faces, with e the pad's centre, c the gap between pad and face on each side, R the pad's
// radius, sigma = (a_x, a_z) / a_y the slope of the pad's normal a (zero where it keeps parallel to the faces):
//   face s = +-1, at y = s c    on the pad's rim  d(alpha) = d0 + A cos(alpha),  d0 = s e_y - c,  A = R |sigma|
//   normal force                the rim as a ring of stiffness K_p (ring_contact.hpp), times 1 + h d_P' / v0, plus D d_P', never below zero
//   sliding                     v = edot + w x (Q - e), its part along the face, at the centre of pressure Q
// K_p = 2 R E_s of a flat punch (hertz.hpp), or that of the law "kelvin-voigt" and its D; h of the law that the file names: the restitution
// that h gives is the same for any elastic force (exact_restitution.hpp). d_P' is the rate at which the face is approached at the centre of
// pressure, so that damping takes exactly h / v0 d_P'^2 of the elastic force as power, and never gives any; v0 is one for a face: a contact
// begins at a point of the rim, where d_P' is the rate of the deepest point that v0 is latched from, and the rest of the rim follows as the
// one contact rolls on.
// An elastic pad on a half-space resists tilts by (4/3) E_s R^3 (Johnson 1985, Contact Mechanics, 3.12), its rim by K_p R^2 / 2 = E_s R^3;
// where it lifts off, both turn about the rim. What twists the pad about its own normal does not rub, as in a ring's centre of pressure.
// Derived for this program; held against the gradient of the energy in a test.
#pragma once

#include <vector>

#include "boresight/play/journal/ring_contact.hpp"
#include "boresight/play/play_kind.hpp"

namespace boresight {

template <typename T>
struct PadInSlotT {
  T clearance{};      // c, on each side [m]
  T radius{};         // R [m]
  NormalLawT<T> law;  // linear: K_p, h, D
  FrictionLawT<T> friction;
  bool tilts = false;  // axes = "free"

  static bool serves(const ClearanceDescription& description, JointType type) {
    return type == JointType::planar && description.pad == PadShape::round;
  }
  static PlayWords words() { return {"pad", "slot"}; }

  template <typename M>
  void penetrations(const PlayMotion<M>& motion, ContactStates<M>& contact) const {
    for (ContactState<M>& c : contact) c = {M(-1.0), M(0.0), M(0.0)};
    for (const int side : {-1, 1}) {
      const Face<M> on = face(motion, side);
      contact[static_cast<int>(place_of(side))] = {on.depth + on.swing, on.rate(motion, T(1.0), radius), M(0.0)};
    }
  }

  // M: the scalar of the motion, T itself or one that carries derivatives besides. Out: PlayWrench<M>, or PlayLoad<M>.
  template <typename M, typename Friction, typename Out>
  void wrench(const PlayMotion<M>& m, const ImpactSpeeds<T>& impact_speed, const Friction& traction, Out& out) const {
    forget_contacts(out);
    out.force.setConstant(M(0.0));
    out.moment.setConstant(M(0.0));
    for (const int side : {-1, 1}) {
      const Face<M> on = face(m, side);
      const ContactPlace place = place_of(side);
      const M penetration = on.depth + on.swing, rate = on.rate(m, T(1.0), radius);
      keep_contact(out, place, {penetration, rate, M(0.0)});
      if (!any(penetration > T(0.0))) continue;
      const RingForce<M> ring = ring_contact(law.stiffness, on.depth, on.swing);
      const M closing = on.rate(m, ring.moment_arm, radius);
      const M whole = ring.force * (T(1.0) + law.damping_factor * closing / impact_speed[static_cast<int>(place)]) +
                      law.dashpot * closing;
      const M F = select(penetration > T(0.0), positive_part(whole), M(0.0));
      keep_contact(out, place, {penetration, rate, F});
      const M reach = radius * ring.moment_arm;
      const Vec3T<M> push(M(0.0), T(-side) * F, M(0.0));
      out.force += push;
      out.moment += m.e.cross(push) + moment_of_couple(-F * reach * on.ux, -F * reach * on.uz, m);
      const Vec3T<M> Q(m.e.x() - T(side) * reach * on.ux, M(T(side) * clearance), m.e.z() - T(side) * reach * on.uz);
      const Vec3T<M> v = m.e_dot + m.w.cross(Vec3T<M>(Q - m.e));
      const auto [fx, fz] = traction(static_cast<int>(place), F, M(v.x()), M(v.z()));
      const Vec3T<M> rub(fx, M(0.0), fz);
      out.force += rub;
      out.moment += Q.cross(rub);
    }
  }

  void keep_only(const std::array<bool, kContactPlaces>& touching) {
    if (!touching[static_cast<int>(ContactPlace::axial_minus)] && !touching[static_cast<int>(ContactPlace::axial_plus)])
      clearance = T(kOutOfReach);
  }
  std::array<T*, 12> numbers() {
    return {&clearance,
            &radius,
            &law.stiffness,
            &law.damping_factor,
            &law.length,
            &law.exponent,
            &law.dashpot,
            &friction.coefficient,
            &friction.static_speed,
            &friction.dynamic_speed,
            &friction.stiction,
            &friction.stribeck_speed};
  }
  template <typename U>
  void take_shape_of(const PadInSlotT<U>& other) {
    tilts = other.tilts;
    law.curve = other.law.curve;
    friction.kind = other.friction.kind;
  }
  void complete() {}

  // The face at y = side c.
  static ContactPlace place_of(int side) { return side < 0 ? ContactPlace::axial_minus : ContactPlace::axial_plus; }

 protected:
  template <typename M>
  struct Face {
    T side;
    M depth, swing, ux, uz;  // d0, A, sigma / |sigma|

    // How fast the pad approaches the face at the share `arm` of the radius, on the side that is deepest [m/s].
    template <typename Arm>
    M rate(const PlayMotion<M>& m, const Arm& arm, const T& radius) const {
      return side * m.e_dot.y() + radius * arm * (ux * m.slope_rate[0] + uz * m.slope_rate[1]);
    }
  };
  template <typename M>
  Face<M> face(const PlayMotion<M>& m, int side) const {
    Face<M> on{T(side), T(side) * m.e.y() - clearance, M(0.0), M(0.0), M(0.0)};
    if (!tilts) return on;
    const M tilt = length_from_square(M(m.slope[0] * m.slope[0] + m.slope[1] * m.slope[1]));
    on.swing = radius * tilt;
    on.ux = m.slope[0] / tilt;
    on.uz = m.slope[1] / tilt;
    return on;
  }
};

struct PadInSlot : PadInSlotT<double> {
  PadInSlot() = default;
  PadInSlot(const ClearanceDescription& description, JointType joint, const ClearanceParameters& parameters);

  // As play_kind.hpp asks.
  std::vector<ContactPlace> places() const { return {ContactPlace::axial_minus, ContactPlace::axial_plus}; }
  static constexpr std::array kInputs = {MotionInputs::parallel, MotionInputs::tilting};
  MotionInputs inputs() const { return kInputs[tilts ? 1 : 0]; }
  double elastic_energy(const PlayMotion<double>& motion) const;
  PadInSlot elastic_only() const;
  ContactTangent tangent(const PlayMotion<double>& motion) const;
  RestingPlay rest_under(const PlayOffsets& load, const JointCoordinates& joint, const RestingPlay& before) const;
  std::vector<GapPart> gap_parts(const RestingPlay& rest, const JointCoordinates& joint) const;
  std::vector<double> clearances() const { return {clearance}; }
  PlayOffsets widths(double other) const;
  OffsetGroups pushed_together() const { return {{1}, {3, 4}}; }
  double lever() const { return radius; }
  double size() const { return radius; }
  const NormalLaw& normal_law() const { return law; }
  double axial_stiffness() const { return law.stiffness; }
  PlayOffsets root_stiffness(double load) const;
};

}  // namespace boresight
