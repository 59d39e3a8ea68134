#include "boresight/contact_events/contact_jacobian.hpp"

#include <ceres/jet.h>

namespace boresight {
namespace {

// column: of each input, among the numbers of the motion; to: among those of out.
template <int inputs>
void differentiate(const JointPlay& law, const PlayMotion<double>& m, const std::array<int, inputs>& column,
                   const std::array<double, kContactPlaces>& impact_speed, MomentAbout about, auto& out,
                   const std::array<int, inputs>& to) {
  using Jet = ceres::Jet<double, inputs>;
  PlayMotion<Jet> motion;
  const auto number = [](auto& of, int k) -> auto& {
    return k < 3    ? of.e[k]
           : k < 6  ? of.e_dot[k - 3]
           : k < 9  ? of.w[k - 6]
           : k < 11 ? of.slope[k - 9]
           : k < 13 ? of.slope_rate[k - 11]
                    : of.roll;
  };
  for (int k = 0; k < kMotionNumbers; ++k) number(motion, k) = Jet(number(m, k));
  for (int i = 0; i < inputs; ++i) number(motion, column[i]).v[i] = 1.0;
  PlayWrench<Jet> wrench;
  law.wrench(motion, impact_speed, wrench);
  Vec3T<Jet> moment = wrench.moment;
  if (about == MomentAbout::insert) moment -= motion.e.cross(wrench.force);
  for (int k = 0; k < 3; ++k)
    for (int i = 0; i < inputs; ++i) {
      out(k, to[i]) = wrench.force[k].v[i];
      out(3 + k, to[i]) = moment[k].v[i];
    }
}

}  // namespace

void contact_jacobian(const JointPlay& law, const PlayMotion<double>& motion,
                      const std::array<double, kContactPlaces>& impact_speed, MomentAbout about, ContactJacobian& out) {
  out.setZero();
  const auto by = [&]<std::size_t inputs>(const std::array<int, inputs>& columns) {
    differentiate<static_cast<int>(inputs)>(law, motion, columns, impact_speed, about, out, columns);
  };
  switch (law.inputs()) {
    case MotionInputs::parallel:
      return by(std::array<int, 7>{0, 1, 2, 3, 4, 5, 7});
    case MotionInputs::turning:
      return by(std::array<int, 9>{0, 1, 2, 3, 4, 5, 6, 7, 8});
    case MotionInputs::tilting:
      return by(std::array<int, 13>{0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12});
    case MotionInputs::rolling:
      return by(std::array<int, kMotionNumbers>{0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13});
  }
}

void offset_jacobian(const JointPlay& law, const PlayMotion<double>& at_rest,
                     const std::array<double, kContactPlaces>& impact_speed, MomentAbout about, OffsetJacobian& out) {
  out.setZero();
  if (law.inputs() == MotionInputs::rolling)
    differentiate<6>(law, at_rest, {0, 1, 2, 9, 10, 13}, impact_speed, about, out, {0, 1, 2, 3, 4, 5});
  else if (law.inputs() == MotionInputs::tilting)
    differentiate<5>(law, at_rest, {0, 1, 2, 9, 10}, impact_speed, about, out, {0, 1, 2, 3, 4});
  else
    differentiate<3>(law, at_rest, {0, 1, 2}, impact_speed, about, out, {0, 1, 2});
}

}  // namespace boresight
