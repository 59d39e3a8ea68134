// What a search asks of the distributions of its options: quantiles of fits are integrals, and a set is looked at many times.
#include <gmock/gmock.h>

#include "boresight_analyses/allocation/allocation.hpp"

namespace boresight {
namespace known_gaps_test {

constexpr double kMilli = 1e-3, kWidth = 0.005 * kMilli;

// Uniform, and counts how often it is asked.
class Asked final : public Distribution {
 public:
  Asked(double least, std::int64_t& quantiles) : own_(make_uniform(least, least + kWidth)), quantiles_(quantiles) {}
  std::string text() const override { return own_->text(); }
  double quantile(double u) const override { return ++quantiles_, own_->quantile(u); }
  double upper_quantile(double v) const override { return ++quantiles_, own_->upper_quantile(v); }
  double cdf(double x) const override { return own_->cdf(x); }
  double survival(double x) const override { return own_->survival(x); }
  double density(double x) const override { return own_->density(x); }
  double lowest() const override { return own_->lowest(); }
  double highest() const override { return own_->highest(); }
  double mean() const override { return own_->mean(); }

 private:
  DistributionPtr shared() const override { return std::make_shared<Asked>(*this); }
  DistributionPtr own_;
  std::int64_t& quantiles_;
};

TEST(KnownGaps, OfTheSearchsSamplesAreAskedOnceEachHoweverManySetsAreLookedAt) {
  constexpr int kOptions = 4, kJoints = 2;
  AllocationPlan plan;
  plan.samples = 150;
  plan.confirm = 80;
  plan.front = 6;
  plan.requirement = {2.05 * kMilli, 0.9, 0.9};
  std::int64_t quantiles = 0;
  for (int j = 0; j < kJoints; ++j) {
    AllocationEntry& joint = plan.entries.emplace_back();
    joint.paths = {"joint " + std::to_string(j)};
    for (int o = 0; o < kOptions; ++o)
      joint.options.push_back(
          {std::to_string(o), 10.0 - o - 0.1 * j, std::make_shared<Asked>(kMilli * (1.0 + 0.01 * o), quantiles)});
  }
  const LinearDeviation deviation({0.0}, {0, 0, 0}, {{1, 0, 0}, {1, 0, 0}}, "max");
  const ConfirmingModel itself = [&](const auto& gaps, const auto&) {
    std::vector<Outcome> outcomes;
    for (const auto& g : gaps) {
      Outcome& o = outcomes.emplace_back();
      o.status = Outcome::Status::done;
      o.value = deviation.index(g);
    }
    return outcomes;
  };
  const AllocationResult found = run_allocation(plan, deviation, 0.0, itself, "itself", {});
  ASSERT_TRUE(found.feasible);
  EXPECT_EQ(found.front.size(), 7u);
  const auto once = static_cast<std::int64_t>(plan.samples) * kOptions * kJoints;
  const auto fresh = static_cast<std::int64_t>(plan.confirm * found.confirmations.size()) * kJoints;
  EXPECT_EQ(quantiles, once + fresh);
}

}  // namespace known_gaps_test
}  // namespace boresight
