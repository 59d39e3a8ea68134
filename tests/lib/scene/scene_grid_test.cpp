// The opened mechanism's tables are as fine as the motion asks for: for a crank at a hundred thousand radians per second as over a day.
#include <gtest/gtest.h>

#include "boresight/io/mechanism_file.hpp"
#include "boresight/ladder/ladder.hpp"
#include "boresight/mechanism/interruption.hpp"
#include "boresight/scene/clearance_scene.hpp"

namespace boresight {
namespace scene_grid_test {

std::shared_ptr<const Mechanism> crank_slider(const std::string& law, const std::string& duration) {
  return std::make_shared<const Mechanism>(
      read_mechanism(std::string(BORESIGHT_EXAMPLES) + "/crank-slider/crank-slider.toml",
                     {{"motion.drives.O", law}, {"motion.duration", duration}}));
}

// The boresight body's pose gain in the table against the same computed at that instant, relative to its largest value.
double table_error(const Mechanism& mechanism) {
  const IdealMotion ideal = IdealMotion::kinematic(mechanism);
  const ClearanceScene scene(mechanism, ideal, mechanism.parameters());
  const TimeTable table = scene.pose_gain(mechanism.boresight_body());
  DeviationCoordinates coordinates(mechanism, ideal);
  Eigen::Matrix<double, 6, Eigen::Dynamic, Eigen::RowMajor> row(6, coordinates.count());
  double worst = 0.0, size = 0.0;
  for (int k = 0; k <= 100; ++k) {
    const double t = mechanism.duration() * (k + 0.37) / 101.0;
    MatX T;
    coordinates.gain(t, T);
    const MatX exact = T.middleRows<6>(6 * mechanism.boresight_body());
    table.at(t, row.data());
    worst = std::max(worst, (exact - row).cwiseAbs().maxCoeff());
    size = std::max(size, exact.cwiseAbs().maxCoeff());
  }
  return worst / size;
}

TEST(SceneGrid, FollowsACrankAtAHundredThousandRadiansPerSecond) {
  EXPECT_LT(table_error(*crank_slider("1e5*t", "120 us")), 1e-4);
}

TEST(SceneGrid, OfADayIsNoFinerThanItsMotion) {
  const auto mechanism = crank_slider("2*pi*t/86400", "86400 s");
  const IdealMotion ideal = IdealMotion::kinematic(*mechanism);
  const ClearanceScene scene(*mechanism, ideal, mechanism->parameters());
  EXPECT_LT(scene.knots(), 20000);
  EXPECT_LT(table_error(*mechanism), 1e-4);
}

// A scene serves samples of other masses and gravity too: whichever asked for it first, its grid is the same.
TEST(SceneGrid, IsTheDrawingsWhateverSampleAsksForIt) {
  const Mechanism mechanism(read_mechanism(std::string(BORESIGHT_EXAMPLES) + "/bearing-pairs/gimbal.toml"));
  const IdealMotion ideal = IdealMotion::kinematic(mechanism);
  std::vector<Parameters> samples(2, mechanism.parameters());
  samples[0].gravity *= 1e3;
  for (double& mass : samples[1].body_mass) mass *= 100.0;
  for (const double accuracy : {2e-6, 1e-6, 5e-7, 2.5e-7, 1e-7}) {
    const int knots = ClearanceScene(mechanism, ideal, mechanism.parameters(), accuracy).knots();
    for (const Parameters& sample : samples)
      EXPECT_EQ(ClearanceScene(mechanism, ideal, sample, accuracy).knots(), knots) << accuracy;
  }
}

TEST(SceneGrid, IsGivenUpWhenItsWatchWantsIt) {
  const auto mechanism = crank_slider("2*pi*5*t", "0.4 s");
  const IdealMotion ideal = IdealMotion::kinematic(*mechanism);
  watch_work([](const char*, double) { return false; });
  EXPECT_THROW(ClearanceScene(*mechanism, ideal, mechanism->parameters()), Interrupted);
  watch_work(nullptr);
}

// Where a grid is fine, rows and tables take as long as the scene itself: whoever watches hears of each knot.
TEST(SceneGrid, IsHeardOfKnotByKnotUntilItsTablesAreThere) {
  const auto mechanism = crank_slider("2*pi*5*t", "0.4 s");
  const IdealMotion ideal = IdealMotion::kinematic(*mechanism);
  static long looks;
  static double latest;
  watch_work([](const char*, double share) {
    ++looks;
    latest = share;
    return true;
  });
  looks = 0;
  const ClearanceScene scene(*mechanism, ideal, mechanism->parameters());
  // The first grid's knots; of each finer one those between, and then all of its rows.
  EXPECT_GT(looks, 3 * scene.knots() / 2);
  EXPECT_GT(latest, 0.99);
  for (const auto& table : {+[](const ClearanceScene&of, const Mechanism&m) { of.tables(m.parameters()); },
                            +[](const ClearanceScene&of, const Mechanism&m) { of.pose_gain(m.boresight_body()); }}) {
    looks = 0;
    table(scene, *mechanism);
    EXPECT_GE(looks, scene.knots());
  }
  watch_work(nullptr);
}

TEST(RestingRungs, StopWhereTheirCallerWantsThemTo) {
  const auto mechanism = crank_slider("2*pi*5*t", "0.4 s");
  for (const char* name : {"envelope", "quasistatic"}) {
    RunOptions options;
    options.progress = [](const RunProgress& p) { return p.t < 0.1; };
    const RunResult result = make_rung(name, mechanism)->run(mechanism->parameters(), options);
    EXPECT_TRUE(result.interrupted) << name;
    EXPECT_GT(result.end_time, 0.0) << name;
    EXPECT_LT(result.end_time, 0.4) << name;
  }
}

}  // namespace scene_grid_test
}  // namespace boresight
