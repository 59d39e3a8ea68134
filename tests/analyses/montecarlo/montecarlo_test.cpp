#include "boresight_analyses/montecarlo/montecarlo.hpp"

#include <gmock/gmock.h>

#include <cmath>

#include "boresight/rungs/run_result.hpp"
#include "boresight_analyses/montecarlo/estimates.hpp"
#include "closed_form.hpp"

namespace boresight {
namespace montecarlo_test {

const double kSd = std::sqrt(2.0);

TEST(MonteCarlo, ThreadsAndBatchesChangeNoBit) {
  std::vector<std::vector<double>> all;
  for (const auto& [jobs, batch] : {std::pair{1, 1}, std::pair{2, 1}, std::pair{3, 8}}) {
    const Folder folder("threads");
    auto store = open_sum_store(folder);
    const SumModel model(1e300, static_cast<std::size_t>(batch));
    const MonteCarloResult result = run_sum(model, sum_plan(2000), *store, folder, jobs);
    EXPECT_EQ(result.ended, Ended::samples);
    EXPECT_EQ(model.evaluated, 2000u);
    all.push_back(result.values);
  }
  ASSERT_EQ(all[0].size(), 2000u);
  EXPECT_EQ(all[0], all[1]);
  EXPECT_EQ(all[0], all[2]);
}

TEST(MonteCarlo, GoingOnWithMoreSamplesGivesTheBitsOfOneLongRun) {
  for (const SamplingKind kind : {SamplingKind::random, SamplingKind::lhs, SamplingKind::sobol}) {
    const Folder folder("more"), once("once");
    auto store = open_sum_store(folder), whole = open_sum_store(once);
    const SumModel model;
    run_sum(model, sum_plan(800, kind), *store, folder);
    const MonteCarloResult more = run_sum(model, sum_plan(2400, kind), *store, folder, 2);
    EXPECT_EQ(model.evaluated, 2400u) << "none is computed twice";
    EXPECT_EQ(more.values, run_sum(SumModel(), sum_plan(2400, kind), *whole, once).values);
  }
}

TEST(MonteCarlo, AnInterruptionLosesNothingAndIsResumedToTheSameBits) {
  const Folder folder("interrupted"), once("uninterrupted");
  auto store = open_sum_store(folder), whole = open_sum_store(once);
  class Slow final : public SampleModel {
   public:
    std::string rung() const override { return "sum"; }
    double step() const override { return 0.0; }
    std::string leaves_out() const override { return ""; }
    std::size_t batch() const override { return 5; }
    void evaluate(std::span<const Sample> samples, std::span<Outcome> outcomes,
                  const std::atomic<bool>& stop) const override {
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
      model_.evaluate(samples, outcomes, stop);
    }
    SumModel model_;
  } slow;
  const auto start = std::chrono::steady_clock::now();
  const MonteCarloResult cut = run_sum(slow, sum_plan(3000), *store, folder, 2, [&] {
    return std::chrono::steady_clock::now() - start > std::chrono::milliseconds(150);
  });
  EXPECT_EQ(cut.ended, Ended::interrupted);
  EXPECT_EQ(cut.stored, slow.model_.evaluated);
  EXPECT_LT(cut.stored, 3000u);
  const MonteCarloResult rest = run_sum(SumModel(), sum_plan(3000), *store, folder, 2);
  EXPECT_EQ(rest.values, run_sum(SumModel(), sum_plan(3000), *whole, once).values);
}

// One sample of a batch after the other, each in its time, as lanes give them.
class OneByOne final : public SampleModel {
 public:
  explicit OneByOne(std::chrono::milliseconds each) : each_(each) {}
  std::string rung() const override { return "sum"; }
  double step() const override { return 0.0; }
  std::string leaves_out() const override { return ""; }
  std::size_t batch() const override { return 1024; }
  void evaluate(std::span<const Sample> samples, std::span<Outcome> outcomes,
                const std::atomic<bool>& stop) const override {
    evaluate_each(samples, outcomes, stop, [](std::size_t) {});
  }
  void evaluate_each(std::span<const Sample> samples, std::span<Outcome> outcomes, const std::atomic<bool>& stop,
                     const std::function<void(std::size_t)>& reached) const override {
    for (std::size_t k = 0; k < samples.size() && !stop; ++k) {
      std::this_thread::sleep_for(each_);
      model_.evaluate(samples.subspan(k, 1), outcomes.subspan(k, 1), stop);
      if (outcomes[k].status != Outcome::Status::not_reached) reached(k);
    }
  }

