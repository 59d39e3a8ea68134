// What an [[allocate]] table may say of a tolerance.
#include "boresight_analyses/allocation/allocation_plan.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "boresight/io/mechanism_file.hpp"
#include "boresight/mechanism/error.hpp"

namespace boresight {
namespace allocation_plan_test {

using testing::HasSubstr;

std::string read(const std::string& tolerance) {
  static const MechanismDescription mechanism = read_mechanism(BORESIGHT_EXAMPLES "/3-rrcpr/3-rrcpr.toml");
  Document document = Document::from_text(R"([allocate]
requirement = { limit = "0.5 mm", probability = 0.95, confidence = 0.9 }
[[allocate.joint]]
parameter = "clearance.F1.radial"
tolerance = )" + tolerance + R"(
cost = { law = "reciprocal-power", a = 1, b = 2, k = 1 }
)",
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

TEST(AllocationPlan, TakesATolerancesTightestAndWidestInThisOrderAndAboveNothing) {
  EXPECT_EQ(read(R"(["0.05 mm", "0.2 mm"])"), "read");
  for (const char* wrong : {R"(["0.2 mm", "0.05 mm"])", R"(["0.1 mm", "0.1 mm"])", R"(["0 mm", "0.1 mm"])",
                            R"(["-0.1 mm", "0.1 mm"])", R"(["0.1 mm"])", R"(["0.05 mm", "0.1 mm", "0.2 mm"])"})
    EXPECT_THAT(read(wrong), testing::AllOf(HasSubstr("study.toml:5"), HasSubstr("tolerance"),
                                            HasSubstr("two lengths, the tightest and the widest tolerance")))
        << wrong;
}

}  // namespace allocation_plan_test
}  // namespace boresight
