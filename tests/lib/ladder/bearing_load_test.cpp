// The load on a bearing: one contact's force where nothing else acts there, and with its friction the resultant of both.
#include <gtest/gtest.h>

#include <cmath>

#include "boresight/ladder/ladder.hpp"
#include "scenes.hpp"

namespace boresight {
namespace bearing_load_test {

TEST(BearingLoad, IsTheForceOfItsOneContactAndWithFrictionAtMostTheConesResultant) {
  constexpr double kFriction = 0.2;
  for (const char* rung : {"perturbation", "multibody"})
    for (const double friction : {0.0, kFriction}) {
      const auto mechanism =
          scenes::build(scenes::rrcpr({{"motion.duration", "20 ms"},
                                       {"clearance.F1.axial", "5 mm"},
                                       {"clearance.F1.friction.coefficient", friction > 0.0 ? "0.2" : "0"}}));
      const RunResult result = make_rung(rung, mechanism)->run(mechanism->parameters(), {});
      const ContactSummary& c = result.contact[0];
      for (const ContactEvent& e : result.events) ASSERT_EQ(e.place, ContactPlace::radial) << rung;
      ASSERT_GT(c.max_force, 100.0) << rung;
      if (friction == 0.0) {
        EXPECT_NEAR(c.max_load / c.max_force, 1.0, 1e-12) << rung;
      } else {
        EXPECT_GT(c.max_load, c.max_force * (1.0 + 1e-6)) << rung;
        EXPECT_LE(c.max_load, c.max_force * std::hypot(1.0, friction) * (1.0 + 1e-12)) << rung;
      }
    }
}

}  // namespace bearing_load_test
}  // namespace boresight
