// What a calibration's table may say.
#include "boresight_analyses/calibration/calibration_plan.hpp"

#include <gmock/gmock.h>

#include "boresight/io/mechanism_file.hpp"
#include "boresight/mechanism/error.hpp"
#include "boresight_analyses/calibration/fitted_parameter.hpp"

namespace boresight {
namespace calibration_plan_test {

MechanismDescription mechanism() { return read_mechanism(BORESIGHT_EXAMPLES "/crank-slider/crank-slider.toml"); }

CalibrationPlan read(const std::string& table) {
  Document document =
      Document::from_text("[calibrate]\n" + table +
                              "\n[[calibrate.parameter]]\npath = \"clearance.A.radial\"\nstart = \"0.05 mm\"\n"
                              "[[calibrate.run]]\ndata = \"slow.csv\"\n",
                          "study.toml");
  Cursor root(document);
  return read_calibration_plan(root, Study{}, mechanism());
}

std::string fault(const std::string& table) {
  try {
    read(table);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no fault";
}

TEST(CalibrationPlan, TakesWholeNumbersUpToTheEndsThatItNames) {
  EXPECT_EQ(read("starts = 1").starts, 1);
  EXPECT_EQ(read("starts = 1000").starts, 1000);
  EXPECT_EQ(read("corrections = 0").corrections, 0);
  EXPECT_EQ(read("corrections = 10").corrections, 10);
  EXPECT_EQ(read("seed = 0").seed, 0u);
  EXPECT_THAT(fault("starts = 0"), testing::HasSubstr("1 to 1000"));
  EXPECT_THAT(fault("starts = 1001"), testing::HasSubstr("1 to 1000"));
  EXPECT_THAT(fault("corrections = 11"), testing::HasSubstr("0 to 10"));
}

TEST(CalibrationPlan, TakesAPriorAsAShareOfWhatHasNoUnitToo) {
  const CalibrationPlan plan =
      read("[[calibrate.parameter]]\npath = \"clearance.A.friction.coefficient\"\nstart = 0.08\nprior = \"20 %\"\n");
  ASSERT_EQ(plan.parameters.size(), 2u);
  EXPECT_TRUE(plan.parameters[0].prior_is_share);
  EXPECT_NEAR(*plan.parameters[0].prior, 0.2, 1e-15);
}

TEST(CalibrationPlan, SaysAScaleWithoutAUnitInPartsPerMillion) {
  const MechanismDescription errors = read_mechanism(BORESIGHT_EXAMPLES "/3-rrcpr/tolerances.toml");
  EXPECT_EQ(fitted_parameter(errors, "error.A1.scale", 0.0).written_unit, "ppm");
  EXPECT_EQ(fitted_parameter(errors, "error.A1.scale", 0.0).told_unit(), "1");
  EXPECT_EQ(fitted_parameter(errors, "error.A1.zero", 0.0).written_unit, "");
  EXPECT_EQ(fitted_parameter(errors, "error.A1.zero", 0.0).told_unit(), "rad");
}

TEST(CalibrationPlan, RefusesACandidateThatSetsWhatIsFitted) {
  EXPECT_THAT(fault("[[calibrate.candidate]]\nname = \"next\"\nset = [\"clearance.A.radial=0.1 mm\"]\n"),
              testing::HasSubstr("which is fitted"));
}

}  // namespace calibration_plan_test
}  // namespace boresight
