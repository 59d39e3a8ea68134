// What a user may get wrong about the data of boresight calibrate: refused in words.
#include <gtest/gtest.h>

#include "program.hpp"

namespace boresight::app {
namespace calibrate_input_test {

class CalibrateInput : public Program {
 protected:
  void SetUp() override {
    Program::SetUp();
    for (const char* file : {"calibrate.toml", "rig.toml", "slow.csv", "middle.csv", "fast.csv"})
      std::filesystem::copy_file(std::string(BORESIGHT_EXAMPLES "/calibration/") + file, folder_ / file);
  }
};

TEST_F(CalibrateInput, RefusesARigThatMakesNoSenseOrThatNobodyAskedFor) {
  const auto refused = [&](const std::vector<std::string>& options, const std::string& line) {
    std::vector<std::string> arguments = {"calibrate", "calibrate.toml"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    const Ended ended = call(arguments);
    EXPECT_EQ(ended.status, 2) << line;
    EXPECT_TRUE(is_one_line(ended.err)) << ended.err;
    EXPECT_NE(ended.err.find(line), std::string::npos) << ended.err;
  };
  for (const char* seed : {"-1", "1.5", "x"})
    refused({"--make-data", "1 %", "--make-seed", seed},
            "--make-seed: found \"" + std::string(seed) + "\", expected a whole number");
  for (const char* samples : {"0", "-5", "2000000", "1e3"})
    refused({"--make-data", "1 %", "--make-samples", samples},
            "--make-samples: found \"" + std::string(samples) + "\", expected a whole number from 1 to 1000000");
  for (const auto& [option, value] :
       {std::pair{"--make-seed", "3"}, {"--make-samples", "50"}, {"--make-offset", "5 um"}, {"--make-channels", "rx"}})
    refused({option, value}, std::string(option) + ": found \"" + value + "\" without --make-data");
}

// Where a fit starts from what the study says, the mechanism's own value is that of data that are made alone.
TEST_F(CalibrateInput, RefusesASettingOfAFittedParameterThatHasAStart) {
  const std::vector<std::string> setting = {"--set", "clearance.D.radial=0.22mm"};
  const Ended ended = call({"calibrate", "calibrate.toml", setting[0], setting[1]});
  EXPECT_EQ(ended.status, 2);
  EXPECT_TRUE(is_one_line(ended.err)) << ended.err;
  EXPECT_NE(ended.err.find("clearance.D.radial: found a value that would have no effect"), std::string::npos)
      << ended.err;
  for (const char* file : {"slow.csv", "middle.csv", "fast.csv"}) std::filesystem::remove(folder_ / file);
  EXPECT_EQ(
      call({"calibrate", "calibrate.toml", "--make-data", "1 %", "--make-samples", "5", setting[0], setting[1]}).status,
      0);
}

}  // namespace calibrate_input_test
}  // namespace boresight::app
