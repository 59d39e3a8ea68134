// Contacts of a journal whose axis may tilt in its sleeve (axes = "free"); the parallel case is in journal_in_sleeve.hpp.
//
// With e the journal's centre, sigma = (a_x, a_z) / a_y the slope of its axis a, L_b the sleeve's length:
//   radial, each end s = +-1    the axis passes the end plane at rho = e_xz + s L_b/2 sigma;  n = rho / |rho|
//                               d = |rho| - c_r, K / 2 at each end, its own memory of impact speed
//   axial, each face s = +-1    the cap's face over the sleeve's end, on the ring of mean radius (R_b + R_s) / 2:
//                               d(alpha) = d0 + A cos(alpha),  d0 = -s e_y - c_a,  A = ring |sigma|
// On a cylindrical joint the journal's centre slides along by e_y, which then is no small number:
// rho = e_xz + (s L_b/2 - e_y) sigma.
// A normal force F acts along the gradient of its penetration, -F d(d)/d(e), -F d(d)/d(sigma), so that elastic contact keeps
// energy exactly. A couple that works on the slope, g . sigma_dot, is the moment a' x (g_x, -g . sigma, g_z) about the
// journal's centre, a' = (sigma_x, 1, sigma_z). Parallel contact gives the paper's force again: both ends share it.
// Friction acts at the bore (radial) and at the centre of pressure (axial) against the sliding velocity there.
// Penetrations are of first order in offset and slope. The next order (the surface normal's own tilt, e_y sigma, the cap's
// height over its tilted edge) lowers the largest error of the default scene with a 120 mm sleeve by 1 %.
// Derived for this program from the geometry; held against the gradient of the energy in a test.
#pragma once

#include "boresight/contact/contact_friction.hpp"
#include "boresight/contact/normal_law.hpp"
#include "boresight/play/journal/ring_contact.hpp"
#include "boresight/play/play_motion.hpp"

namespace boresight {

template <typename T>
struct TiltedJournalT {
  T radial_clearance{}, axial_clearance{};  // c_r, c_a [m]
  T bore_radius{};                          // R_b [m]
  T half_length{};                          // L_b / 2 [m]
  T ring_radius{};                          // (R_b + R_s) / 2 [m]
  bool has_faces = true;
  bool slides = false;    // a cylindrical joint
  NormalLawT<T> end_law;  // of one end: K / 2
  T face_stiffness{};     // K_c [N/m]
  FrictionLawT<T> friction;

  // M: the scalar of the motion, T itself or one that carries derivatives besides.
  template <typename M>
  void penetrations(const PlayMotion<M>& motion, ContactStates<M>& contact) const {
    for (ContactState<M>& c : contact) c = {M(-1.0), M(0.0), M(0.0)};
    for (int side : {-1, 1}) {
      const End<M> at = end(motion, side);
      contact[static_cast<int>(radial_place(side))] = {at.penetration, at.rate, M(0.0)};
      if (!has_faces) continue;
      const Face<M> on = face(motion, side);
      contact[static_cast<int>(axial_place(side))] = {on.depth + on.swing, on.rate, M(0.0)};
    }
  }

