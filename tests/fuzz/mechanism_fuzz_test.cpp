// Damaged mechanism files are either refused in one line or read into something that holds; nothing crashes or hangs.
#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <fstream>
#include <iterator>

#include "boresight/io/expression.hpp"
#include "boresight/io/mechanism_file.hpp"
#include "boresight/keys/units.hpp"
#include "boresight/keys/value_fault.hpp"
#include "boresight/mechanism/error.hpp"
#include "fuzz_seed.hpp"
#include "mutation.hpp"
#include "valid_description.hpp"

namespace boresight {
namespace {

constexpr double kLongest = 5.0;  // [s] for one input, on a busy machine

std::vector<std::string> example_files() {
  std::vector<std::string> texts;
  for (const char* name :
       {"/3-rrcpr/3-rrcpr.toml", "/crank-slider/crank-slider.toml", "/four-bar/four-bar.toml",
        "/../tests/apps/boresight/every_key/two_bearings.toml", "/../tests/apps/boresight/every_key/pad.toml",
        "/../tests/apps/boresight/every_key/rectangular_pad.toml"}) {
    std::ifstream in(std::string(BORESIGHT_EXAMPLES) + name, std::ios::binary);
    texts.emplace_back(std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>());
  }
  // One more that uses springs, loads, starting rates, six-number inertia and a free axis.
  texts.push_back(R"toml(format = 1
gravity = ["0 m/s^2", "0 m/s^2", "-9.81 m/s^2"]
body = [{ name = "arm", mass = "1 kg", center_of_mass = ["0 m", "0 m", "1 m"], inertia = ["1 kg m^2", "1 kg m^2", "1 kg m^2", "0 kg m^2", "0.1 kg m^2", "0 kg m^2"], boresight = [0, 0, 1] }]
joint = [{ name = "R", type = "cylindrical", connects = ["ground", "arm"], point = ["0 m", "0 m", "0 m"], axis = [1, 0, 0] }]
clearance = [{ joint = "R", journal = "arm", radial = "0.1 mm", journal_radius = "5 mm", sleeve_length = "20 mm", axes = "free" }]
spring = [{ connects = ["ground", "arm"], points = [["0 m", "1 m", "0 m"], ["0 m", "0 m", "1 m"]], stiffness = "10 N/m", free_length = "1 m" }]
load = [{ body = "arm", point = ["0 m", "0 m", "1 m"], force = ["sin(t)", "0", "exp(-t)"] }]
initial = { rates = { "R.angle" = "1 rad/s" } }
motion = { duration = "1 s" }
)toml");
  return texts;
}

struct Tally {
  int read = 0, refused = 0;
};

void run_fuzz(int count, std::uint64_t seed, Tally& tally) {
  const std::vector<std::string> seeds = example_files();
  for (int k = 0; k < count; ++k) {
    Mutator mutator(seed + static_cast<std::uint64_t>(k));
    const std::string text = mutator.mutate(seeds[mutator.below(seeds.size())]);
    std::vector<Setting> settings;
    if (mutator.below(4) == 0)
      settings.push_back({mutator.below(2) == 0 ? "payload.mass" : "clearance.*.radial", mutator.mutate("0.2 mm")});
    const auto begin = std::chrono::steady_clock::now();
    try {
      const std::string fault = fault_of(read_mechanism_text(text, "fuzz.toml", settings));
      EXPECT_EQ(fault, "") << "BORESIGHT_FUZZ_SEED=" << seed + static_cast<std::uint64_t>(k) << ":\n" << text;
      ++tally.read;
    } catch (const InputError& error) {
      const std::string line = error.what();
      EXPECT_FALSE(line.empty()) << "input " << k;
      EXPECT_EQ(line.find_first_of("\n\r"), std::string::npos) << "input " << k << ": " << line;
      EXPECT_LT(line.size(), 2000u) << "input " << k;
      EXPECT_NE(line.find("expected "), std::string::npos) << "input " << k << ": " << line;
      ++tally.refused;
    } catch (const std::exception& error) {
      ADD_FAILURE() << "BORESIGHT_FUZZ_SEED=" << seed + static_cast<std::uint64_t>(k)
                    << " threw something else: " << error.what() << "\n"
                    << text.substr(0, 4000);
    }
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    EXPECT_LT(seconds, kLongest) << "input " << k;
    if (testing::Test::HasFailure()) return;
  }
}

TEST(MechanismFuzz, DamagedFilesAreRefusedInOneLineOrHold) {
  Tally tally;
  run_fuzz(6000, fuzz_seed(), tally);
  EXPECT_GT(tally.read, 50);  // the damage must not be so gross that nothing gets past the first checks
  EXPECT_GT(tally.refused, 2000);
}

// Eight times as many as above: the seed is another one every day, so that days add up to as many.
TEST(NightMechanismFuzz, DamagedFilesAreRefusedInOneLineOrHold) {
  Tally tally;
  run_fuzz(50000 * fuzz_times(), fuzz_seed() + 100'000, tally);
}

void run_small(int count, std::uint64_t seed) {
  const std::vector<std::string> expressions = {"2*pi*sin(pi*t)",          "500*sin(theta)*cos(psi) + 5*sin(pi*t)",
                                                "atan2(t, 1+t^2)^3/(2-t)", "pow(abs(t), 2.5)*exp(-3*t)",
                                                "log(sqrt(1+t^2))^-2",     "9^2^3 + (2*t)^8*(t+1)^7"};
  const std::vector<std::string> quantities = {"0.1 mm", "72 GPa",     "5 kg m^2", "3 N s/m",
                                               "10 µm",  "1e-3 m/s^2", "30 deg"};
  for (int k = 0; k < count; ++k) {
    Mutator mutator(seed + static_cast<std::uint64_t>(k));
    const std::string expression = mutator.mutate(expressions[mutator.below(expressions.size())]);
    const std::string quantity = mutator.mutate(quantities[mutator.below(quantities.size())]);
    const auto begin = std::chrono::steady_clock::now();
    try {
      parse_expression(expression, {{"psi", "2*pi*t"}, {"theta", "t^2"}})->at(0.5);
    } catch (const ValueFault& fault) {
      EXPECT_FALSE(fault.found.empty() || fault.expected.empty()) << expression;
    }
    for (const SiUnit& unit : {kLength, kElasticModulus, kAngle, kInertia}) {
      try {
        EXPECT_TRUE(std::isfinite(parse_quantity(quantity, unit))) << quantity;
      } catch (const ValueFault& fault) {
        EXPECT_FALSE(fault.found.empty() || fault.expected.empty()) << quantity;
      }
    }
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    EXPECT_LT(seconds, kLongest) << "input " << k << ": " << expression.substr(0, 200);
    if (testing::Test::HasFailure()) return;
  }
}

TEST(ValueFuzz, DamagedExpressionsAndQuantitiesAreRefusedOrHold) { run_small(10000, fuzz_seed()); }
TEST(NightValueFuzz, DamagedExpressionsAndQuantitiesAreRefusedOrHold) {
  run_small(125000 * fuzz_times(), fuzz_seed() + 100'000);
}

}  // namespace
}  // namespace boresight
