// The parts of standing errors in a motion: what is left beside them, and which have none.
#include "boresight_analyses/study/error_parts.hpp"

#include <gmock/gmock.h>

#include <cmath>

#include "bearing_pair_scenes.hpp"
#include "boresight/ladder/ladder.hpp"
#include "error_scenes.hpp"
#include "scenes.hpp"

namespace boresight {
namespace error_parts_test {

using Kind = ErrorDescription::Kind;

MechanismDescription drawn(bool play) {
  MechanismDescription m = scenes::rrcpr();
  if (!play) m.clearances.clear();
  m.errors = {scenes::drive_error(m, "A3", "1"), scenes::drive_error(m, "P2", "1"),
              scenes::frame_error(m, Kind::translation, "F1", "platform", Vec3::UnitX()),
              scenes::frame_error(m, Kind::translation, "F1", "rod1", Vec3::UnitZ())};
  m.errors[0].name = "A3.zero";
  m.errors[1].name = "P2.zero";
  return m;
}

struct Followed {
  RunResult run;
  ErrorParts parts;
};
Followed follow(const MechanismDescription& m, const std::string& rung, const std::vector<double>& errors) {
  const auto mechanism = std::make_shared<const Mechanism>(m);
  Parameters sample = mechanism->parameters();
  sample.error = errors;
  Followed out;
  out.run = make_rung(rung, mechanism)->run(sample, {});
  out.parts = parts_of_errors(*mechanism, sample, out.run);
  return out;
}

// Design page "Every source of pointing error", section 1; to first order these are off by what they are beside the size of the mechanism.
TEST(ErrorParts, AreThoseThatAnIndependentProgramPrintsForEachErrorAlone) {
  const Followed found = follow(drawn(false), "perturbation", {1e-4, 20e-6, 0.0, 0.0});
  ASSERT_EQ(found.parts.parts.size(), 2u);
  const PointingIndices &a = found.parts.parts[0].index, &p = found.parts.parts[1].index;
  EXPECT_EQ(found.parts.parts[0].name, "error.A3.zero");
  EXPECT_NEAR(a.position_error.max, 7.718742e-5, 1e-4 * 7.718742e-5);
  EXPECT_NEAR(a.position_error.rms, 7.079130e-5, 1e-4 * 7.079130e-5);
  EXPECT_NEAR(a.orientation_error.max, 1.041764e-4, 1e-4 * 1.041764e-4);
  EXPECT_NEAR(p.position_error.max, 3.881242e-5, 1e-4 * 3.881242e-5);
  EXPECT_NEAR(p.position_error.rms, 3.754843e-5, 1e-4 * 3.754843e-5);
  EXPECT_LT(p.orientation_error.max, 1e-12);
}

TEST(ErrorParts, AreTheWholeErrorOfALinearRungWithoutPlay) {
  const Followed found = follow(drawn(false), "perturbation", {1e-4, 20e-6, 5e-5, 0.0});
  EXPECT_LT(found.parts.rest.index.position_error.max, 1e-6 * found.run.index.position_error.max);
  EXPECT_LT(found.parts.rest.index.boresight_error.max, 1e-6 * found.run.index.boresight_error.max);
  double position = 0.0, boresight = 0.0;
  for (const ErrorPart& part : found.parts.parts) {
    position += part.position_share;
    boresight += part.boresight_share;
  }
  EXPECT_NEAR(position, 1.0, 1e-6);
  EXPECT_NEAR(boresight, 1.0, 1e-6);
}

// Half the errors, a quarter of what is left: it is of second order, and nothing of first order is missing.
TEST(ErrorParts, LeaveOfAnExactMotionWhatIsOfSecondOrder) {
  const std::vector<double> errors = {1e-3, 2e-4, 5e-4, 0.0};
  std::vector<double> half = errors;
  for (double& e : half) e *= 0.5;
  const double whole = follow(drawn(false), "multibody", errors).parts.rest.index.position_error.max;
  EXPECT_GT(whole, 1e-8);
  EXPECT_NEAR(follow(drawn(false), "multibody", half).parts.rest.index.position_error.max / whole, 0.25, 0.02);
}

TEST(ErrorParts, AddUpWithPlayToAllOfTheMotion) {
  const Followed found = follow(drawn(true), "quasistatic", {1e-4, 20e-6, 5e-5, 0.0});
  double sum = found.parts.rest.position_share;
  EXPECT_GT(std::abs(sum), 0.1);
  for (const ErrorPart& part : found.parts.parts) sum += part.position_share;
  EXPECT_NEAR(sum, 1.0, 1e-9);
  const double play = follow(drawn(true), "quasistatic", {0.0, 0.0, 0.0, 0.0}).run.index.position_error.max;
  EXPECT_NEAR(found.parts.rest.index.position_error.max, play, 0.01 * play);
}

// A seat of the second of two bearings, built aside within their play: where the shaft rests then says what that does, and no column does.
TEST(ErrorParts, OfAnErrorThatPlayTakesUpAreNotSaidToBeNothing) {
  MechanismDescription m = scenes::gimbal({"E1", "E2"}, JournalAxes::free);
  m.errors = {scenes::frame_error(m, Kind::translation, "E2", "yoke", Vec3::UnitZ()),
              scenes::drive_error(m, "A1", "1")};
  m.errors[0].name = "seat";
  m.errors[1].name = "zero";
  m.motion.duration = 0.05;
  const Followed without = follow(m, "quasistatic", {0.0, 1e-4}), with = follow(m, "quasistatic", {5e-5, 1e-4});
  ASSERT_GT(std::abs(with.run.index.boresight_error.max - without.run.index.boresight_error.max), 1e-5);
  ASSERT_EQ(with.parts.parts.size(), 1u);
  EXPECT_EQ(with.parts.parts[0].name, "error.zero");
  ASSERT_EQ(with.parts.without_part.size(), 1u);
  EXPECT_THAT(with.parts.without_part[0], testing::HasSubstr("error.seat is taken up by play"));
  EXPECT_THAT(with.parts.without_part[0], testing::HasSubstr("--set error.seat=0m tell"));
  EXPECT_TRUE(without.parts.without_part.empty());
}

TEST(ErrorParts, OfErrorsWithoutValueAreNotThere) {
  const Followed found = follow(drawn(true), "quasistatic", {0.0, 0.0, 0.0, 0.0});
  EXPECT_TRUE(found.parts.parts.empty());
  EXPECT_TRUE(found.parts.rest.poses.empty());
}

// What error_vector() makes of a small finite displacement, in all four quantities.
TEST(ErrorParts, AreCountedAlongTheAxesOfTheErrorVector) {
  Pointing pointing;
  pointing.boresight_B = Vec3(0.6, 0.0, 0.8);
  const Pose ideal{Vec3(0.1, 0.2, 0.5), Quat(Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()))};
  Vec6 x;
  x << 3e-4, -2e-4, 1e-4, 2e-4, 1e-4, -3e-4;
  Pose truth = ideal;
  truth.p += x.head<3>();
  const Vec3 turn = x.tail<3>();
  truth.q = Quat(Eigen::AngleAxisd(turn.norm(), turn.normalized())) * ideal.q;
  for (const PointingQuantity quantity :
       {PointingQuantity::position_error, PointingQuantity::orientation_error, PointingQuantity::boresight_error}) {
    const Vec3 exact = error_vector(quantity, truth, ideal, pointing);
    EXPECT_LT((linear_error_vector(quantity, x, ideal, pointing, 0.5) - exact).norm(), 1e-3 * exact.norm());
  }
}

}  // namespace error_parts_test
}  // namespace boresight