 private:
  std::chrono::milliseconds each_;
  SumModel model_;
};

TEST(MonteCarlo, SamplesThatTakeLongAreStoredSoonAfterEachIsDoneNotWithTheirBatch) {
  const Folder folder("soon");
  auto store = open_sum_store(folder);
  const auto start = std::chrono::steady_clock::now();
  // A batch of these takes half a minute.
  const MonteCarloResult cut =
      run_sum(OneByOne(std::chrono::milliseconds(150)), sum_plan(4096), *store, folder, 1,
              [&] { return std::chrono::steady_clock::now() - start > std::chrono::milliseconds(1000); });
  const double took = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  EXPECT_EQ(cut.ended, Ended::interrupted);
  EXPECT_GE(cut.stored, 3u);
  EXPECT_LT(took, 3.0);
}

TEST(MonteCarlo, StopsAtTheSameSampleOnAnIntervalsWidthWhateverTheThreads) {
  std::vector<std::size_t> sizes;
  for (const int jobs : {1, 2}) {
    const Folder folder("width");
    auto store = open_sum_store(folder);
    MonteCarloPlan plan = sum_plan(100000);
    plan.stop = {.width = 0.01, .of = "mean", .seconds = 0.0};
    const MonteCarloResult result = run_sum(SumModel(), plan, *store, folder, jobs);
    EXPECT_EQ(result.ended, Ended::width);
    sizes.push_back(result.values.size());
  }
  EXPECT_EQ(sizes[0], sizes[1]);
  // Judged at 200, 300, 450, 675, 1013, 1520, 2280, ...: at 17 numbers of samples up to 100000, so that 2.97 standard errors
  // leave a risk of 5 % in all; 2.97 sqrt(2) / sqrt(n) = 0.1 at n = 1764.
  EXPECT_EQ(sizes[0], 2280u);
}

TEST(MonteCarlo, StopsOnTimeWithoutHoles) {
  const Folder folder("time");
  auto store = open_sum_store(folder);
  MonteCarloPlan plan = sum_plan(4'000'000);
  plan.stop.seconds = 0.2;
  const MonteCarloResult result = run_sum(SumModel(), plan, *store, folder, 2);
  EXPECT_EQ(result.ended, Ended::time);
  EXPECT_EQ(result.values.size(), result.stored);
  EXPECT_GT(result.stored, 0u);
}

TEST(Estimates, FindTheKnownDistributionWithEveryDesign) {
  for (const SamplingKind kind : {SamplingKind::random, SamplingKind::lhs, SamplingKind::sobol}) {
    const Folder folder("estimates");
    auto store = open_sum_store(folder);
    MonteCarloPlan plan = sum_plan(8192 / 16 * 16, kind);
    if (kind == SamplingKind::lhs) plan.samples = 8200;
    plan.requirement = Requirement{10.0 + 2.0 * kSd, 0.97, 0.95};  // Phi(2) = 0.97725
    const MonteCarloResult result = run_sum(SumModel(), plan, *store, folder, 2);
    const Estimates e = estimate(result.values, plan, {});
    const double truth[] = {10.0, kSd, 10.0, 10.0 + 1.6448536 * kSd, 10.0 + 2.3263479 * kSd, 10.0 + 2.7821504 * kSd};
    for (std::size_t k = 0; k < headlines().size(); ++k) {
      const ReportedInterval& i = e.index[k].interval;
      // Four times the interval: a chance of 1e-12 where the interval holds its 95 %.
      EXPECT_NEAR(i.value, truth[k], 2.0 * (i.high - i.low)) << to_string(kind) << " " << e.index[k].name;
      EXPECT_LE(i.low, i.value);
      EXPECT_GE(i.high, i.value);
    }
    EXPECT_TRUE(e.requirement->met) << to_string(kind);
    // 0.97^n <= 0.05; 2 (1 - 0.05^(1/n)) / m <= 0.03 for n hypercubes of m = 100, and for 16 nets of m = 2^k.
    EXPECT_EQ(e.requirement->fewest_samples, kind == SamplingKind::random ? 99 : kind == SamplingKind::lhs ? 200 : 256);
    EXPECT_EQ(e.errors.size(), 6u);
    EXPECT_EQ(e.errors[0].dominant, "sampling");
    EXPECT_FALSE(e.convergence.empty());
    EXPECT_EQ(e.convergence.back().samples, plan.samples);
  }
}

TEST(Estimates, NetsNarrowTheMean) {
  const Folder a("net"), b("plain");
  auto net = open_sum_store(a), plain = open_sum_store(b);
  const MonteCarloPlan net_plan = sum_plan(4096, SamplingKind::sobol), plain_plan = sum_plan(4096);
  const auto width = [](const MonteCarloPlan& plan, const MonteCarloResult& result) {
    const ReportedInterval i = estimate(result.values, plan, {}).of("mean").interval;
    return i.high - i.low;
  };
  EXPECT_LT(20.0 * width(net_plan, run_sum(SumModel(), net_plan, *net, a)),
            width(plain_plan, run_sum(SumModel(), plain_plan, *plain, b)));
}

TEST(Estimates, FailedSamplesAreKeptAndCountAsBad) {
  const Folder folder("failed");
  auto store = open_sum_store(folder);
  MonteCarloPlan plan = sum_plan(2000);
  plan.requirement = Requirement{1000.0, 0.99, 0.95};
  const MonteCarloResult result = run_sum(SumModel(7.0), plan, *store, folder);  // 2.275 % fail
  const Estimates e = estimate(result.values, plan, {});
  EXPECT_EQ(e.samples, 2000u);
  EXPECT_NEAR(static_cast<double>(e.failed), 45.5, 3.0 * std::sqrt(45.5 * (1.0 - 0.02275)));
  EXPECT_FALSE(e.requirement->met) << "all others are within the limit";
  EXPECT_NEAR(e.requirement->probability.value, 1.0 - static_cast<double>(e.failed) / 2000.0, 1e-12);
  EXPECT_TRUE(std::isinf(e.of("p99").interval.high)) << "more fail than lie above this quantile";
  std::uint64_t failed = 0;
  store->read(2000, [&](const SampleRecord& r) {
    if (r.outcome.status != Outcome::Status::failed) return;
    ++failed;
    EXPECT_GT(r.inputs[0], 7.0);
    EXPECT_EQ(r.outcome.message, "x1 is too large");
  });
  EXPECT_EQ(failed, e.failed);
}

TEST(Estimates, TooFewSamplesGiveNoIntervalRatherThanAFalseOne) {
  for (const std::size_t n : {std::size_t{0}, std::size_t{1}, std::size_t{3}}) {
    const Estimates e = estimate(std::vector<double>(n, 1.0), sum_plan(10), {});
    EXPECT_EQ(e.index.size(), headlines().size());
    EXPECT_FALSE(std::isfinite(e.of("p99.73").interval.high));
  }
}

// The verdict is right in at least as many cases as it is sure of: a requirement that just fails is seldom "met".
TEST(Estimates, ARequirementThatIsNotMetIsRarelyShownToBe) {
  int met = 0;
  MonteCarloPlan plan = sum_plan(400);
  plan.requirement = Requirement{10.0 + 1.6448536 * kSd, 0.95, 0.9};
  constexpr int kStudies = 400;
  for (int study = 0; study < kStudies; ++study) {
    plan.design.seed = static_cast<std::uint64_t>(study);
    const SamplingDesign design(plan.design, 2);
    std::vector<double> values, x(2);
    for (std::uint64_t k = 0; k < plan.samples; ++k) {
      design.point(k, x);
      plan.inputs.values(x);
      values.push_back(x[0] + x[1]);
    }
    met += estimate(values, plan, {}).requirement->met;
  }
  EXPECT_LE(met, kStudies / 10 + 3 * 6);  // at most one in ten, and three standard deviations of the count
  EXPECT_GT(met, kStudies / 50);
}

// What the samples show holds of the rung that made them. Where it may be off by more than is left to the limit, nothing is shown of the mechanism.
TEST(Estimates, ARequirementIsNotMetByLessThanTheModelMayBeOff) {
  MonteCarloPlan plan = sum_plan(400);
  plan.requirement = Requirement{1.0, 0.95, 0.9};
  const std::vector<double> values(400, 0.95);
  const auto verdict = [&](const ModelError& model) { return *estimate(values, plan, model).requirement; };
  EXPECT_TRUE(verdict({}).met);
  EXPECT_TRUE(verdict({.discretisation = 0.01, .rung = 0.03}).met);
  const RequirementVerdict undone = verdict({.discretisation = 0.03, .rung = 0.03});
  EXPECT_FALSE(undone.met);
  EXPECT_TRUE(undone.met_by_samples);
  EXPECT_NEAR(undone.model_error, 0.06, 1e-15);
  EXPECT_EQ(undone.within_error->value, 0.0);
  EXPECT_TRUE(verdict({.discretisation = kNotMeasured, .rung = kNotMeasured}).met) << "nothing is known of the model";
  // Each sample by its own error; a few that may be off by the whole of themselves do not undo what the rest shows.
  ModelError own{.rung = 0.05};
  own.rung_of_sample.assign(400, 0.01);
  for (int k = 0; k < 5; ++k) own.rung_of_sample[static_cast<std::size_t>(80 * k)] = 10.0;
  EXPECT_TRUE(verdict(own).met);
  EXPECT_NEAR(verdict(own).within_error->value, 395.0 / 400.0, 1e-12);
  // A pilot's measure of the asked level takes the place of both.
  EXPECT_FALSE(verdict({.rung_of = {{headline_of(plan), 0.1}}}).met);
  EXPECT_TRUE(verdict({.discretisation = 0.5, .rung = 0.5, .rung_of = {{headline_of(plan), 0.001}}}).met);
}

}  // namespace montecarlo_test
}  // namespace boresight
