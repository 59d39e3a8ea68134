#include "boresight_analyses/sweep/sweep_plan.hpp"

#include <gmock/gmock.h>

#include <cmath>

#include "boresight/mechanism/error.hpp"
#include "example.hpp"

namespace boresight {
namespace sweep_plan_test {

using testing::AllOf;
using testing::HasSubstr;

class SweepPlanTest : public testing::Test {
 protected:
  SweepPlan plan(const std::string& text) const { return plan_of(text, *mechanism_); }
  std::string fault(const std::string& text) const {
    try {
      plan(text);
    } catch (const InputError& error) {
      return error.what();
    }
    return "no fault";
  }
  std::shared_ptr<const Mechanism> mechanism_ = short_mechanism();
};

TEST_F(SweepPlanTest, OneAxisMaySetSeveralParametersToTheSameValue) {
  const SweepPlan p = plan(
      "[[sweep.axis]]\nparameter = [\"clearance.F1.radial\", \"clearance.F1.axial\"]\nvalues = [\"0.1 mm\", "
      "\"300 um\"]\n");
  ASSERT_EQ(p.points(), 2u);
  const Parameters second = p.parameters_at(*mechanism_, 1);
  EXPECT_DOUBLE_EQ(second.clearance[0].radial, 3e-4);
  EXPECT_DOUBLE_EQ(second.clearance[0].axial, 3e-4);
}

TEST_F(SweepPlanTest, SeveralAxesMakeAGridWhoseLastAxisRunsFastest) {
  const SweepPlan p = plan(
      "[[sweep.axis]]\nparameter = \"clearance.*.radial\"\nvalues = [\"0.1 mm\", \"0.2 mm\"]\n"
      "[[sweep.axis]]\nparameter = \"payload.mass\"\nfrom = \"0 kg\"\nto = \"500 kg\"\ncount = 3\n");
  ASSERT_EQ(p.points(), 6u);
  EXPECT_EQ(p.values_at(1), (std::vector<double>{1e-4, 250.0}));
  EXPECT_EQ(p.values_at(3), (std::vector<double>{2e-4, 0.0}));
  EXPECT_EQ(p.parameters_at(*mechanism_, 5).payload_mass, 500.0);
}

TEST_F(SweepPlanTest, ALogarithmicAxisHasEqualRatios) {
  const SweepPlan p = plan(
      "[[sweep.axis]]\nparameter = \"clearance.F1.radial\"\nfrom = \"10 um\"\nto = \"1 mm\"\ncount = "
      "3\nscale = \"log\"\n");
  EXPECT_NEAR(p.axes[0].values[1], 1e-4, 1e-18);
  EXPECT_EQ(p.axes[0].values[2], 1e-3);
}

TEST_F(SweepPlanTest, PureNumbersArePlain) {
  EXPECT_EQ(
      plan("[[sweep.axis]]\nparameter = \"clearance.F1.contact.restitution\"\nvalues = [0.7, 0.9]\n").axes[0].values,
      (std::vector<double>{0.7, 0.9}));
}

TEST_F(SweepPlanTest, FaultsNameLineKeyAndWhatIsExpected) {
  EXPECT_THAT(fault("[[sweep.axis]]\nparameter = \"clearance.F1.radiall\"\nvalues = [\"1 mm\"]\n"),
              AllOf(HasSubstr("study.toml:3"), HasSubstr("did you mean clearance.F1.radial?")));
  EXPECT_THAT(fault("[[sweep.axis]]\nparameter = \"payload.mass\"\nvalues = [\"1 mm\"]\n"), HasSubstr("mass"));
  EXPECT_THAT(fault("[[sweep.axis]]\nparameter = [\"payload.mass\", \"clearance.F1.radial\"]\nvalues = [\"1 kg\"]\n"),
              HasSubstr("parameters that take the same values"));
  EXPECT_THAT(fault("[[sweep.axis]]\nparameter = \"payload.mass\"\n"), HasSubstr("values = [...]"));
  EXPECT_THAT(fault("[[sweep.axis]]\nparameter = \"payload.mass\"\nvalues = [\"1 kg\", \"1000 g\"]\n"),
              HasSubstr("differ"));
  EXPECT_THAT(fault("[[sweep.axis]]\nparameter = \"payload.mass\"\nfrom = \"0 kg\"\nto = \"1 kg\"\ncount = "
                    "3\nscale = \"log\"\n"),
              HasSubstr("more than 0"));
  EXPECT_THAT(fault("findings = \"nobody\"\n[[sweep.axis]]\nparameter = \"payload.mass\"\nvalues = [\"1 kg\"]\n"),
              HasSubstr("sun-3-rrcpr"));
  EXPECT_THAT(fault(""), HasSubstr("at least one"));
}

TEST_F(SweepPlanTest, KeepsTheUnitThatIsWritten) {
  EXPECT_EQ(
      plan("[[sweep.axis]]\nparameter = \"clearance.F1.radial\"\nvalues = [\"50 um\", \"0.1 mm\"]\n").axes[0].unit,
      "um");
  EXPECT_EQ(
      plan("[[sweep.axis]]\nparameter = \"payload.mass\"\nfrom = \"0 g\"\nto = \"1 kg\"\ncount = 3\n").axes[0].unit,
      "g");
  EXPECT_EQ(plan("[[sweep.axis]]\nparameter = \"clearance.F1.contact.restitution\"\nvalues = [0.7]\n").axes[0].unit,
            "");
}

TEST_F(SweepPlanTest, TakesNoValueThatAMechanismFileMayNotHold) {
  EXPECT_THAT(fault("[[sweep.axis]]\nparameter = \"payload.mass\"\nvalues = [\"1 kg\", \"-1 kg\"]\n"),
              AllOf(HasSubstr("study.toml:4"), HasSubstr("payload.mass")));
  EXPECT_THAT(fault("[[sweep.axis]]\nparameter = \"clearance.F1.contact.restitution\"\nvalues = [0.5, 1.5]\n"),
              HasSubstr("study.toml:4"));
}

std::string axis(const std::string& parameter, const std::string& values) {
  return "[[sweep.axis]]\nparameter = \"" + parameter + "\"\nvalues = [" + values + "]\n";
}

// Each value may stand in the file as it is: a cap of 16 mm, a bore of 10.1 mm.
TEST_F(SweepPlanTest, NamesThePointWhoseValuesAreLegalEachButNotTogether) {
  EXPECT_THAT(
      fault(axis("clearance.F1.cap_radius", "\"12 mm\", \"16 mm\"") +
            axis("clearance.F1.journal_radius", "\"8 mm\", \"13 mm\"") + axis("payload.mass", "\"0 kg\", \"1 kg\"")),
      AllOf(HasSubstr("study.toml:4: clearance.F1.cap_radius: found \"12 mm\" at the point "
                      "clearance.F1.cap_radius = 12 mm, clearance.F1.journal_radius = 13 mm"),
            HasSubstr("expected more than journal_radius + radial")));
  EXPECT_THAT(fault(axis("clearance.F1.friction.static_speed", "\"0.1 mm/s\", \"0.9 mm/s\"") +
                    axis("clearance.F1.friction.dynamic_speed", "\"1 mm/s\", \"0.5 mm/s\"")),
              AllOf(HasSubstr("static_speed = 0.9 mm/s, clearance.F1.friction.dynamic_speed = 0.5 mm/s"),
                    HasSubstr("expected dynamic_speed above static_speed")));
  EXPECT_THAT(fault("[[sweep.axis]]\nparameter = [\"clearance.F1.radial\", \"clearance.F1.journal_radius\"]\n"
                    "values = [\"0.1 mm\"]\n"),
              HasSubstr("less than journal_radius"));
}

TEST_F(SweepPlanTest, BlamesNoPointForAValueThatNoPointMayHave) {
  const std::string found = fault(axis("clearance.F1.cap_radius", "\"12 mm\", \"16 mm\"") +
                                  axis("clearance.F1.radial", "\"0.1 mm\", \"-1 mm\""));
  EXPECT_THAT(found, AllOf(HasSubstr("study.toml:7"), HasSubstr("clearance.F1.radial"), HasSubstr("\"-1 mm\"")));
  EXPECT_THAT(found, testing::Not(HasSubstr("at the point")));
}

// The file's own bore is 10.1 mm: a cap of 9 mm goes with the journals of this grid, if not with that of the file.
TEST_F(SweepPlanTest, TakesAValueThatIsLegalAtEveryPointThoughNotBesideTheFilesOwn) {
  const SweepPlan p = plan(axis("clearance.F1.cap_radius", "\"9 mm\", \"16 mm\"") +
                           axis("clearance.F1.journal_radius", "\"5 mm\", \"8 mm\""));
  EXPECT_EQ(p.points(), 4u);
}

TEST(SweepOfErrors, TakesTheScaleOfADriveAsAShare) {
  const Mechanism mechanism(read_mechanism(BORESIGHT_EXAMPLES "/3-rrcpr/tolerances.toml"));
  const auto values = [&](const std::string& parameter, const std::string& text) {
    Document document = Document::from_text("[sweep]\n" + axis(parameter, text), "study.toml");
    Cursor root(document);
    return read_sweep_plan(root, mechanism.description(), [](const Setting&) {}).axes[0];
  };
  const SweepAxis shares = values("error.A1.scale", "\"100 ppm\", \"0.02 %\", 3e-4, \"4e-4 rad\"");
  ASSERT_EQ(shares.values.size(), 4u);
  for (std::size_t k = 0; k < 4; ++k) EXPECT_NEAR(shares.values[k], 1e-4 * static_cast<double>(k + 1), 1e-15);
  EXPECT_EQ(shares.unit, "ppm");
  EXPECT_EQ(values("error.A1.scale", "1e-4, 2e-4").unit, "ppm") << "not the radians of its drive";
  EXPECT_EQ(values("error.A1.zero", "\"1e-4 rad\", \"2e-4 rad\"").unit, "rad");
  EXPECT_THROW(values("error.A1.zero", "\"100 ppm\""), InputError);  // an angle
}

TEST_F(SweepPlanTest, RefusesAGridBeyondReason) {
  EXPECT_THAT(fault("[[sweep.axis]]\nparameter = \"payload.mass\"\nfrom = \"0 kg\"\nto = \"1 kg\"\ncount = 1000\n"
                    "[[sweep.axis]]\nparameter = \"clearance.F1.radial\"\nfrom = \"1 um\"\nto = \"1 mm\"\ncount = "
                    "1000\n"),
              HasSubstr("1000000 points"));
}

}  // namespace sweep_plan_test
}  // namespace boresight
