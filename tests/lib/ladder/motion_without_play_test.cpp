// Motions whose play cannot move: at how many instants they are looked at, and where their histories have samples.
#include <gtest/gtest.h>

#include <cmath>

#include "boresight/ladder/ladder.hpp"
#include "error_scenes.hpp"

namespace boresight {
namespace motion_without_play_test {

std::shared_ptr<const Mechanism> altaz(const std::vector<Setting>& settings, const std::string& ripple = "") {
  MechanismDescription m =
      read_mechanism(std::string(BORESIGHT_EXAMPLES) + "/altaz-gimbal/altaz-gimbal.toml", settings);
  if (!ripple.empty()) {
    m.errors.push_back(scenes::drive_error(m, "elevation", ripple));
    m.errors.back().value = 50e-6;
  }
  return scenes::build(m);
}

std::shared_ptr<const Mechanism> rrcpr_without_play() {
  MechanismDescription m = scenes::rrcpr();
  m.clearances.clear();
  m.errors.push_back(scenes::drive_error(m, "A1", "1"));
  m.errors.back().value = 1e-4;
  m.errors.push_back(scenes::drive_error(m, "P2", "q"));
  m.errors.back().value = 1e-4;
  return scenes::build(m);
}

RunResult of_indices(const Mechanism& mechanism, const Rung& rung) {
  RunOptions options;
  options.sample_spacing = 0.0;
  return rung.run(mechanism.parameters(), options);
}

void expect_within(const Statistics& found, const Statistics& fine, double share) {
  EXPECT_NEAR(found.max, fine.max, share * fine.max);
  EXPECT_NEAR(found.rms, fine.rms, share * fine.max);
  EXPECT_NEAR(found.mean, fine.mean, share * fine.max);
  EXPECT_NEAR(found.p9973, fine.p9973, share * fine.max);
}

// The finer run is one with a history: that follows a motion which is fitted in a table of its own, or integrated, and not joints closed
// one instant after the other.
TEST(MotionWithoutPlay, HasTheIndicesOfATenTimesFinerRun) {
  const std::pair<const char*, std::shared_ptr<const Mechanism>> scene[] = {
      {"a scan", altaz({})},
      {"a long raster", altaz({{"motion.duration", "40 s"}})},
      {"a ripple a hundred times as fast as the motion", altaz({}, "sin(400*q)")},
      {"a parallel mechanism", rrcpr_without_play()}};
  for (const auto& [name, mechanism] : scene) {
    SCOPED_TRACE(name);
    const auto rung = make_rung("multibody", mechanism);
    const RunResult found = of_indices(*mechanism, *rung);
    RunOptions fine;
    fine.sample_spacing = mechanism->duration() / (10.0 * static_cast<double>(found.cost.steps));
    fine.events = false;
    const RunResult finer = rung->run(mechanism->parameters(), fine);
    ASSERT_GE(finer.cost.steps, 9 * found.cost.steps);
    expect_within(found.index.boresight_error, finer.index.boresight_error, 1e-4);
    expect_within(found.index.position_error, finer.index.position_error, 1e-4);
    expect_within(found.index.orientation_error, finer.index.orientation_error, 1e-4);
  }
}

TEST(MotionWithoutPlay, IsLookedAtMoreOftenWhereItRipplesAndNotWhereItDoesNot) {
  const auto instants = [](const std::shared_ptr<const Mechanism>& mechanism) {
    return of_indices(*mechanism, *make_rung("multibody", mechanism)).cost.steps;
  };
  const long scan = instants(altaz({}));
  EXPECT_LE(scan, 5000);
  EXPECT_GT(instants(altaz({}, "sin(400*q)")), 2 * scan);
  // Four times as long a motion, four times as many; not one in every 0.1 ms.
  EXPECT_LE(instants(altaz({{"motion.duration", "40 s"}})), 5 * scan);
}

TEST(MotionWithoutPlay, HasItsSamplesWhereTheyWereAskedFor) {
  const auto mechanism = altaz({{"motion.duration", "1.0005 s"}});
  for (const char* name : {"multibody", "quasistatic", "perturbation"}) {
    SCOPED_TRACE(name);
    for (const double spacing : {1e-4, 1e-3, 0.07}) {
      RunOptions options;
      options.sample_spacing = spacing;
      const RunResult result = make_rung(name, mechanism)->run(mechanism->parameters(), options);
      const auto rows = static_cast<std::size_t>(std::floor(1.0005 / spacing + 1e-9)) + 1;
      ASSERT_EQ(result.time.size(), rows) << spacing;
      for (std::size_t k = 0; k < rows; ++k)
        ASSERT_NEAR(result.time[k], spacing * static_cast<double>(k), 1e-6 * spacing) << spacing;
    }
  }
}

TEST(MotionWithoutPlay, EndsWhereItIsInterrupted) {
  const auto mechanism = altaz({});
  for (const char* name : {"multibody", "quasistatic", "perturbation"})
    for (const double spacing : {0.0, 1e-3}) {
      RunOptions options;
      options.sample_spacing = spacing;
      options.progress = [](const RunProgress& p) { return p.t < 4.0; };
      const RunResult result = make_rung(name, mechanism)->run(mechanism->parameters(), options);
      EXPECT_TRUE(result.interrupted) << name;
      EXPECT_GE(result.end_time, 4.0) << name;
      EXPECT_LT(result.end_time, 6.0) << name;
    }
}

// A ripple with a whole number of cycles between any two instants that halve the motion, or that divide it by a thousand, is a constant at all
// of them: of 50 urad it has an RMS of 50 / sqrt(2), on every rung.
TEST(MotionWithoutPlay, SeesARippleThatGoesOnBetweenItsInstants) {
  for (const char* ripple : {"cos(64*q)", "sin(64*q + 0.5)", "cos(500*q)", "cos(1000*q)"}) {
    MechanismDescription m = read_mechanism(
        std::string(BORESIGHT_EXAMPLES) + "/altaz-gimbal/altaz-gimbal.toml",
        {{"motion.drives.azimuth", "2*pi*t"}, {"motion.drives.elevation", "0.4"}, {"motion.duration", "1 s"}});
    m.errors.clear();
    m.errors.push_back(scenes::drive_error(m, "azimuth", ripple));
    m.errors.back().value = 50e-6;
    const auto mechanism = scenes::build(m);
    for (const char* rung : {"quasistatic", "perturbation", "multibody"}) {
      const Statistics found = of_indices(*mechanism, *make_rung(rung, mechanism)).index.orientation_error;
      EXPECT_NEAR(found.rms / 50e-6, std::sqrt(0.5), 2e-3) << ripple << ", " << rung;
      EXPECT_NEAR(found.max / 50e-6, 1.0, 2e-3) << ripple << ", " << rung;
    }
  }
}

// A dent of a screw, or a knock, between all instants of a first grid: a law is looked at as a motion's own is.
TEST(MotionWithoutPlay, SeesAnErrorThatActsForAMoment) {
  for (const char* law : {"exp(-((t-0.5137)/2e-4)^2)", "exp(-((q-3.2173)/1e-3)^2)"}) {
    MechanismDescription m = read_mechanism(
        std::string(BORESIGHT_EXAMPLES) + "/altaz-gimbal/altaz-gimbal.toml",
        {{"motion.drives.azimuth", "2*pi*t"}, {"motion.drives.elevation", "0.4"}, {"motion.duration", "1 s"}});
    m.errors.clear();
    m.errors.push_back(scenes::drive_error(m, "azimuth", law));
    m.errors.back().value = 50e-6;
    const auto mechanism = scenes::build(m);
    // Multibody solves each of its many instants: by time alone.
    for (const std::string rung : {"quasistatic", "perturbation", "multibody"}) {
      if (rung == "multibody" && std::string(law).find('q') != std::string::npos) continue;
      const Statistics found = of_indices(*mechanism, *make_rung(rung, mechanism)).index.orientation_error;
      EXPECT_NEAR(found.max / 50e-6, 1.0, 0.05) << law << ", " << rung;
    }
  }
}

}  // namespace motion_without_play_test
}  // namespace boresight
