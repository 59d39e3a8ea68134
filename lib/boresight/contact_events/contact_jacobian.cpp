#include "boresight/contact_events/contact_jacobian.hpp"

#include <ceres/jet.h>

#include <algorithm>
#include <array>
#include <variant>

namespace boresight {
namespace {

// Whether a kind of play ever hangs on just these: others need not be compiled for as many derivatives.
template <typename Kind, MotionInputs which>
constexpr bool may_hang_on = std::find(Kind::kInputs.begin(), Kind::kInputs.end(), which) != Kind::kInputs.end();

// column: of each input, among the numbers of the motion; to: among those of out. which: law.inputs().
template <MotionInputs which, int inputs>
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
           : k < 14 ? of.roll
                    : of.twist[k - 14];
  };
  for (int k = 0; k < kMotionNumbers; ++k) number(motion, k) = Jet(number(m, k));
  for (int i = 0; i < inputs; ++i) number(motion, column[i]).v[i] = 1.0;
  PlayWrench<Jet> wrench;
  std::visit(
      [&]<typename Kind>(const Kind& kind) {
        if constexpr (may_hang_on<Kind, which>)
          kind.wrench(motion, impact_speed, SlidingFriction<double>{kind.friction}, wrench);
      },
      law.kind);
  Vec3T<Jet> moment = wrench.moment;
  if (about != MomentAbout::seat) moment -= motion.e.cross(wrench.force);
  if (about == MomentAbout::insert_as_couples) moment = couples_of(moment, motion);
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
  const auto by = [&]<MotionInputs which, std::size_t inputs>(const std::array<int, inputs>& columns) {
    differentiate<which, static_cast<int>(inputs)>(law, motion, columns, impact_speed, about, out, columns);
  };
  using enum MotionInputs;
  switch (law.inputs()) {
    case parallel:
      return by.operator()<parallel>(std::array<int, 7>{0, 1, 2, 3, 4, 5, 7});
    case turning:
      return by.operator()<turning>(std::array<int, 9>{0, 1, 2, 3, 4, 5, 6, 7, 8});
    case tilting:
      return by.operator()<tilting>(std::array<int, 13>{0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12});
    case rolling:
      return by.operator()<rolling>(std::array<int, 14>{0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13});
    case twisting:
      return by.operator()<twisting>(std::array<int, 15>{0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 14, 15});
  }
}

void offset_jacobian(const JointPlay& law, const PlayMotion<double>& at_rest,
                     const std::array<double, kContactPlaces>& impact_speed, OffsetJacobian& out) {
  out.setZero();
  const auto by = [&]<MotionInputs which, std::size_t inputs>(const std::array<int, inputs>& columns,
                                                              const std::array<int, inputs>& to) {
    differentiate<which, static_cast<int>(inputs)>(law, at_rest, columns, impact_speed, MomentAbout::insert_as_couples,
                                                   out, to);
  };
  constexpr std::array<int, 3> kOffsets = {0, 1, 2};
  using enum MotionInputs;
  switch (law.inputs()) {
    case parallel:
      return by.operator()<parallel>(kOffsets, kOffsets);
    case turning:
      return by.operator()<turning>(kOffsets, kOffsets);
    case tilting:
      return by.operator()<tilting>(std::array<int, 5>{0, 1, 2, 9, 10}, std::array<int, 5>{0, 1, 2, 3, 4});
    case rolling:
      return by.operator()<rolling>(std::array<int, 6>{0, 1, 2, 9, 10, 13}, std::array<int, 6>{0, 1, 2, 3, 4, 5});
    case twisting:
      return by.operator()<twisting>(std::array<int, 5>{0, 1, 2, 9, 10}, std::array<int, 5>{0, 1, 2, 3, 4});
  }
}

}  // namespace boresight
