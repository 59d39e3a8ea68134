// A rectangular pad between two parallel faces: the play of a planar joint.
//
// In the slot's frame, y along the normal of its faces, with e the pad's centre, c the gap between pad and face on each side, w and l half the
// pad's width and half its length, sigma = (a_x, a_z) / a_y the slope of the pad's normal a (zero where it keeps parallel to the faces), psi
// its twist, by which it turns about that normal as far as the joint does:
//   corner (i, j), i, j = +-1        X = i w cos psi + j l sin psi,  Z = j l cos psi - i w sin psi    from e, along the slot
//   on face s = +-1, at y = s c      d = s (e_y - sigma_x X - sigma_z Z) - c
//   normal force                     K/4 d (1 + h d' / v0) + D/4 d', never below zero
//   sliding                          v = edot + w x (Q - e), its part along the face, at the corner Q
// K is that of the whole pad pressed flat, as a rigid rectangular punch on a half-space (flat_face_stiffness.hpp), or that of the law
// "kelvin-voigt" and its D, a quarter at each corner; h of the law that the file names: the restitution that h gives is the same for any
// elastic force (exact_restitution.hpp).
// Each force acts along the gradient of its penetration on e, sigma and psi, so that elastic contact keeps energy exactly. Penetrations are
// of first order in offsets and slopes.
// About the length four corners resist tilts by K w^2, of a square of side a 0.284 E_s a^3, where the punch on its half-space does by
// 0.225 E_s a^3 (Gazetas 1991, table 1, rocking); they lift off one by one, and turn about an edge once the load is beyond it.
// Each corner rubs by its own velocity, so that what twists the pad rubs too.
// Derived for this program; held against the gradient of the energy in a test.
#pragma once

#include <vector>

#include "boresight/play/play_kind.hpp"

namespace boresight {

template <typename T>
struct RectangularPadInSlotT {
  T clearance{};            // c, on each side [m]
  std::array<T, 2> half{};  // w, l [m]
  T stiffness{};            // K [N/m]
  T damping_factor{};       // h
  T dashpot{};              // D [N s/m]
  FrictionLawT<T> friction;
  bool tilts = false;  // axes = "free"
  static constexpr int kCorners = 8;
  std::array<bool, kCorners> idle{};  // corners out of reach

  static bool serves(const ClearanceDescription& description, JointType type) {
    return type == JointType::planar && description.pad == PadShape::rectangular;
  }
  static PlayWords words() { return {"pad", "slot"}; }

  template <typename M>
  void penetrations(const PlayMotion<M>& motion, ContactStates<M>& contact) const {
    for (ContactState<M>& c : contact) c = {M(-1.0), M(0.0), M(0.0)};
    each_corner([&](int k) {
      const Corner<M> at = corner(motion, k);
      contact[static_cast<int>(place_of(k))] = {at.depth, at.rate, M(0.0)};
    });
  }

  // M: the scalar of the motion, T itself or one that carries derivatives besides. Out: PlayWrench<M>, or PlayLoad<M>.
  template <typename M, typename Friction, typename Out>
  void wrench(const PlayMotion<M>& m, const ImpactSpeeds<T>& impact_speed, const Friction& traction, Out& out) const {
    forget_contacts(out);
    out.force.setConstant(M(0.0));
    out.moment.setConstant(M(0.0));
    const T share(0.25);
    each_corner([&](int k) {
      const Corner<M> at = corner(m, k);
      const int place = static_cast<int>(place_of(k));
      keep_contact(out, place_of(k), {at.depth, at.rate, M(0.0)});
      if (idle[static_cast<std::size_t>(k)] || !any(at.depth > T(0.0))) return;
      const M whole = T(share * stiffness) * at.depth * (T(1.0) + damping_factor * at.rate / impact_speed[place]) +
                      T(share * dashpot) * at.rate;
      const M F = select(at.depth > T(0.0), positive_part(whole), M(0.0));
      keep_contact(out, place_of(k), {at.depth, at.rate, F});
      const M push = M(-at.side * F), zero(0.0);
      out.force.y() += push;
      out.moment += m.e.cross(Vec3T<M>(zero, push, zero));
      if (tilts)
        out.moment += moment_of_couple(M(-push * at.X), M(-push * at.Z), m) +
                      (-push * (m.slope[0] * at.Z - m.slope[1] * at.X)) * roll_axis(m);
      const Vec3T<M> Q(m.e.x() + at.X, M(at.side * clearance), m.e.z() + at.Z);
      const Vec3T<M> v = m.e_dot + m.w.cross(Vec3T<M>(Q - m.e));
      const auto [fx, fz] = traction(place, F, M(v.x()), M(v.z()));
      const Vec3T<M> rub(fx, zero, fz);
      out.force += rub;
      out.moment += Q.cross(rub);
    });
  }

