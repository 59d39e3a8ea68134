// boresight calibrate, as a user calls it.
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "program.hpp"

namespace boresight::app {
namespace {

const std::string kExample = BORESIGHT_EXAMPLES "/calibration/";

class CalibrateProgram : public Program {
 protected:
  void SetUp() override {
    Program::SetUp();
    for (const char* file : {"calibrate.toml", "rig.toml", "slow.csv", "middle.csv", "fast.csv"})
      std::filesystem::copy_file(kExample + file, folder_ / file);
  }
};

TEST_F(CalibrateProgram, LongRecoversTheExamplesTruthAndItsPosteriorFeedsMonteCarlo) {
  const Ended ended = call({"calibrate", "calibrate.toml", "--out", "out", "--quiet", "--jobs", "2"});
  ASSERT_EQ(ended.status, 0) << ended.err;
  const nlohmann::json summary = json("out/summary.json");
  EXPECT_TRUE(summary["converged"].get<bool>());
  EXPECT_NEAR(summary["optimum"]["clearance.D.radial"].get<double>(), 2e-4, 2e-6);
  EXPECT_NEAR(summary["optimum"]["clearance.D.friction.coefficient"].get<double>(), 0.1, 0.01);
  EXPECT_NEAR(summary["optimum"]["bias.dx"].get<double>(), 5e-6, 5e-7);
  for (const char* path : {"clearance.D.radial", "clearance.D.contact.restitution"}) {
    EXPECT_TRUE(summary["identifiable"][path]["value"].get<bool>());
    EXPECT_GT(summary["standard_error"][path].get<double>(), 0.0);
    EXPECT_LT(summary["interval"][path]["low"].get<double>(),
              summary["interval"][path]["high"].get<double>());
    EXPECT_NEAR(summary["correlation"][path][path].get<double>(), 1.0, 1e-9);
  }
  std::ofstream(folder_ / "scatter.toml") << "format = 1\nmechanism = \"rig.toml\"\n"
                                          << text("out/posterior.toml") << "\n[montecarlo]\nsamples = 20\n";
  const Ended scatter =
      call({"montecarlo", "scatter.toml", "--rung", "perturbation", "--out", "mc", "--quiet"});
  EXPECT_EQ(scatter.status, 0) << scatter.err;
}

TEST_F(CalibrateProgram, RefusesAPlayThatAnotherBearingHolds) {
  std::string rig = text("rig.toml");
  rig.insert(rig.find("[initial]"), "[[joint]]\nname = \"D2\"\ntype = \"revolute\"\nconnects = [\"ground\", \"rocker\"]\n"
                                    "point = [\"190 mm\", \"100 mm\", \"0 mm\"]\naxis = [1, 0, 0]\n\n");
  std::ofstream(folder_ / "rig.toml") << rig;
  const Ended ended = call({"calibrate", "calibrate.toml", "--out", "out"});
  EXPECT_EQ(ended.status, 3);
  EXPECT_TRUE(is_one_line(ended.err)) << ended.err;
  EXPECT_NE(ended.err.find("\"D\" cannot move: \"D2\" holds"), std::string::npos) << ended.err;
}

TEST_F(CalibrateProgram, NamesTheLineOfABadRow) {
  std::ofstream(folder_ / "middle.csv") << "t [s], dx [um]\n0, 1\n0.001, l.5\n";
  const Ended ended = call({"calibrate", "calibrate.toml", "--out", "out"});
  EXPECT_EQ(ended.status, 2);
  EXPECT_TRUE(is_one_line(ended.err)) << ended.err;
  EXPECT_NE(ended.err.find("middle.csv:3: dx"), std::string::npos) << ended.err;
}

TEST_F(CalibrateProgram, NamesTheNearestChannel) {
  std::ofstream(folder_ / "middle.csv") << "t [s], boresigth_error [urad]\n0, 1\n";
  const Ended ended = call({"calibrate", "calibrate.toml", "--out", "out"});
  EXPECT_EQ(ended.status, 2);
  EXPECT_NE(ended.err.find("boresight_error"), std::string::npos) << ended.err;
}

}  // namespace
}  // namespace boresight::app
