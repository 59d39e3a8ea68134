// Evaluations: common random numbers, paid for once, kept over a restart.
#include "boresight_analyses/optimise/design_evaluator.hpp"

#include <gmock/gmock.h>

#include <cmath>

#include "boresight/mechanism/error.hpp"
#include "boresight_analyses/optimise/measure.hpp"

namespace boresight {
namespace design_evaluator_test {

// value = design + random part; fails where the design is negative.
class Sum final : public SampleModel {
 public:
  std::string rung() const override { return "sum"; }
  double step() const override { return 0.0; }
  std::string leaves_out() const override { return ""; }
  std::size_t batch() const override { return 3; }
  void evaluate(std::span<const Sample> samples, std::span<Outcome> outcomes, const std::atomic<bool>&) const override {
    calls += static_cast<int>(samples.size());
    for (std::size_t k = 0; k < samples.size(); ++k) {
      const auto& v = samples[k].values;
      outcomes[k].status = v[0] < 0 ? Outcome::Status::failed : Outcome::Status::done;
      if (v[0] >= 0) outcomes[k].value = v[0] + (v.size() > 1 ? v[1] : 0.0);
      outcomes[k].motion = {.free_flight_share = 0.1 * v[0], .impacts_per_second = 2.0, .peak_acceleration = 3.0};
    }
  }
  mutable std::atomic<int> calls{0};
};

RandomInputs one_uniform() {
  RandomInputs inputs;
  RandomParameter p;
  p.paths = {"x"};
  p.distribution = make_uniform(0.0, 1.0);
  inputs.parameters.push_back(p);
  return inputs;
}

struct Folder {
  std::filesystem::path path =
      std::filesystem::temp_directory_path() /
      ("boresight-evaluations-" + std::to_string(testing::UnitTest::GetInstance()->random_seed()) +
       testing::UnitTest::GetInstance()->current_test_info()->name());
  Folder() { std::filesystem::create_directories(path); }
  ~Folder() { std::filesystem::remove_all(path); }
};

TEST(DesignEvaluator, DrawsTheSameNumbersForEveryDesign) {
  const Sum model;
  const RandomInputs inputs = one_uniform();
  DesignEvaluator evaluator(model, &inputs, nullptr, {.samples = 20, .seed = 3, .jobs = 2});
  const std::vector<Outcome> a = evaluator.at(std::vector<double>{1.0}), b = evaluator.at(std::vector<double>{4.0});
  ASSERT_EQ(a.size(), 20U);
  for (std::size_t k = 0; k < a.size(); ++k) EXPECT_NEAR(b[k].value - a[k].value, 3.0, 1e-12);
  EXPECT_NE(a[0].value, a[1].value);
}

TEST(DesignEvaluator, ReusesWhatAnEarlierRunPaidFor) {
  const Folder folder;
  const Sum model;
  const RandomInputs inputs = one_uniform();
  const std::map<std::string, std::string> facts = {{"study", "a"}};
  std::vector<Outcome> first;
  {
    EvaluationStore store(folder.path / "evaluations.db", facts, {"d"}, "sum", 0.0);
    DesignEvaluator evaluator(model, &inputs, &store, {.samples = 7});
    first = evaluator.at(std::vector<double>{2.0});
    evaluator.at(std::vector<double>{-1.0});  // failures are paid for too
  }
  EXPECT_EQ(model.calls, 14);
  EvaluationStore store(folder.path / "evaluations.db", facts, {"d"}, "sum", 0.0);
  DesignEvaluator evaluator(model, &inputs, &store, {.samples = 7});
  const std::vector<Outcome>& again = evaluator.at(std::vector<double>{2.0});
  EXPECT_EQ(evaluator.at(std::vector<double>{-1.0})[3].status, Outcome::Status::failed);
  EXPECT_EQ(model.calls, 14);
  EXPECT_EQ(evaluator.reused(), 2);
  for (std::size_t k = 0; k < first.size(); ++k) {
    EXPECT_EQ(again[k].value, first[k].value);
    EXPECT_EQ(again[k].motion.free_flight_share, first[k].motion.free_flight_share);
  }
}

TEST(EvaluationStore, RefusesAnotherStudysEvaluations) {
  const Folder folder;
  { EvaluationStore store(folder.path / "evaluations.db", {{"study", "a"}}, {"d"}, "sum", 0.0); }
  EXPECT_THROW(EvaluationStore(folder.path / "evaluations.db", {{"study", "b"}}, {"d"}, "sum", 0.0), StoreRefused);
}

TEST(MeasureChoice, SaysMeanQuantileAndWorstOfTheSamples) {
  std::vector<Outcome> outcomes(101);
  for (std::size_t k = 0; k < outcomes.size(); ++k) {
    outcomes[k].status = Outcome::Status::done;
    outcomes[k].value = static_cast<double>(k);
    outcomes[k].motion.impacts_per_second = 5.0;
  }
  EXPECT_DOUBLE_EQ((MeasureChoice{.over = Over::mean}.of(outcomes)), 50.0);
  EXPECT_DOUBLE_EQ((MeasureChoice{.over = Over::worst}.of(outcomes)), 100.0);
  EXPECT_DOUBLE_EQ((MeasureChoice{.over = Over::quantile, .probability = 0.9}.of(outcomes)), 90.0);
  EXPECT_DOUBLE_EQ((MeasureChoice{.measure = Measure::impacts_per_second}.of(outcomes)), 5.0);
  outcomes[7].status = Outcome::Status::failed;
  EXPECT_TRUE(std::isnan(MeasureChoice{.over = Over::mean}.of(outcomes)));
}

TEST(MeasureChoice, TheMeanOfAShareLiesBetweenNothingAndAll) {
  std::vector<Outcome> outcomes(2);
  const auto interval_of = [&](double first, double second) {
    for (Outcome& o : outcomes) o.status = Outcome::Status::done;
    outcomes[0].motion.free_flight_share = first;
    outcomes[1].motion.free_flight_share = second;
    return MeasureChoice{.measure = Measure::free_flight_share, .over = Over::mean}.interval(outcomes, 0.95);
  };
  EXPECT_EQ(interval_of(0.04, 0.06).low, 0.0);
  EXPECT_GT(interval_of(0.04, 0.06).high, 0.06);
  EXPECT_EQ(interval_of(0.94, 0.96).high, 1.0);
}

}  // namespace design_evaluator_test
}  // namespace boresight
