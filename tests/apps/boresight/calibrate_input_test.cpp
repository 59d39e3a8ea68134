// What a user may get wrong about the data of boresight calibrate: refused in words.
#include <gtest/gtest.h>

#include <fstream>

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

// A sensor that works in a part of one run that nobody fits: with offsets of each run, nothing would tell its own.
TEST_F(CalibrateInput, RefusesToHoldOutAllThatTellsAnOffset) {
  std::ifstream in(folder_ / "slow.csv");
  std::ofstream out(folder_ / "part.csv");
  out << "t [s], dx [um], bx [urad]\n";
  for (std::string line; std::getline(in, line);) {
    if (line.empty() || line[0] == '#' || line[0] == 't') continue;
    const std::size_t first = line.find(','), second = line.find(',', first + 1);
    const double t = std::stod(line);
    out << line.substr(0, second) << ", " << (t > 0.145 && t < 0.155 ? "1" : "") << '\n';
  }
  out.close();
  std::ofstream(folder_ / "part.toml") << R"toml(format = 1
mechanism = "rig.toml"
[calibrate]
starts = 1
mounting_bias = true
offsets_per_run = true
hold_out = "25 %"
window = "20 ms"
[[calibrate.parameter]]
path = "clearance.D.radial"
start = "0.24 mm"
[[calibrate.run]]
data = "part.csv"
set = ["motion.drives.A=2*pi*2*t"]
)toml";
  const Ended ended = call({"calibrate", "part.toml"});
  EXPECT_EQ(ended.status, 2) << ended.err;
  EXPECT_TRUE(is_one_line(ended.err)) << ended.err;
  EXPECT_NE(ended.err.find("calibrate.hold_out: found every window in which part.csv has readings of bx"),
            std::string::npos)
      << ended.err;
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
