#include "boresight_analyses/random/random_inputs.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>

#include "boresight/io/mechanism_file.hpp"
#include "boresight/mechanism/error.hpp"
#include "boresight_analyses/random/sampling_design.hpp"

namespace boresight {
namespace random_inputs_test {

using testing::AllOf;
using testing::HasSubstr;

const std::string kDefaultMechanism = BORESIGHT_EXAMPLES "/3-rrcpr/3-rrcpr.toml";

class RandomInputsTest : public testing::Test {
 protected:
  RandomInputs read(const std::string& text) const {
    Document document = Document::from_text(text, (std::filesystem::path(testing::TempDir()) / "study.toml").string());
    Cursor root(document);
    return read_random_inputs(root, mechanism_->description(), [](const Setting& setting) {
      const Mechanism tried(read_mechanism(kDefaultMechanism, {setting}));
    });
  }
  std::string fault(const std::string& text) const {
    try {
      read(text);
    } catch (const InputError& error) {
      return error.what();
    }
    return "no fault";
  }
  static std::string one(const std::string& parameter, const std::string& distribution) {
    return "[[random]]\nparameter = \"" + parameter + "\"\ndistribution = " + distribution + "\n";
  }
  static std::string radial(const std::string& distribution) { return one("clearance.F1.radial", distribution); }

