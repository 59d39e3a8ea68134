// What the linear deviation leaves out is a share: it does not hang on how large a mechanism is drawn.
#include <gtest/gtest.h>

#include "bearing_pair_scenes.hpp"
#include "boresight/ladder/ladder.hpp"

namespace boresight {
namespace second_order_test {

// Journals that tilt in flight, so that all motions are the same ones on any scale, gravity being scaled with the lengths. (Those whose
// axes stay parallel leave next to nothing out there.)
TEST(SecondOrderShare, IsTheSameOnEveryScaleOfADrawing) {
  const auto share = [](double scale) {
    MechanismDescription m = scenes::gimbal({"A1", "A2", "E1", "E2"}, JournalAxes::free);
    m.journals = JournalStart::centred;
    m.motion.duration = 2e-3;
    RunOptions options;
    options.step = 2e-5;
    const auto mechanism = scenes::build(scenes::drawn_elsewhere(m, Mat3::Identity(), Vec3::Zero(), scale));
    const RunResult result = make_rung("perturbation", mechanism)->run(mechanism->parameters(), options);
    for (const ContactSummary& c : result.contact) EXPECT_EQ(c.contact_fraction, 0.0);
    return result.error.largest_model();
  };
  const double plain = share(1.0);
  EXPECT_GT(plain, 1e-5);
  EXPECT_LT(plain, 1.0);
  for (const double scale : {0.05, 0.4, 20.0}) EXPECT_NEAR(share(scale) / plain, 1.0, 1e-6) << scale;
}

}  // namespace second_order_test
}  // namespace boresight
