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

#include "boresight/contact/journal_motion.hpp"
#include "boresight/contact/contact_friction.hpp"
#include "boresight/contact/normal_law.hpp"
#include "boresight/contact/ring_contact.hpp"

namespace boresight {

template <typename T>
struct TiltedJournalT {
  T radial_clearance{}, axial_clearance{};  // c_r, c_a [m]
  T bore_radius{};                              // R_b [m]
  T half_length{};                              // L_b / 2 [m]
  T ring_radius{};                              // (R_b + R_s) / 2 [m]
  bool has_faces = true;
  bool slides = false;          // a cylindrical joint
  NormalLawT<T> end_law;            // of one end: K / 2
  T face_stiffness{};  // K_c [N/m]
  FrictionLawT<T> friction;

  void gaps(const JournalMotion<T>& motion, std::array<ContactState<T>, kContactPlaces>& contact) const {
    for (ContactState<T>& c : contact) c = {T(-1.0), T(0.0), T(0.0)};
    for (int side : {-1, 1}) {
      const End at = end(motion, side);
      contact[radial_place(side)] = {at.penetration, at.rate, T(0.0)};
      if (!has_faces) continue;
      const Face on = face(motion, side);
      contact[axial_place(side)] = {on.depth + on.swing, on.rate, T(0.0)};
    }
  }

  void wrench(const JournalMotion<T>& m, const std::array<T, kContactPlaces>& impact_speed, JournalWrench<T>& out) const {
    wrench(m, impact_speed, SlidingFriction<T>{friction}, out);
  }
  template <typename Friction>
  void wrench(const JournalMotion<T>& m, const std::array<T, kContactPlaces>& impact_speed, const Friction& traction,
              JournalWrench<T>& out) const {
    for (ContactState<T>& c : out.contact) c = {T(-1.0), T(0.0), T(0.0)};
    out.force.setConstant(T(0.0));
    out.moment.setConstant(T(0.0));
    for (int side : {-1, 1}) {
      const End at = end(m, side);
      ContactState<T>& contact = out.contact[radial_place(side)];
      contact = {at.penetration, at.rate, T(0.0)};
      if (!any(at.penetration > T(0.0))) continue;
      const T F = end_law.force(at.penetration, at.rate, impact_speed[radial_place(side)]);
      contact.normal_force = F;
      const T tilted = at.nx * m.slope[0] + at.nz * m.slope[1];
      const Vec3T<T> push(-F * at.nx, slides ? T(F * tilted) : T(0.0), -F * at.nz);
      out.force += push;
      out.moment += m.e.cross(push) + moment_of(-F * at.reach * at.nx, -F * at.reach * at.nz, m);
      const Vec3T<T> point(bore_radius * at.nx, T(side) * half_length, bore_radius * at.nz);
      const Vec3T<T> v = m.e_dot + m.w.cross(Vec3T<T>(point - m.e));
      const T around = v.x() * at.nz - v.z() * at.nx;
      const auto [f_around, f_along] = traction(radial_place(side), F, around, T(v.y()));
      add(point, Vec3T<T>(f_around * at.nz, f_along, -f_around * at.nx), out);
    }
    if (!has_faces) return;
    for (int side : {-1, 1}) {
      const Face on = face(m, side);
      ContactState<T>& contact = out.contact[axial_place(side)];
      contact = {on.depth + on.swing, on.rate, T(0.0)};
      if (!any(contact.penetration > T(0.0))) continue;
      const RingForce<T> ring = ring_contact(face_stiffness, on.depth, on.swing);
      const T F = ring.force;
      contact.normal_force = F;
      const Vec3T<T> push(T(0.0), T(side) * F, T(0.0));
      const T swing = ring_radius * ring.moment_arm;
      out.force += push;
      out.moment += m.e.cross(push) + moment_of(-F * swing * on.ux, -F * swing * on.uz, m);
      const Vec3T<T> point(T(side) * swing * on.ux, T(side) * half_length, T(side) * swing * on.uz);
      const Vec3T<T> v = m.e_dot + m.w.cross(Vec3T<T>(point - m.e));
      const auto [fx, fz] = traction(axial_place(side), F, T(v.x()), T(v.z()));
      add(point, Vec3T<T>(fx, T(0.0), fz), out);
    }
  }

  T elastic_energy(const JournalMotion<T>& m) const {
    T energy(0.0);
    for (int side : {-1, 1}) {
      const T d = end(m, side).penetration;
      if (any(d > T(0.0))) energy += select(d > T(0.0), end_law.elastic_energy(select(d > T(0.0), d, T(1.0))), T(0.0));
      if (!has_faces) continue;
      const Face on = face(m, side);
      energy += ring_contact(face_stiffness, on.depth, on.swing).energy;
    }
    return energy;
  }

  static int radial_place(int side) { return static_cast<int>(side < 0 ? ContactPlace::radial_minus : ContactPlace::radial_plus); }
  static int axial_place(int side) { return static_cast<int>(side < 0 ? ContactPlace::axial_minus : ContactPlace::axial_plus); }

  // Of the couple (gx, gz) on the slopes, about the journal's centre.
  static Vec3T<T> moment_of(const T& gx, const T& gz, const JournalMotion<T>& m) {
    const Vec3T<T> along(m.slope[0], T(1.0), m.slope[1]);
    return along.cross(Vec3T<T>(gx, -gx * m.slope[0] - gz * m.slope[1], gz));
  }

 private:
  struct End {
    T reach, nx, nz, penetration, rate;
  };
  struct Face {
    T depth, swing, rate, ux, uz;  // d0, A, rate of d0 + A, sigma / |sigma|
  };

  End end(const JournalMotion<T>& m, int side) const {
    using std::sqrt;
    End at;
    at.reach = slides ? T(T(side) * half_length - m.e.y()) : T(T(side) * half_length);
    const T x = m.e.x() + at.reach * m.slope[0], z = m.e.z() + at.reach * m.slope[1];
    const T square = x * x + z * z;
    // A concentric journal has no normal; it is far from the bore, so any divisor does.
    const T distance = sqrt(select(square > T(0.0), square, T(1e-60)));
    at.nx = x / distance;
    at.nz = z / distance;
    at.penetration = distance - radial_clearance;
    T x_rate = m.e_dot.x() + at.reach * m.slope_rate[0], z_rate = m.e_dot.z() + at.reach * m.slope_rate[1];
    if (slides) {
      x_rate -= m.e_dot.y() * m.slope[0];
      z_rate -= m.e_dot.y() * m.slope[1];
    }
    at.rate = at.nx * x_rate + at.nz * z_rate;
    return at;
  }

  Face face(const JournalMotion<T>& m, int side) const {
    using std::sqrt;
    Face on;
    const T square = m.slope[0] * m.slope[0] + m.slope[1] * m.slope[1];
    const T tilt = sqrt(select(square > T(0.0), square, T(1e-60)));
    on.ux = m.slope[0] / tilt;
    on.uz = m.slope[1] / tilt;
    on.depth = T(-side) * m.e.y() - axial_clearance;
    on.swing = ring_radius * tilt;
    on.rate = T(-side) * m.e_dot.y() + ring_radius * (on.ux * m.slope_rate[0] + on.uz * m.slope_rate[1]);
    return on;
  }

  static void add(const Vec3T<T>& point, const Vec3T<T>& force, JournalWrench<T>& out) {
    out.force += force;
    out.moment += point.cross(force);
  }
};
using TiltedJournal = TiltedJournalT<double>;

}  // namespace boresight