  const std::shared_ptr<const Mechanism> mechanism_ =
      std::make_shared<const Mechanism>(read_mechanism(kDefaultMechanism));
};

// Computed in the radians of its drive, told as the share that it is: the same number of either.
TEST_F(RandomInputsTest, TellsTheScaleOfADriveAsAShare) {
  const MechanismDescription errors = read_mechanism(BORESIGHT_EXAMPLES "/3-rrcpr/tolerances.toml");
  Document document =
      Document::from_text(one("error.A1.scale", "{ normal = { mean = \"0 ppm\", sd = \"50 ppm\" } }") +
                              one("error.A1.zero", "{ normal = { mean = \"0 rad\", sd = \"1 mrad\" } }"),
                          "study.toml");
  Cursor root(document);
  const RandomInputs inputs = read_random_inputs(root, errors, [](const Setting&) {});
  EXPECT_EQ(inputs.parameters[0].si_unit, "rad");
  EXPECT_EQ(inputs.parameters[0].told_unit(), "1");
  EXPECT_EQ(inputs.parameters[0].unit, "ppm");
  EXPECT_NEAR(inputs.parameters[0].distribution->sd(), 5e-5, 1e-18);
  EXPECT_EQ(inputs.parameters[1].told_unit(), "rad");
}

TEST_F(RandomInputsTest, ReadsTheStudyOfTheInterface) {
  const RandomInputs inputs =
      read(radial("{ normal = { mean = \"0.1 mm\", sd = \"0.01 mm\" }, truncate = [\"0.05 mm\", \"0.15 mm\"] }") +
           one("clearance.F1.contact.restitution", "{ uniform = { min = 0.7, max = 0.95 } }") +
           one("clearance.F1.friction.coefficient", "{ lognormal = { median = 0.03, factor = 1.3 } }"));
  ASSERT_EQ(inputs.size(), 3u);
  std::vector<double> u = {0.5, 0.5, 0.5};
  inputs.values(u);
  EXPECT_NEAR(u[0], 1e-4, 1e-18);
  EXPECT_NEAR(u[1], 0.825, 1e-15);
  EXPECT_NEAR(u[2], 0.03, 1e-16);
  const Parameters p = inputs.parameters_with(*mechanism_, std::vector<double>{2e-4, 0.8, 0.05});
  EXPECT_EQ(p.clearance[0].radial, 2e-4);
  EXPECT_EQ(p.clearance[0].contact.restitution, 0.8);
  EXPECT_EQ(p.clearance[0].friction.coefficient, 0.05);
}

TEST_F(RandomInputsTest, KeepTheUnitThatIsWritten) {
  const auto unit = [&](const std::string& text) { return read(radial(text)).parameters[0].unit; };
  EXPECT_EQ(unit("{ normal = { mean = \"100 um\", sd = \"0.01 mm\" }, truncate = [\"0.05 mm\", \"0.15 mm\"] }"), "um");
  EXPECT_EQ(unit("{ discrete = { values = [\"0.1 mm\", \"200 um\"] } }"), "mm");
  EXPECT_EQ(unit("{ fit = \"20 H7/g6\" }"), "");
  EXPECT_EQ(read(one("clearance.F1.contact.restitution", "{ uniform = { min = 0.7, max = 0.95 } }")).parameters[0].unit,
            "");
}

TEST_F(RandomInputsTest, ReadsEveryDistribution) {
  const std::string csv = (std::filesystem::path(testing::TempDir()) / "gaps.csv").string();
  std::ofstream(csv) << "part, \"gap\"\n1, 90\n2, 110\n3, 130\n";
  for (const char* text : {"{ triangular = { min = \"50 um\", mode = \"0.1 mm\", max = \"0.2 mm\" } }",
                           "{ beta = { alpha = 2, beta = 3.5, min = \"50 um\", max = \"0.2 mm\" } }",
                           "{ beta = { alpha = 0.5, beta = 0.5, min = \"50 um\", max = \"0.2 mm\" } }",
                           "{ weibull = { shape = 0.8, scale = \"0.1 mm\", location = \"10 um\" } }",
                           "{ weibull = { shape = 1.5, scale = \"0.1 mm\", location = \"10 um\" } }",
                           "{ discrete = { values = [\"0.1 mm\", \"0.2 mm\"], probabilities = [0.25, 0.75] } }",
                           "{ empirical = { file = \"gaps.csv\", column = \"gap\", unit = \"um\" } }",
                           "{ fit = \"20 H7/g6\" }", "{ fit = \"20 H7/h6\", zone = \"uniform\" }"})
    EXPECT_EQ(fault(radial(text)), "no fault") << text;
  const RandomInputs inputs = read(radial("{ empirical = { file = \"gaps.csv\", column = \"gap\", unit = \"um\" } }"));
  EXPECT_NEAR(inputs.parameters[0].distribution->mean(), 1.1e-4, 1e-18);
}

TEST_F(RandomInputsTest, MistakesAreOneLineWithFileLineAndKey) {
  const auto says = [&](const std::string& text, const std::string& words) {
    EXPECT_THAT(fault(text), AllOf(HasSubstr("study.toml:"), HasSubstr(words))) << text;
    EXPECT_EQ(fault(text).find('\n'), std::string::npos);
  };
  says("", "[[random]]");
  says("[[random]]\ndistribution = { uniform = { min = 0, max = 1 } }\n", "parameter");
  says("[[random]]\nparameter = \"clearance.F1.radial\"\n", "distribution");
  says(one("clearance.F1.radiall", "{ fit = \"20 H7/g6\" }"), "did you mean clearance.F1.radial?");
  says(radial("{ norml = { mean = \"1 mm\", sd = \"1 um\" } }"), "did you mean normal?");
  says(radial("{ normal = { mean = \"1 mm\", sd = \"0 um\" } }"), "more than 0");
  says(radial("{ normal = { mean = \"1 mm\", sd = \"-1 um\" } }"), "more than 0");
  says(radial("{ normal = { mean = \"1 mm\", sd = \"nan um\" } }"), "sd");
  says(radial("{ normal = { mean = 0.1, sd = \"1 um\" } }"), "mean");
  says(radial("{ normal = { mean = \"1 kg\", sd = \"1 um\" } }"), "mean");
  says(radial("{ normal = { mean = \"1 mm\" } }"), "sd");
  says(radial("{ normal = { mean = \"1 mm\", sd = \"1 um\", max = \"2 mm\" } }"), "unknown key");
  says(radial("{ normal = 3 }"), "a table");
  says(radial("{ uniform = { min = \"2 mm\", max = \"1 mm\" } }"), "more than min");
  says(radial("{ uniform = { min = \"1 mm\", max = \"2 mm\" }, fit = \"20 H7/g6\" }"), "one distribution");
  says(radial("{ lognormal = { median = \"1 mm\", factor = 0.9 } }"), "more than 1");
  says(radial("{ triangular = { min = \"1 mm\", mode = \"3 mm\", max = \"2 mm\" } }"), "between min and max");
  says(radial("{ discrete = { values = [\"1 mm\"], probabilities = [0.5] } }"), "add up to 1");
  says(radial("{ discrete = { values = [\"1 mm\", \"2 mm\"], probabilities = [-0.5, 1.5] } }"), "none below 0");
  says(radial("{ uniform = { min = \"1 mm\", max = \"2 mm\" }, truncate = [\"3 mm\", \"4 mm\"] }"), "any probability");
  says(radial("{ uniform = { min = \"1 mm\", max = \"2 mm\" }, truncate = [\"2 mm\", \"1 mm\"] }"),
       "the second one larger");
  says(radial("{ empirical = { file = \"none.csv\", column = \"gap\", unit = \"um\" } }"), "a CSV file");
  says(radial("{ fit = \"20 H7/k6\" }"), "one of c, d, e, f, g, h, js");
  says(radial("{ fit = \"20 H7/js6\" }"), "always has clearance");
  says(radial("{ fit = \"20 H7/g6\", zone = \"unifrm\" }"), "did you mean uniform?");
  says(one("clearance.F1.axial", "{ fit = \"20 H7/g6\" }"), "radial clearance only");
  says(radial("{ fit = \"20 H7/g6\" }") + radial("{ fit = \"20 H7/g6\" }"), "a second time");
  says(radial("{ fit = \"20 H7/g6\" }") + one("clearance.*.radial", "{ fit = \"20 H7/g6\" }"), "a second time");
}

// The journal of F1 is 20 mm thick. Tolerances grow with the nominal size: 30 H7/g6 is another clearance than 20 H7/g6.
TEST_F(RandomInputsTest, AFitOfAnotherSizeThanTheJointIsRefused) {
  for (const char* size : {"18", "30", "10", "20.5"})
    for (const char* path : {"clearance.F1.radial", "clearance.*.radial"})
      EXPECT_THAT(
          fault(one(path, std::string("{ fit = \"") + size + " H7/g6\" }")),
          AllOf(HasSubstr("study.toml:3"), HasSubstr("fit"), HasSubstr(std::string("of nominal size ") + size + " mm"),
                HasSubstr("the journal of F1 has a diameter of 20 mm"),
                HasSubstr("expected a fit of nominal size 20 mm")))
          << size;
  // Off by the fit's own deviations, or by rounding, it is the joint's.
  for (const char* fits : {"20.1 H9/d9", "20.02 H7/g6", "19.99 H7/g6"})
    EXPECT_EQ(fault(radial(std::string("{ fit = \"") + fits + "\" }")), "no fault") << fits;
}

TEST_F(RandomInputsTest, ValuesThatTheMechanismRefusesAreRefusedBeforeAnySample) {
  EXPECT_THAT(fault(radial("{ normal = { mean = \"0.1 mm\", sd = \"0.05 mm\" } }")),
              AllOf(HasSubstr("study.toml:3"), HasSubstr("clearance.F1.radial"), HasSubstr("truncate")));
  EXPECT_THAT(fault(one("clearance.F1.contact.restitution", "{ uniform = { min = 0.7, max = 1.2 } }")),
              HasSubstr("a distribution that reaches"));
  EXPECT_THAT(fault(one("payload.mass", "{ normal = { mean = \"1 kg\", sd = \"1 kg\" } }")), HasSubstr("payload.mass"));
}

TEST_F(RandomInputsTest, CorrelatedParametersKeepTheirMarginalsAndHaveTheCorrelationAskedFor) {
  const std::string two = one("clearance.F1.contact.restitution", "{ uniform = { min = 0.7, max = 0.95 } }") +
                          one("clearance.F1.friction.coefficient", "{ lognormal = { median = 0.03, factor = 1.3 } }");
  const auto pair = std::string(
      "[[correlation]]\nparameters = [\"clearance.F1.contact.restitution\", \"clearance.F1.friction.coefficient\"]\n");
  const RandomInputs inputs = read(two + pair + "coefficient = -0.6\nmeasure = \"spearman\"\n");
  const SamplingDesign design({.seed = 4}, 2);
  constexpr int n = 20000;
  double rank = 0.0, below = 0.0;
  for (std::uint64_t k = 0; k < n; ++k) {
    std::vector<double> u(2);
    design.point(k, u);
    inputs.values(u);
    const double a = inputs.parameters[0].distribution->cdf(u[0]), b = inputs.parameters[1].distribution->cdf(u[1]);
    rank += 12.0 * (a - 0.5) * (b - 0.5);
    below += b < 0.2;
  }
  EXPECT_NEAR(rank / n, -0.6, 0.02);
  EXPECT_NEAR(below / n, 0.2, 0.01);
  EXPECT_THAT(fault(two + pair + "coefficient = 1.5\n"), HasSubstr("less than 1"));
  EXPECT_THAT(fault(two + pair + "coefficient = 0.5\nmeasure = \"pearson\"\n"), HasSubstr("measure"));
  EXPECT_THAT(fault(two + pair + "coefficient = 0.5\n" + pair + "coefficient = 0.4\n"), HasSubstr("each pair once"));
  EXPECT_THAT(
      fault(two + "[[correlation]]\nparameters = [\"clearance.F1.radial\", \"clearance.F1.friction.coefficient\"]\n"
                  "coefficient = 0.5\n"),
      HasSubstr("[[random]]"));
}

TEST_F(RandomInputsTest, CorrelationsThatCannotHoldTogetherAreRefused) {
  std::string text;
  const char* paths[] = {"clearance.F1.contact.restitution", "clearance.F1.friction.coefficient",
                         "clearance.F1.contact.poisson"};
  for (const char* path : paths) text += one(path, "{ uniform = { min = 0.1, max = 0.3 } }");
  const auto pair = [&](int a, int b, const char* r) {
    return std::string("[[correlation]]\nparameters = [\"") + paths[a] + "\", \"" + paths[b] +
           "\"]\ncoefficient = " + r + "\n";
  };
  EXPECT_THAT(fault(text + pair(0, 1, "0.9") + pair(1, 2, "0.9") + pair(0, 2, "-0.9")),
              HasSubstr("not positive definite"));
}

}  // namespace random_inputs_test
}  // namespace boresight
