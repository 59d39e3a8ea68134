// Three-dimensional clearance of a revolute or cylindrical joint, or of a prismatic one with a round guide whose key holds the turn about its
// axis: the forces between journal and sleeve.
//
// Everything is expressed in the sleeve frame (origin at the sleeve's centre, y along its axis). With e the journal's
// centre, edot its rate as seen from the sleeve, w the journal's angular velocity relative to the sleeve:
//   radial   n = e_perp / |e_perp|, d = |e_perp| - c_r, ddot = edot . n;  contact at Q = R_b n on the bore
//   axial    plus face:  d = -e_y - c_a;  minus face: d = e_y - c_a;      contact at (0, +-L_b/2, 0)
//   sliding  v = edot + w x (Q - e), its part across the normal
// Sun et al., Eq. 1-24, with the slips mended: e without its axial part, the spin kept in the sliding velocity, and force
// and friction applied at one point on both bodies so that no angular momentum leaks.
// Here the journal's axis stays parallel to the sleeve's (axes = "parallel"); tilted_journal.hpp has the contacts of one
// that may tilt.
#pragma once

#include <vector>

#include "boresight/play/journal/tilted_journal.hpp"
#include "boresight/play/play_kind.hpp"

namespace boresight {

// Numbers of one journal that a motion does not change. T: those that a sample varies may be lanes or jets.
template <typename T>
struct JournalInSleeveT {
  T radial_clearance{};   // c_r [m]
  T axial_clearance{};    // c_a, per side [m]
  T bore_radius{};        // R_b [m]
  T half_length{};        // L_b / 2 [m]
  bool has_faces = true;  // end faces that limit the axial play (not on a joint that slides)
  NormalLawT<T> radial_law;
  T face_stiffness{};  // K_c [N/m]
  FrictionLawT<T> friction;
  bool tilts = false;  // axes = "free": the contacts are those of `tilted`
  TiltedJournalT<T> tilted;

  static bool serves(const ClearanceDescription& description, JointType type) {
    return type == JointType::revolute || (slides_along_axis(type) && description.guide == GuideShape::round);
  }
  static PlayWords words() { return {"journal", "sleeve"}; }

  // impact_speed: by ContactPlace [m/s]. M: the scalar of the motion, T itself or one that carries derivatives besides.
  // Out: PlayWrench<M>, or PlayLoad<M> where what each contact carries is not asked for.
  template <typename M, typename Friction, typename Out>
  void wrench(const PlayMotion<M>& motion, const ImpactSpeeds<T>& impact_speed, const Friction& traction,
              Out& out) const {
    if (tilts)
      tilted.wrench(motion, impact_speed, traction, out);
    else
      parallel_wrench(motion, impact_speed, traction, out);
  }
  template <typename M, typename Out>
  void wrench(const PlayMotion<M>& motion, const ImpactSpeeds<T>& impact_speed, Out& out) const {
    wrench(motion, impact_speed, SlidingFriction<T>{friction}, out);
  }

  void keep_only(const std::array<bool, kContactPlaces>& touching);
  std::array<T*, kMostContactNumbers> numbers();
  template <typename U>
  void take_shape_of(const JournalInSleeveT<U>& other);
  void complete() { tilted.friction = friction; }

  // Penetration of every place only; used to see where contacts stand without their forces.
  template <typename M>
  void penetrations(const PlayMotion<M>& motion, ContactStates<M>& contact) const {
    if (tilts)
      tilted.penetrations(motion, contact);
    else
      parallel_penetrations(motion, contact);
  }
  template <typename M>
  void parallel_penetrations(const PlayMotion<M>& motion, ContactStates<M>& contact) const;

  // The radial contact of a parallel journal: its normal, and how deep it is.
  template <typename M>
  struct Radial {
    M nx, nz, penetration, rate;
  };
  template <typename M>
  Radial<M> radial_contact(const PlayMotion<M>& m) const {
    // A concentric journal has no normal; length_from_square gives it some.
    const M distance = length_from_square(fused(M(m.e.x()), M(m.e.x()), M(m.e.z() * m.e.z()))),
            inverse = T(1.0) / distance;
    const M nx = m.e.x() * inverse, nz = m.e.z() * inverse;
    return {nx, nz, distance - radial_clearance, fused(M(m.e_dot.x()), nx, M(m.e_dot.z() * nz))};
  }

