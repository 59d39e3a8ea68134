// What an [[allocate]] table may say of a tolerance.
#include "boresight_analyses/allocation/allocation_plan.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "boresight/io/mechanism_file.hpp"
#include "boresight/mechanism/error.hpp"

namespace boresight {
namespace allocation_plan_test {

using testing::HasSubstr;

// What follows the parameter's path.
std::string read_entry(const std::string& entry) {
  static const MechanismDescription mechanism = read_mechanism(BORESIGHT_EXAMPLES "/3-rrcpr/3-rrcpr.toml");
  Document document = Document::from_text(R"([allocate]
requirement = { limit = "0.5 mm", probability = 0.95, confidence = 0.9 }
[[allocate.joint]]
parameter = "clearance.F1.radial"
)" + entry,
                                          "study.toml");
  Cursor root(document);
  Study study;
  study.index.quantity = "position_error";
  try {
    const AllocationPlan plan = read_allocation_plan(root, study, mechanism, [](const Setting&) {});
    return "read";
  } catch (const InputError& fault) {
    return fault.what();
  }
}

std::string read(const std::string& tolerance) {
  return read_entry("tolerance = " + tolerance + "\ncost = { law = \"reciprocal-power\", a = 1, b = 2, k = 1 }\n");
}

// Reports and files tell processes by their names.
TEST(AllocationPlan, TakesTwoProcessesByTwoNames) {
  const auto processes = [](const char* second) {
    return read_entry("processes = [{ name = \"reamed\", tolerance = \"0.02 mm\", price = 4 }, { name = \"" +
                      std::string(second) + "\", tolerance = \"0.006 mm\", price = 11 }]\n");
  };
  EXPECT_EQ(processes("honed"), "read");
  EXPECT_THAT(processes("reamed"), HasSubstr("found \"reamed\" a second time, expected a name of its own"));
}

TEST(AllocationPlan, TakesATolerancesTightestAndWidestInThisOrderAndAboveNothing) {
  EXPECT_EQ(read(R"(["0.05 mm", "0.2 mm"])"), "read");
  for (const char* wrong : {R"(["0.2 mm", "0.05 mm"])", R"(["0.1 mm", "0.1 mm"])", R"(["0 mm", "0.1 mm"])",
                            R"(["-0.1 mm", "0.1 mm"])", R"(["0.1 mm"])", R"(["0.05 mm", "0.1 mm", "0.2 mm"])"})
    EXPECT_THAT(read(wrong), testing::AllOf(HasSubstr("study.toml:5"), HasSubstr("tolerance"),
                                            HasSubstr("two lengths, the tightest and the widest tolerance")))
        << wrong;
}

// Of a scale: a share of what the drive does, though it is computed in the drive's radians.
TEST(AllocationPlan, SaysAToleranceInTheUnitThatItIsWrittenIn) {
  const MechanismDescription mechanism = read_mechanism(BORESIGHT_EXAMPLES "/3-rrcpr/tolerances.toml");
  const auto said_in = [&](const std::string& parameter, const std::string& tolerance) {
    Document document = Document::from_text(R"([allocate]
requirement = { limit = "0.5 mm", probability = 0.95, confidence = 0.9 }
[[allocate.error]]
parameter = ")" + parameter + "\"\ntolerance = " +
                                                tolerance + "\ncost = { law = \"reciprocal\", b = 0.1 }\n",
                                            "study.toml");
    Cursor root(document);
    Study study;
    study.index.quantity = "position_error";
    return read_allocation_plan(root, study, mechanism, [](const Setting&) {}).entries.at(0).said_in;
  };
  EXPECT_EQ(said_in("error.A1.scale", R"(["20 ppm", "400 ppm"])"), "ppm");
  EXPECT_EQ(said_in("error.A1.scale", "[2e-5, 4e-4]"), "ppm");
  EXPECT_EQ(said_in("error.A1.scale", R"(["0.002 %", "0.04 %"])"), "%");
  EXPECT_EQ(said_in("error.A1.zero", R"(["4 arcsec", "80 arcsec"])"), "arcsec");
  EXPECT_EQ(said_in("error.A1.zero", R"(["2e-5 rad", "4e-4 rad"])"), "rad");
}

}  // namespace allocation_plan_test
}  // namespace boresight
