// What the linear deviation leaves out is a share: of what, and that it does not hang on how large a mechanism is drawn.
#include "boresight/perturbation/second_order.hpp"

#include <gtest/gtest.h>

#include "bearing_pair_scenes.hpp"
#include "boresight/formulations/ideal_simulation.hpp"
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

// Deviations are looked at where they are large. What is missed there is missed all along where it hardly changes: of a motion that is mostly
// half as far off it is twice the share.
TEST(SecondOrderShare, CountsAgainstTheMotionsOwnMeansWhereTheseAreLess) {
  MechanismDescription m = scenes::gimbal({"A1", "A2", "E1", "E2"}, JournalAxes::free);
  m.journals = JournalStart::centred;
  const auto mechanism = scenes::build(std::move(m));
  const Parameters& parameters = mechanism->parameters();
  const PreparedScene prepared(*mechanism, ideal_motion(*mechanism, parameters), parameters);
  const int n = prepared.scene().layout().n, body = mechanism->boresight_body();
  LargestDeviations largest(mechanism->duration());
  const VecX z = VecX::LinSpaced(n, 2e-5, 5e-5);
  largest.add(0.5 * mechanism->duration(), 1.0, z, VecX::Zero(n));
  std::vector<double> gain(static_cast<std::size_t>(6 * n));
  prepared.pose_gain(body).at(0.5 * mechanism->duration(), gain.data());
  const Vec6 x = Eigen::Map<const Eigen::Matrix<double, 6, Eigen::Dynamic, Eigen::RowMajor>>(gain.data(), 6, n) * z;

  const auto position = [&](double rms, double mean, double start = 0.0) {
    PointingIndices index;
    index.position_error = {
        .max = x.head<3>().norm(), .rms = rms * x.head<3>().norm(), .mean = mean * x.head<3>().norm()};
    return second_order(*mechanism, prepared, parameters, largest, index, start, false).pose[0];
  };
  const double alone = position(1.0, 1.0);
  ASSERT_GT(alone, 1e-6);
  ASSERT_LT(alone, 0.1);
  EXPECT_NEAR(position(0.5, 1.0) / alone, 2.0, 1e-5);  // closing the joints moves z a little
  EXPECT_NEAR(position(0.5, 0.25) / alone, 4.0, 1e-5);
  // Errors besides the play's make the index larger, and not what is missed smaller.
  EXPECT_EQ(position(3.0, 2.0), alone);
  // What is missed before the indices begin to count is none of theirs.
  largest.add(0.1 * mechanism->duration(), 2.0, 3.0 * z, VecX::Zero(n));
  EXPECT_GT(position(3.0, 2.0), 2.0 * alone);
  EXPECT_EQ(position(3.0, 2.0, 0.3 * mechanism->duration()), alone);
}

}  // namespace second_order_test
}  // namespace boresight