  // Out: PlayWrench<M>, or PlayLoad<M>.
  template <typename M, typename Out>
  void wrench(const PlayMotion<M>& m, const ImpactSpeeds<T>& impact_speed, Out& out) const {
    wrench(m, impact_speed, SlidingFriction<T>{friction}, out);
  }
  template <typename M, typename Friction, typename Out>
  void wrench(const PlayMotion<M>& m, const ImpactSpeeds<T>& impact_speed, const Friction& traction, Out& out) const {
    forget_contacts(out);
    out.force.setConstant(M(0.0));
    out.moment.setConstant(M(0.0));
    for (int side : {-1, 1}) {
      const End<M> at = end(m, side);
      const ContactPlace place = radial_place(side);
      keep_contact(out, place, {at.penetration, at.rate, M(0.0)});
      if (!any(at.penetration > T(0.0))) continue;
      const M F = end_law.force(at.penetration, at.rate, impact_speed[static_cast<int>(place)]);
      keep_contact(out, place, {at.penetration, at.rate, F});
      const M tilted = at.nx * m.slope[0] + at.nz * m.slope[1];
      const Vec3T<M> push(-F * at.nx, slides ? M(F * tilted) : M(0.0), -F * at.nz);
      out.force += push;
      out.moment += m.e.cross(push) + moment_of_couple(-F * at.reach * at.nx, -F * at.reach * at.nz, m);
      const Vec3T<M> point(bore_radius * at.nx, M(T(side) * half_length), bore_radius * at.nz);
      const Vec3T<M> v = m.e_dot + m.w.cross(Vec3T<M>(point - m.e));
      const M around = v.x() * at.nz - v.z() * at.nx;
      const auto [f_around, f_along] = traction(static_cast<int>(place), F, around, M(v.y()));
      add(point, Vec3T<M>(f_around * at.nz, f_along, -f_around * at.nx), out);
    }
    if (!has_faces) return;
    for (int side : {-1, 1}) {
      const Face<M> on = face(m, side);
      const ContactPlace place = axial_place(side);
      const M penetration = on.depth + on.swing;
      keep_contact(out, place, {penetration, on.rate, M(0.0)});
      if (!any(penetration > T(0.0))) continue;
      const RingForce<M> ring = ring_contact(face_stiffness, on.depth, on.swing);
      const M F = ring.force;
      keep_contact(out, place, {penetration, on.rate, F});
      const Vec3T<M> push(M(0.0), T(side) * F, M(0.0));
      const M swing = ring_radius * ring.moment_arm;
      out.force += push;
      out.moment += m.e.cross(push) + moment_of_couple(-F * swing * on.ux, -F * swing * on.uz, m);
      const Vec3T<M> point(T(side) * swing * on.ux, M(T(side) * half_length), T(side) * swing * on.uz);
      const Vec3T<M> v = m.e_dot + m.w.cross(Vec3T<M>(point - m.e));
      const auto [fx, fz] = traction(static_cast<int>(place), F, M(v.x()), M(v.z()));
      add(point, Vec3T<M>(fx, M(0.0), fz), out);
    }
  }

  T elastic_energy(const PlayMotion<T>& m) const {
    T energy(0.0);
    for (int side : {-1, 1}) {
      const T d = end(m, side).penetration;
      if (any(d > T(0.0))) energy += select(d > T(0.0), end_law.elastic_energy(select(d > T(0.0), d, T(1.0))), T(0.0));
      if (!has_faces) continue;
      const Face<T> on = face(m, side);
      energy += ring_contact(face_stiffness, on.depth, on.swing).energy;
    }
    return energy;
  }

  static ContactPlace radial_place(int side) {
    return side < 0 ? ContactPlace::radial_minus : ContactPlace::radial_plus;
  }
  static ContactPlace axial_place(int side) { return side < 0 ? ContactPlace::axial_minus : ContactPlace::axial_plus; }

 private:
  template <typename M>
  struct End {
    M reach, nx, nz, penetration, rate;
  };
  template <typename M>
  struct Face {
    M depth, swing, rate, ux, uz;  // d0, A, rate of d0 + A, sigma / |sigma|
  };

  template <typename M>
  End<M> end(const PlayMotion<M>& m, int side) const {
    End<M> at;
    at.reach = slides ? M(T(side) * half_length - m.e.y()) : M(T(side) * half_length);
    const M x = m.e.x() + at.reach * m.slope[0], z = m.e.z() + at.reach * m.slope[1];
    const M distance = length_from_square(M(x * x + z * z));
    at.nx = x / distance;
    at.nz = z / distance;
    at.penetration = distance - radial_clearance;
    M x_rate = m.e_dot.x() + at.reach * m.slope_rate[0], z_rate = m.e_dot.z() + at.reach * m.slope_rate[1];
    if (slides) {
      x_rate -= m.e_dot.y() * m.slope[0];
      z_rate -= m.e_dot.y() * m.slope[1];
    }
    at.rate = at.nx * x_rate + at.nz * z_rate;
    return at;
  }

  template <typename M>
  Face<M> face(const PlayMotion<M>& m, int side) const {
    Face<M> on;
    const M tilt = length_from_square(M(m.slope[0] * m.slope[0] + m.slope[1] * m.slope[1]));
    on.ux = m.slope[0] / tilt;
    on.uz = m.slope[1] / tilt;
    on.depth = T(-side) * m.e.y() - axial_clearance;
    on.swing = ring_radius * tilt;
    on.rate = T(-side) * m.e_dot.y() + ring_radius * (on.ux * m.slope_rate[0] + on.uz * m.slope_rate[1]);
    return on;
  }

  template <typename M>
  static void add(const Vec3T<M>& point, const Vec3T<M>& force, PlayLoad<M>& out) {
    out.force += force;
    out.moment += point.cross(force);
  }
};
using TiltedJournal = TiltedJournalT<double>;

}  // namespace boresight