  void keep_only(const std::array<bool, kContactPlaces>& touching) {
    each_corner([&](int k) { idle[static_cast<std::size_t>(k)] = !touching[static_cast<std::size_t>(place_of(k))]; });
  }
  std::array<T*, 11> numbers() {
    return {&clearance,
            &half[0],
            &half[1],
            &stiffness,
            &damping_factor,
            &dashpot,
            &friction.coefficient,
            &friction.static_speed,
            &friction.dynamic_speed,
            &friction.stiction,
            &friction.stribeck_speed};
  }
  template <typename U>
  void take_shape_of(const RectangularPadInSlotT<U>& other) {
    tilts = other.tilts;
    idle = other.idle;
    friction.kind = other.friction.kind;
  }
  void complete() {}

  // k: 0 to 3 on the face at y = -c, 4 to 7 on the other one; on each left and right at the rear, then left and right at the front.
  static ContactPlace place_of(int k) {
    return static_cast<ContactPlace>(static_cast<int>(ContactPlace::axial_minus_left_rear) + k);
  }
  template <typename Do>
  static void each_corner(const Do& act) {
    for (int k = 0; k < kCorners; ++k) act(k);
  }

 protected:
  // One corner on one face.
  template <typename M>
  struct Corner {
    T side;               // s
    M X, Z, depth, rate;  // along the slot from the pad's centre; d, d'
  };
  template <typename M>
  Corner<M> corner(const PlayMotion<M>& m, int k) const {
    const T s(k < 4 ? -1.0 : 1.0), across = T(k % 2 == 0 ? -1.0 : 1.0) * half[0],
                                   along = T(k % 4 < 2 ? -1.0 : 1.0) * half[1];
    const M &cosine = m.twist[0], &sine = m.twist[1];
    Corner<M> at{s, across * cosine + along * sine, along * cosine - across * sine, s * m.e.y() - clearance,
                 s * m.e_dot.y()};
    if (!tilts) return at;
    // X' = psi' Z, Z' = -psi' X.
    const M turn = m.w.dot(roll_axis(m));
    at.depth -= s * (m.slope[0] * at.X + m.slope[1] * at.Z);
    at.rate -= s * (m.slope_rate[0] * at.X + m.slope_rate[1] * at.Z + turn * (m.slope[0] * at.Z - m.slope[1] * at.X));
    return at;
  }
};

struct RectangularPadInSlot : RectangularPadInSlotT<double> {
  RectangularPadInSlot() = default;
  RectangularPadInSlot(const ClearanceDescription& description, JointType joint, const ClearanceParameters& parameters);

  // As play_kind.hpp asks.
  std::vector<ContactPlace> places() const;
  static constexpr std::array kInputs = {MotionInputs::twisting};
  MotionInputs inputs() const { return kInputs[0]; }
  double elastic_energy(const PlayMotion<double>& motion) const;
  // What the elastic contacts push the offsets by [N, N m].
  PlayOffsets elastic_force(const PlayMotion<double>& motion) const;
  RectangularPadInSlot elastic_only() const;
  ContactTangent tangent(const PlayMotion<double>& motion) const;
  RestingPlay rest_under(const PlayOffsets& load, const JointCoordinates& joint, const RestingPlay& before) const;
  std::vector<GapPart> gap_parts(const RestingPlay& rest, const JointCoordinates& joint) const;
  std::vector<double> clearances() const { return {clearance}; }
  PlayOffsets widths(double other) const;
  OffsetGroups pushed_together() const {
    return {{1}, {3, 4}};
  }  // as the pad twists in its slot, either slope is of either side
  double lever() const { return half[0] > half[1] ? half[0] : half[1]; }
  double size() const { return lever(); }
  const NormalLaw& normal_law() const { return law; }
  double axial_stiffness() const { return stiffness; }
  PlayOffsets root_stiffness(double load) const;

  NormalLaw law;  // of the whole pad: linear, K, h, D

 private:
  // The offsets' part in the penetration of corner k.
  PlayOffsets gradient(const PlayMotion<double>& motion, int k) const;
};

}  // namespace boresight
