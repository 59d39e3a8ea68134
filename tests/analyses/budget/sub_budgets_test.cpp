// Sub-budgets and jitter by exposure time, in budgets of external errors alone whose sums are known.
#include "boresight_analyses/budget/sub_budgets.hpp"

#include <gtest/gtest.h>

#include <boost/math/special_functions/erf.hpp>
#include <cmath>

#include "budget/made_budget.hpp"

namespace boresight {
namespace sub_budgets_test {

const double kArcsec = M_PI / 180.0 / 3600.0;

std::shared_ptr<const Mechanism> mirror() {
  return std::make_shared<const Mechanism>(read_mechanism_text(kMirror, "mirror.toml"));
}

std::string noise(const std::string& name, const std::string& sd) {
  return "[[budget.contributor]]\nname = \"" + name + "\"\nclass = \"random\"\nvalue = \"" + sd +
         "\"\naxes = [\"x\"]\n";
}

// Noise of 3, 4 and 12 arcsec on one axis: parts of 5 and 13 arcsec, mixed, at 95 %.
TEST(SubBudgets, RollUpWhatTheyHoldAddedInTime) {
  const MadeBudget made = make_budget(mirror(), R"([budget]
members = 60
sampling = "1 ms"
[[budget.requirement]]
axis = "x"
limit = "40 arcsec"
[[budget.part]]
name = "attitude"
within = "all"
contributors = ["a", "b"]
allocated = "11 arcsec"
[[budget.part]]
name = "all"
allocated = "26 arcsec"
[[budget.part]]
name = "rest"
within = "all"
contributors = ["c"]
mechanism = true
allocated = "20 arcsec"
)" + noise("a", "3 arcsec") + noise("b", "4 arcsec") +
                                                    noise("c", "12 arcsec"));
  const std::vector<SubBudget>& parts = made.budget.parts;
  ASSERT_EQ(parts.size(), 3u);
  EXPECT_EQ(parts[0].name, "all");
  EXPECT_EQ(parts[1].name, "attitude");
  EXPECT_EQ(parts[2].name, "rest");
  EXPECT_EQ(parts[1].depth, 1);
  EXPECT_EQ(parts[0].holds, (std::vector<std::string>{"mechanism", "a", "b", "c"}));
  const double at95 = std::sqrt(2.0) * boost::math::erf_inv(0.95);
  const double sd[] = {13.0, 5.0, 12.0};
  for (int k = 0; k < 3; ++k) {
    // 60,000 independent values: the quantile scatters by half a per cent.
    EXPECT_NEAR(parts[std::size_t(k)].level.value, at95 * sd[k] * kArcsec, 0.02 * at95 * sd[k] * kArcsec) << k;
    EXPECT_NEAR(parts[std::size_t(k)].by_rule, 2.0 * sd[k] * kArcsec, 1e-6 * sd[k] * kArcsec) << k;
  }
  // The whole is the headline's own level.
  EXPECT_NEAR(parts[0].level.value, mixed_level(made.budget, ErrorIndex::ape, 0), 1e-15);
  EXPECT_NEAR(parts[0].parts_root_sum_square, std::hypot(11.0, 20.0) * kArcsec, 1e-12);
  EXPECT_NEAR(parts[0].parts_sum, 31.0 * kArcsec, 1e-12);
  EXPECT_FALSE(parts[2].compliance.met);  // 23.5 of 20
  EXPECT_GT(parts[1].compliance.share, 0.95);
}

// Of noise of first order, r its correlation from one sample to the next, the mean of n samples keeps (n + 2 sum of (n - d) r^d) / n^2 of the
// variance, d from 1 to n - 1, and RPE over them the rest.
double kept_by_rpe(double samples) {
  const double r = std::exp(-1.0);  // its correlation time is one sample, where nothing else is said
  double sum = samples;
  for (double d = 1.0; d < samples; d += 1.0) sum += 2.0 * (samples - d) * std::pow(r, d);
  return 1.0 - sum / (samples * samples);
}

TEST(Jitter, ByExposureTimeIsThatOfEachWindowItself) {
  const MadeBudget made = make_budget(mirror(), R"([budget]
members = 60
sampling = "1 ms"
[[budget.requirement]]
index = "RPE"
axis = "x"
exposures = ["2 ms", "10 ms", "0.5 s"]
limits = ["12 arcsec", "17 arcsec", "30 arcsec"]
)" + noise("c", "10 arcsec"));
  const double at95 = std::sqrt(2.0) * boost::math::erf_inv(0.95) * 10.0 * kArcsec;
  ASSERT_EQ(made.budget.requirements.size(), 3u);
  const double samples[] = {2.0, 10.0, 500.0};
  for (int k = 0; k < 3; ++k) {
    const RequirementAnswer& r = made.budget.requirements[std::size_t(k)];
    EXPECT_NEAR(r.level.level.value / (at95 * std::sqrt(kept_by_rpe(samples[k]))), 1.0, 0.02) << k;
  }
  EXPECT_GT(made.budget.requirements[0].compliance.share, 0.95);
  EXPECT_LT(made.budget.requirements[1].compliance.share, 0.95);
  EXPECT_TRUE(made.budget.requirements[2].compliance.met);
  EXPECT_FALSE(made.budget.met());
  ASSERT_EQ(made.budget.jitter.size(), 1u);
  const JitterCurve& curve = made.budget.jitter[0];
  EXPECT_EQ(curve.exposure.front(), 0.002);
  EXPECT_NEAR(curve.exposure.back(), 1.0, 1e-9);
  EXPECT_GT(curve.exposure.size(), 10u);
  for (std::size_t k = 0; k < curve.exposure.size(); ++k)
    EXPECT_NEAR(curve.level[k].value / (at95 * std::sqrt(kept_by_rpe(std::round(curve.exposure[k] / 0.001)))), 1.0,
                0.02);
}

}  // namespace sub_budgets_test
}  // namespace boresight
