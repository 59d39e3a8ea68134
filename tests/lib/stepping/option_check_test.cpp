// What a rung cannot make of its options is refused in words, through the library as on the command line.
#include "boresight/rungs/option_check.hpp"

#include <gtest/gtest.h>

#include "boresight/ladder/ladder.hpp"
#include "scenes.hpp"

namespace boresight {
namespace option_check_test {

std::shared_ptr<const Mechanism> scene(const std::vector<Setting>& more = {}) {
  std::vector<Setting> settings = {{"motion.duration", "2 ms"}};
  settings.insert(settings.end(), more.begin(), more.end());
  return scenes::build(scenes::rrcpr(settings));
}

std::string refusal(const char* rung, const RunOptions& options,
                    const std::shared_ptr<const Mechanism>& mechanism = scene()) {
  try {
    make_rung(rung, mechanism)->run(mechanism->parameters(), options);
  } catch (const OptionRefused& refused) {
    return refused.what();
  }
  return "none";
}

TEST(Options, AMisspeltStabilisationIsNotTakenForBaumgarte) {
  RunOptions options;
  options.stabilisation = "projektion";
  EXPECT_EQ(refusal("multibody", options),
            "stabilisation: found \"projektion\", expected baumgarte or projection; did you mean projection?");
  EXPECT_NE(refusal("quasistatic", options), "none");
}

TEST(Options, UnknownWordsAreRefusedWithThoseThatThereAre) {
  RunOptions options;
  options.formulation = "papper";
  EXPECT_EQ(refusal("multibody", options),
            "formulation: found \"papper\", expected tree or paper; did you mean paper?");
  options = {};
  options.integrator = "generalised-alpha";
  EXPECT_EQ(refusal("multibody", options),
            "integrator: found \"generalised-alpha\", expected rk4, dopri5, rosenbrock or generalized-alpha (those of "
            "the multibody rung); did you mean "
            "generalized-alpha?");
  options.integrator = "generalized-alpha";
  EXPECT_EQ(
      refusal("perturbation", options),
      "integrator: found \"generalized-alpha\", expected rk4, dopri5 or rosenbrock (those of the perturbation rung)");
}

TEST(Options, ARungSaysWhatItDoesNotRead) {
  for (const char* rung : {"envelope", "quasistatic"})
    for (const char* option : {"step", "integrator", "tolerance", "formulation", "stabilisation"})
      EXPECT_EQ(why_unread(option, rung), std::string("the ") + rung + " rung takes no steps");
  EXPECT_EQ(why_unread("formulation", "perturbation"),
            "the perturbation rung has equations of its own; the multibody rung has formulations");
  EXPECT_NE(why_unread("stabilisation", "perturbation"), "");
  for (const char* option : {"step", "integrator", "tolerance"}) EXPECT_EQ(why_unread(option, "perturbation"), "");
  for (const char* option : {"step", "integrator", "tolerance", "formulation", "stabilisation"})
    EXPECT_EQ(why_unread(option, "multibody"), "");
}

TEST(Options, NumbersOutOfRangeAreRefused) {
  RunOptions options;
  options.step = std::nan("");
  EXPECT_NE(refusal("perturbation", options).find("step: found nan"), std::string::npos);
  options = {};
  options.baumgarte_alpha = -1.0;
  EXPECT_NE(refusal("multibody", options).find("baumgarte_alpha: found -1"), std::string::npos);
  options = {};
  options.integrator = "rosenbrock";
  options.tolerance = 2.0;
  EXPECT_NE(refusal("perturbation", options).find("tolerance: found 2"), std::string::npos);
  options.tolerance = 1.0;  // as much as the clearance itself
  EXPECT_NE(refusal("perturbation", options).find("tolerance: found 1"), std::string::npos);
}

TEST(Options, FrictionWithAStateIsRefusedToGeneralizedAlphaAlone) {
  const auto mechanism = scene({{"clearance.F1.friction.law", "lugre"}});
  for (const char* integrator : {"rk4", "dopri5", "rosenbrock"}) {
    RunOptions options;
    options.integrator = integrator;
    for (const char* rung : {"perturbation", "multibody"}) EXPECT_EQ(refusal(rung, options, mechanism), "none") << rung;
  }
  RunOptions options;
  options.integrator = "generalized-alpha";
  options.formulation = "tree";
  EXPECT_NE(refusal("multibody", options, mechanism).find("the friction of F1, LuGre's"), std::string::npos)
      << refusal("multibody", options, mechanism);
}

TEST(Options, GeneralizedAlphaIsRefusedWhereTheStateHoldsQuaternions) {
  RunOptions options;
  options.integrator = "generalized-alpha";
  options.formulation = "paper";
  EXPECT_NE(refusal("multibody", options).find("this state holds quaternions"), std::string::npos);
}

}  // namespace option_check_test
}  // namespace boresight
