#include "boresight_analyses/montecarlo/montecarlo_plan.hpp"

#include <gmock/gmock.h>

#include "boresight/io/mechanism_file.hpp"
#include "boresight/mechanism/error.hpp"

namespace boresight {
namespace montecarlo_plan_test {

using testing::AllOf;
using testing::HasSubstr;

class MonteCarloPlanTest : public testing::Test {
 protected:
  MonteCarloPlan read(const std::string& table) const {
    Document document = Document::from_text(
        "[[random]]\nparameter = \"clearance.F1.radial\"\ndistribution = { fit = \"20 H7/g6\" }\n[montecarlo]\n" +
            table,
        "study.toml");
    Cursor root(document);
    return read_montecarlo_plan(root, Study{}, mechanism_->description(), [](const Setting&) {});
  }
  std::string fault(const std::string& table) const {
    try {
      read(table);
    } catch (const InputError& error) {
      return error.what();
    }
    return "no fault";
  }
  const std::shared_ptr<const Mechanism> mechanism_ =
      std::make_shared<const Mechanism>(read_mechanism(BORESIGHT_EXAMPLES "/3-rrcpr/3-rrcpr.toml"));
};

TEST_F(MonteCarloPlanTest, ReadsTheTableOfTheInterface) {
  const MonteCarloPlan plan = read(
      "samples = 10000\nseed = 3\ndesign = \"random\"\n"
      "requirement = { limit = \"0.25 mm\", probability = 0.9973, confidence = 0.95 }\n"
      "stop = { width = \"2 %\", of = \"p95\", time = \"2 min\" }\n");
  EXPECT_EQ(plan.samples, 10000u);
  EXPECT_EQ(plan.design.seed, 3u);
  EXPECT_NEAR(plan.requirement->limit, 2.5e-4, 1e-18);
  EXPECT_EQ(plan.requirement->probability, 0.9973);
  EXPECT_EQ(plan.stop.of, "p95");
  EXPECT_EQ(plan.stop.seconds, 120.0);
}

TEST_F(MonteCarloPlanTest, MoreSamplesOrAnotherRequirementAreTheSameStudy) {
  const std::string one = read("samples = 100\n").sample_text({});
  EXPECT_EQ(read("samples = 500\nrequirement = { limit = \"1 mm\" }\nconfidence = 0.9\n").sample_text({}), one);
  EXPECT_NE(read("samples = 100\nseed = 2\n").sample_text({}), one);
  EXPECT_NE(read("samples = 160\ndesign = \"sobol\"\n").sample_text({}), one);
}

TEST_F(MonteCarloPlanTest, TailsWhoseLimitsDifferByTheLastBitAreTwoStudies) {
  const auto text = [&](const std::string& limit) {
    return read("requirement = { limit = \"" + limit + "\" }\ntail = { budget = \"2 s\" }\n").sample_text({});
  };
  EXPECT_EQ(text("0.25 mm"), text("250 um"));
  EXPECT_NE(text("0.25 mm"), text("0.2500000001 mm"));
}

TEST_F(MonteCarloPlanTest, MistakesAreOneLineWithFileLineAndKey) {
  const auto says = [&](const std::string& table, const std::string& words) {
    EXPECT_THAT(fault(table), AllOf(HasSubstr("study.toml:"), HasSubstr("montecarlo"), HasSubstr(words))) << table;
  };
  says("seed = 1\n", "samples");
  says("samples = 0\n", "samples");
  says("samples = -5\n", "samples");
  says("samples = 1.5\n", "samples");
  says("samples = nan\n", "samples");
  says("samples = 5000000000\n", "samples");
  says("samples = 100\nsede = 1\n", "did you mean seed?");
  says("samples = 100\nseed = -1\n", "seed");
  says("samples = 100\ndesign = \"sobel\"\n", "did you mean sobol?");
  says("samples = 150\ndesign = \"lhs\"\n", "a multiple of strata (100), at least twice: 200");
  says("samples = 1001\ndesign = \"sobol\"\n", "a multiple of replicates (16), at least twice: 1008");
  says("samples = 100\nstrata = 10\n", "design = \"lhs\"");
  says("samples = 100\nreplicates = 10\n", "design = \"sobol\"");
  says("samples = 100\nconfidence = 1\n", "confidence");
  says("samples = 100\nconfidence = inf\n", "confidence");
  says("samples = 100\nrequirement = { probability = 0.9 }\n", "limit");
  says("samples = 100\nrequirement = { limit = \"0.25 rad\" }\n", "limit");
  says("samples = 100\nrequirement = { limit = \"-1 mm\" }\n", "more than 0");
  says("samples = 100\nrequirement = { limit = \"1 mm\", probability = 1.5 }\n", "probability");
  says("samples = 100\nrequirement = { limit = \"1 mm\", confidence = 0.4 }\n", "more than 0.5");
  says("samples = 100\nstop = { of = \"p95\" }\n", "width, or time, or both");
  says("samples = 100\nstop = { width = \"2 %\", of = \"p98\" }\n", "of");
  says("samples = 100\nstop = { time = \"-1 s\" }\n", "more than 0");
}

TEST_F(MonteCarloPlanTest, StopsByWidthAloneOrByTimeAlone) {
  const StopRule width = read("samples = 100\nstop = { width = \"2 %\" }\n").stop,
                 time = read("samples = 100\nstop = { time = \"0.5 s\" }\n").stop;
  EXPECT_NEAR(width.width, 0.02, 1e-15);
  EXPECT_EQ(width.seconds, 0.0);
  EXPECT_EQ(time.width, 0.0);
  EXPECT_EQ(time.seconds, 0.5);
}

}  // namespace montecarlo_plan_test
}  // namespace boresight
