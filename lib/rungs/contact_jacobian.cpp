#include "boresight/rungs/contact_jacobian.hpp"

#include <ceres/jet.h>

namespace boresight {
namespace {

template <typename T>
JournalInSleeveT<T> with_scalar(const JournalInSleeve& d) {
  JournalInSleeveT<T> law;
  law.radial_clearance = T(d.radial_clearance);
  law.axial_clearance = T(d.axial_clearance);
  law.bore_radius = T(d.bore_radius);
  law.half_length = T(d.half_length);
  law.has_faces = d.has_faces;
  law.radial_law = d.radial_law.template cast<T>();
  law.face_stiffness = T(d.face_stiffness);
  law.friction = d.friction.template cast<T>();
  law.tilts = d.tilts;
  const TiltedJournalT<double>& t = d.tilted;
  law.tilted.radial_clearance = T(t.radial_clearance);
  law.tilted.axial_clearance = T(t.axial_clearance);
  law.tilted.bore_radius = T(t.bore_radius);
  law.tilted.half_length = T(t.half_length);
  law.tilted.ring_radius = T(t.ring_radius);
  law.tilted.has_faces = t.has_faces;
  law.tilted.slides = t.slides;
  law.tilted.end_law = t.end_law.template cast<T>();
  law.tilted.face_stiffness = T(t.face_stiffness);
  law.tilted.friction = law.friction;
  return law;
}

// column: of each input, among the numbers of the motion.
template <int inputs>
void differentiate(const JournalInSleeve& law, const JournalMotion<double>& m, const std::array<int, inputs>& column,
                   const std::array<double, kContactPlaces>& impact_speed, MomentAbout about, ContactJacobian& out) {
  using Jet = ceres::Jet<double, inputs>;
  JournalMotion<Jet> motion;
  const auto number = [](auto& of, int k) -> auto& {
    return k < 3    ? of.e[k]
           : k < 6  ? of.e_dot[k - 3]
           : k < 9  ? of.w[k - 6]
           : k < 11 ? of.slope[k - 9]
                    : of.slope_rate[k - 11];
  };
  for (int k = 0; k < kMotionNumbers; ++k) number(motion, k) = Jet(number(m, k));
  for (int i = 0; i < inputs; ++i) number(motion, column[i]).v[i] = 1.0;
  std::array<Jet, kContactPlaces> speed;
  for (int k = 0; k < kContactPlaces; ++k) speed[k] = Jet(impact_speed[k]);
  JournalWrench<Jet> wrench;
  with_scalar<Jet>(law).wrench(motion, speed, wrench);
  Vec3T<Jet> moment = wrench.moment;
  if (about == MomentAbout::journal) moment -= motion.e.cross(wrench.force);
  for (int k = 0; k < 3; ++k)
    for (int i = 0; i < inputs; ++i) {
      out(k, column[i]) = wrench.force[k].v[i];
      out(3 + k, column[i]) = moment[k].v[i];
    }
}

}  // namespace

void contact_jacobian(const JournalInSleeve& law, const JournalMotion<double>& motion,
                      const std::array<double, kContactPlaces>& impact_speed, MomentAbout about, ContactJacobian& out) {
  out.setZero();
  if (law.tilts)
    differentiate<kMotionNumbers>(law, motion, {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12}, impact_speed, about, out);
  else
    differentiate<7>(law, motion, {0, 1, 2, 3, 4, 5, 7}, impact_speed, about, out);
}

}  // namespace boresight
