#include "boresight/contact_events/contact_jacobian.hpp"

#include <ceres/jet.h>

namespace boresight {
namespace {

// column: of each input, among the numbers of the motion.
template <int inputs>
void differentiate(const JointPlay& law, const PlayMotion<double>& m, const std::array<int, inputs>& column,
                   const std::array<double, kContactPlaces>& impact_speed, MomentAbout about, ContactJacobian& out) {
  using Jet = ceres::Jet<double, inputs>;
  PlayMotion<Jet> motion;
  const auto number = [](auto& of, int k) -> auto& {
    return k < 3    ? of.e[k]
           : k < 6  ? of.e_dot[k - 3]
           : k < 9  ? of.w[k - 6]
           : k < 11 ? of.slope[k - 9]
                    : of.slope_rate[k - 11];
  };
  for (int k = 0; k < kMotionNumbers; ++k) number(motion, k) = Jet(number(m, k));
  for (int i = 0; i < inputs; ++i) number(motion, column[i]).v[i] = 1.0;
  PlayWrench<Jet> wrench;
  law.wrench(motion, impact_speed, wrench);
  Vec3T<Jet> moment = wrench.moment;
  if (about == MomentAbout::insert) moment -= motion.e.cross(wrench.force);
  for (int k = 0; k < 3; ++k)
    for (int i = 0; i < inputs; ++i) {
      out(k, column[i]) = wrench.force[k].v[i];
      out(3 + k, column[i]) = moment[k].v[i];
    }
}

}  // namespace

void contact_jacobian(const JointPlay& law, const PlayMotion<double>& motion,
                      const std::array<double, kContactPlaces>& impact_speed, MomentAbout about, ContactJacobian& out) {
  out.setZero();
  switch (law.inputs()) {
    case MotionInputs::parallel:
      return differentiate<7>(law, motion, {0, 1, 2, 3, 4, 5, 7}, impact_speed, about, out);
    case MotionInputs::turning:
      return differentiate<9>(law, motion, {0, 1, 2, 3, 4, 5, 6, 7, 8}, impact_speed, about, out);
    case MotionInputs::tilting:
      return differentiate<kMotionNumbers>(law, motion, {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12}, impact_speed, about,
                                           out);
  }
}

}  // namespace boresight
