// How a journal moves in its sleeve, from how their bodies move.
#include "boresight/formulations/force_elements.hpp"

#include <gtest/gtest.h>

#include "../scenes.hpp"

namespace boresight {
namespace force_elements_test {

// Everything about its motion that is a rate is one of what it is a rate of, however far the journal is tilted.
TEST(ForceElements, HaveRatesOfAJournalThatAreTheSlopesOfItsPlace) {
  MechanismDescription d = scenes::rrcpr();
  d.clearances[0].axes = JournalAxes::free;
  const auto mechanism = scenes::build(std::move(d));
  const ForceElements elements(*mechanism, mechanism->parameters(), true);
  std::vector<BodyMotion> bodies(static_cast<std::size_t>(mechanism->bodies()));
  for (std::size_t k = 0; k < bodies.size(); ++k) {
    const double s = 1.0 + static_cast<double>(k);
    bodies[k].p = Vec3(0.1 * s, -0.2, 0.3 / s);
    bodies[k].R = Eigen::AngleAxisd(0.3 / s, Vec3(1.0, 2.0 * s, -0.5).normalized()).toRotationMatrix();
    bodies[k].v = Vec3(0.4, -0.3 * s, 0.7);
    bodies[k].w = Vec3(0.9 / s, 0.5, -0.6 * s);
  }
  const auto after = [&](double h) {
    std::vector<BodyMotion> moved = bodies;
    for (BodyMotion& body : moved) {
      body.p += h * body.v;
      body.R = (Eigen::AngleAxisd(h * body.w.norm(), body.w.normalized()).toRotationMatrix() * body.R).eval();
    }
    return elements.play_motion(0, moved);
  };
  constexpr double kStep = 1e-5;
  const PlayMotion<double> here = elements.play_motion(0, bodies), next = after(kStep), last = after(-kStep);
  ASSERT_GT(here.slope.norm(), 0.1) << "next to no tilt would not tell the slopes apart";
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(here.e_dot[k], (next.e[k] - last.e[k]) / (2.0 * kStep), 1e-7) << k;
  for (int k = 0; k < 2; ++k) {
    EXPECT_GT(std::abs(here.slope_rate[k]), 0.01);
    EXPECT_NEAR(here.slope_rate[k], (next.slope[k] - last.slope[k]) / (2.0 * kStep), 1e-7) << k;
  }
}

}  // namespace force_elements_test
}  // namespace boresight