  // The axial one of the face at side * L_b/2, without its force.
  template <typename M>
  ContactState<M> face_contact(const PlayMotion<M>& m, const T& side) const {
    return {-side * m.e.y() - axial_clearance, -side * m.e_dot.y(), M(0.0)};
  }

  template <typename M, typename Friction, typename Out>
  void parallel_wrench(const PlayMotion<M>& motion, const ImpactSpeeds<T>& impact_speed, const Friction& friction,
                       Out& out) const;
};

struct JournalInSleeve : JournalInSleeveT<double> {
  JournalInSleeve() = default;
  JournalInSleeve(const ClearanceDescription& description, JointType joint, const ClearanceParameters& parameters);

  // The rest is what play_kind.hpp asks of a kind.
  std::vector<ContactPlace> places() const;
  static constexpr std::array kInputs = {MotionInputs::parallel, MotionInputs::tilting};
  MotionInputs inputs() const { return kInputs[tilts ? 1 : 0]; }
  double elastic_energy(const PlayMotion<double>& motion) const;
  JournalInSleeve elastic_only() const;
  ContactTangent tangent(const PlayMotion<double>& motion) const;
  RestingPlay rest_under(const PlayOffsets& load, const JointCoordinates& joint, const RestingPlay& before) const;
  std::vector<GapPart> gap_parts(const RestingPlay& rest, const JointCoordinates& joint) const;
  std::vector<double> clearances() const;
  PlayOffsets widths(double other) const;
  OffsetGroups pushed_together() const { return {{0, 2}, {1}, {3, 4}}; }  // across its axis, along it, in tilt
  double lever() const { return half_length; }
  double size() const { return bore_radius; }
  const NormalLaw& normal_law() const { return radial_law; }
  double axial_stiffness() const { return face_stiffness; }
  PlayOffsets root_stiffness(double load) const;
};

// ---------------------------------------------------------------------------------------------------------------------

// A direction (radial, axial) in which no contact is closed has a clearance that nothing reaches.
template <typename T>
void JournalInSleeveT<T>::keep_only(const std::array<bool, kContactPlaces>& touching) {
  bool radial = false, axial = false;
  for (int k = 0; k < kContactPlaces; ++k)
    if (touching[k]) (is_axial(static_cast<ContactPlace>(k)) ? axial : radial) = true;
  if (!radial) radial_clearance = tilted.radial_clearance = T(kOutOfReach);
  if (!axial) axial_clearance = tilted.axial_clearance = T(kOutOfReach);
}

template <typename T>
std::array<T*, kMostContactNumbers> JournalInSleeveT<T>::numbers() {
  return {&radial_clearance,
          &axial_clearance,
          &bore_radius,
          &half_length,
          &radial_law.stiffness,
          &radial_law.damping_factor,
          &radial_law.length,
          &radial_law.exponent,
          &radial_law.dashpot,
          &face_stiffness,
          &friction.coefficient,
          &friction.static_speed,
          &friction.dynamic_speed,
          &friction.stiction,
          &friction.stribeck_speed,
          &tilted.radial_clearance,
          &tilted.axial_clearance,
          &tilted.bore_radius,
          &tilted.half_length,
          &tilted.ring_radius,
          &tilted.face_stiffness,
          &tilted.end_law.stiffness,
          &tilted.end_law.damping_factor,
          &tilted.end_law.length,
          &tilted.end_law.exponent,
          &tilted.end_law.dashpot};
}

template <typename T>
template <typename U>
void JournalInSleeveT<T>::take_shape_of(const JournalInSleeveT<U>& other) {
  has_faces = other.has_faces;
  tilts = other.tilts;
  tilted.has_faces = other.tilted.has_faces;
  tilted.slides = other.tilted.slides;
  radial_law.curve = other.radial_law.curve;
  tilted.end_law.curve = other.tilted.end_law.curve;
  friction.kind = tilted.friction.kind = other.friction.kind;
}

template <typename T>
template <typename M>
void JournalInSleeveT<T>::parallel_penetrations(const PlayMotion<M>& m, ContactStates<M>& contact) const {
  for (ContactState<M>& c : contact) c = {M(-1.0), M(0.0), M(0.0)};
  const Radial<M> at = radial_contact(m);
  contact[static_cast<int>(ContactPlace::radial)] = {at.penetration, at.rate, M(0.0)};
  if (!has_faces) return;
  contact[static_cast<int>(ContactPlace::axial_minus)] = face_contact(m, T(-1.0));
  contact[static_cast<int>(ContactPlace::axial_plus)] = face_contact(m, T(1.0));
}

template <typename T>
template <typename M, typename Friction, typename Out>
void JournalInSleeveT<T>::parallel_wrench(const PlayMotion<M>& m, const ImpactSpeeds<T>& impact_speed,
                                          const Friction& traction, Out& out) const {
  forget_contacts(out);
  out.force.setConstant(M(0.0));
  out.moment.setConstant(M(0.0));

  const auto [nx, nz, penetration, rate] = radial_contact(m);
  ContactState<M> radial{penetration, rate, M(0.0)};
  if (any(penetration > T(0.0))) {
    radial.normal_force = radial_law.force(penetration, rate, impact_speed[static_cast<int>(ContactPlace::radial)]);
    // Sliding: around the bore along (n_z, 0, -n_x), in which a positive spin about y carries the journal's surface, and
    // along the axis. The contact point lies R_b - |e| from the journal's centre.
    const M arm = bore_radius - radial_clearance - penetration;
    const M around = m.e_dot.x() * nz - m.e_dot.z() * nx + m.w.y() * arm;
    const M along = m.e_dot.y() + (m.w.z() * nx - m.w.x() * nz) * arm;
    const auto [f_around, f_along] =
        traction(static_cast<int>(ContactPlace::radial), radial.normal_force, around, along);
    out.force.x() += -radial.normal_force * nx + f_around * nz;
    out.force.y() += f_along;
    out.force.z() += -radial.normal_force * nz - f_around * nx;
    // Q x F with Q = R_b n.
    out.moment.x() += -bore_radius * nz * f_along;
    out.moment.y() += bore_radius * f_around;
    out.moment.z() += bore_radius * nx * f_along;
  }
  keep_contact(out, ContactPlace::radial, radial);
  if (!has_faces) return;
  for (const auto& [place, side] :
       {std::pair{ContactPlace::axial_minus, -1.0}, std::pair{ContactPlace::axial_plus, 1.0}})
    keep_contact(out, place, face_contact(m, T(side)));
  // Only the face that the journal is nearer to can touch.
  const auto at_minus = m.e.y() > T(0.0);
  const T side = select(at_minus, T(-1.0), T(1.0));
  // Laws that look at it (LuGre's bristles) have no lanes.
  const ContactPlace place = any(at_minus) ? ContactPlace::axial_minus : ContactPlace::axial_plus;
  ContactState<M> face = face_contact(m, side);
  if (!any(face.penetration > T(0.0))) return;
  face.normal_force = face_stiffness * positive_part(face.penetration);
  // At M = (0, side L_b/2, 0): edot + w x (M - e), its part across the axis.
  const T centre = side * half_length;
  const M lever = centre - m.e.y();
  const M vx = m.e_dot.x() - m.w.y() * m.e.z() - m.w.z() * lever;
  const M vz = m.e_dot.z() + m.w.x() * lever + m.w.y() * m.e.x();
  const auto [fx, fz] = traction(static_cast<int>(place), face.normal_force, vx, vz);
  out.force.x() += fx;
  out.force.y() += side * face.normal_force;
  out.force.z() += fz;
  // M x F.
  out.moment.x() += centre * fz;
  out.moment.z() -= centre * fx;
  keep_contact(out, place, face);
}

}  // namespace boresight
