// A budget from histories that are known: a mechanism whose error is its clearance times a shape in time.
#include "boresight_analyses/budget/budget.hpp"

#include <gmock/gmock.h>
#include <unistd.h>

#include <cmath>
#include <numeric>

#include "boresight/io/mechanism_file.hpp"
#include "boresight/mechanism/error.hpp"

namespace boresight {
namespace budget_test {

constexpr double kNominal = 1e-4;  // median of the clearance [m]

class BudgetTest : public testing::Test {
 protected:
  void SetUp() override { std::filesystem::create_directories(folder_); }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  BudgetPlan read(const std::string& table) const {
    Document document = Document::from_text(
        "[[random]]\nparameter = \"clearance.F1.radial\"\ndistribution = { uniform = { min = \"0.05 mm\", max = \"0.15 "
        "mm\" } }\n"
        "[budget]\nmembers = 60\nattribution = 60\nsampling = \"10 ms\"\n" +
            table,
        "study.toml");
    Cursor root(document);
    Study study;
    study.index.quantity = "boresight_error";
    return read_budget_plan(root, study, mechanism_->description(), mechanism_->duration(), [](const Setting&) {});
  }

  // x: constant, y: one period of a sine; per metre of clearance.
  static Vec3 shape(double t) { return {10.0, 20.0 * std::sin(2.0 * M_PI * t), 0.0}; }

  // Stores every run of the plan but those members' that fail.
  void store_runs_of(const BudgetPlan& plan, const BudgetRuns& runs, SampleStore& store,
                     std::uint64_t failing = 0) const {
    for (const NumberRange& range : runs.missing(store))
      for (std::uint64_t number = range.first; number < range.end; ++number) {
        SampleRecord record{.number = number, .inputs = {0.0}, .outcome = {}};
        runs.values(number, record.inputs);
        const BudgetRuns::Variant v = runs.variant(number);
        const double clearance = record.inputs[0] * (v.halved >= 0 ? 0.5 : 1.0);
        const bool fails = !v.nominal && v.member < failing;
        record.outcome.status = fails ? Outcome::Status::failed : Outcome::Status::done;
        for (double t = 0.0; !fails && t < plan.duration - 0.5 * plan.sampling; t += plan.sampling) {
          const Vec3 e = clearance * shape(t);
          record.outcome.history.insert(record.outcome.history.end(), e.data(), e.data() + 3);
        }
        store.add(record);
      }
    store.commit();
  }
  Budget budget(const std::string& table, std::uint64_t failing = 0) const {
    const BudgetPlan plan = read(table);
    const BudgetRuns runs(plan, *mechanism_);
    std::filesystem::remove_all(folder_ / "samples.db");
    SampleStore store(folder_ / "samples.db", {{"study", "test"}}, {"clearance.F1.radial"});
    store_runs_of(plan, runs, store, failing);
    EXPECT_TRUE(runs.missing(store).empty());
    Budget b = budget_of(plan, runs, *mechanism_, PointingQuantity::boresight_error, store);
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
    return b;
  }
  static const BudgetLevel& level(const Budget& b, ErrorIndex index, Interpretation interpretation, std::size_t axis) {
    return *std::find_if(b.levels.begin(), b.levels.end(), [&](const BudgetLevel& l) {
      return l.index == index && l.interpretation == interpretation && l.axis == axis;
    });
  }

  const std::filesystem::path folder_ =
      std::filesystem::temp_directory_path() / ("boresight-budget-" + std::to_string(::getpid()));
  const std::shared_ptr<const Mechanism> mechanism_ =
      std::make_shared<const Mechanism>(read_mechanism(BORESIGHT_EXAMPLES "/3-rrcpr/3-rrcpr.toml"));
};

TEST_F(BudgetTest, LevelsAreThoseOfTheHistories) {
  const Budget b = budget("");
  // The clearance is uniform from 0.05 to 0.15 mm: x in all interpretations is ten times it, constant in time.
  EXPECT_NEAR(level(b, ErrorIndex::ape, Interpretation::ensemble, 0).level.value, 10 * 1.45e-4, 1e-4);
  EXPECT_NEAR(level(b, ErrorIndex::ape, Interpretation::temporal, 1).level.value, 20 * 1.5e-4 * std::sin(0.475 * M_PI),
              1e-4);
  const BudgetLevel& cone = level(b, ErrorIndex::ape, Interpretation::ensemble, 2);
  EXPECT_NEAR(cone.level.value, std::hypot(10.0, 20.0) * 1.45e-4, 2e-4);
  // A mean across: the rule for half cones looks past it.
  EXPECT_EQ(level(b, ErrorIndex::ape, Interpretation::mixed, 2).standing, RuleStanding::unsafe);
}

TEST_F(BudgetTest, SharesAddUpToOneAndAreTheOnesOfTheHistories) {
  const Budget b = budget(R"(
[[budget.contributor]]
name = "bias"
class = "bias"
axes = ["y"]
value = "1 mrad"
)");
  double sum = 0.0;
  std::map<std::string, double> made;  // mean square
  for (const Contribution& c : b.contributions) {
    sum += c.share;
    made[c.name] = c.share * b.mean_square;
  }
  EXPECT_NEAR(sum, 1.0, 1e-12);
  // The shape's mean square is 100 + 400 / 2. Over whole periods the bias and the sine do not meet.
  const BudgetPlan plan = read("");
  const BudgetRuns runs(plan, *mechanism_);
  double drawn = 0.0;
  for (std::uint64_t member = 0; member < runs.rows(); ++member) {
    double clearance = 0.0;
    runs.values(runs.drawn(member), {&clearance, 1});
    drawn += clearance * clearance / static_cast<double>(runs.rows());
  }
  EXPECT_NEAR(made["F1"], 300.0 * kNominal * kNominal, 1e-15);
  EXPECT_NEAR(made["clearance.F1.radial"], 300.0 * (drawn - kNominal * kNominal), 1e-15);
  EXPECT_NEAR(made["bias"], 1e-6, 1e-15);
  EXPECT_NEAR(made["together"], 0.0, 1e-15);
}

TEST_F(BudgetTest, HalvingTheClearanceIsWhatTakesOffMostAndTakesOffHalf) {
  const Budget b = budget("");
  ASSERT_EQ(b.reductions.size(), 2u);
  EXPECT_EQ(b.reductions[0].name, "F1");
  EXPECT_NEAR(b.reductions[0].after, 0.5 * b.reductions[0].before, 1e-12);
  EXPECT_EQ(b.reductions[1].name, "clearance.F1.radial");
  EXPECT_GT(b.reductions[1].gain(), 0.0);
}

TEST_F(BudgetTest, IndicesOfAConstantAxisVanishWhereItsMeanIsTakenOff) {
  const Budget b = budget("window = \"0.1 s\"\nseparation = \"0.3 s\"\n");
  EXPECT_LT(level(b, ErrorIndex::rpe, Interpretation::ensemble, 0).level.value, 1e-15);
  EXPECT_LT(level(b, ErrorIndex::pde, Interpretation::ensemble, 0).level.value, 1e-15);
  EXPECT_NEAR(level(b, ErrorIndex::mpe, Interpretation::mixed, 0).level.value,
              level(b, ErrorIndex::ape, Interpretation::mixed, 0).level.value, 1e-12);
  // A sinusoid's PDE: twice the sine of half the separation's phase, times the mean's filter.
  const double kept = std::sqrt(kept_of_sinusoid(ErrorIndex::pde, 2.0 * M_PI, {.window = 0.1, .separation = 0.3}));
  EXPECT_NEAR(level(b, ErrorIndex::pde, Interpretation::ensemble, 1).level.value, kept * 20 * 1.45e-4, 1e-4);
}

TEST_F(BudgetTest, RequirementsAreAnsweredInTheirOrderAndAFailedMemberIsBad) {
  const std::string asked = R"(
[[budget.requirement]]
axis = "y"
interpretation = "ensemble"
limit = "1 mrad"
probability = 0.9
[[budget.requirement]]
axis = "x"
interpretation = "ensemble"
limit = "1.6 mrad"
probability = 0.9
)";
  const Budget b = budget(asked);
  ASSERT_EQ(b.requirements.size(), 2u);
  EXPECT_FALSE(b.requirements[0].compliance.met);
  EXPECT_LT(b.requirements[0].margin(), 0.0);
  EXPECT_TRUE(b.requirements[1].compliance.met);
  EXPECT_FALSE(b.met());
  const Budget failed = budget(asked, 10);
  EXPECT_EQ(failed.failed, 10);
  EXPECT_FALSE(failed.requirements[1].compliance.met);
  EXPECT_THROW(budget(asked, 60), ComputationError);
}

TEST_F(BudgetTest, ClassicalLinesHoldTheMomentsOfTheHistories) {
  const Budget b = budget("");
  const auto table = std::find_if(b.tables.begin(), b.tables.end(), [](const ClassicalTable& t) {
    return t.index == ErrorIndex::ape && t.interpretation == Interpretation::mixed;
  });
  ASSERT_EQ(table->lines.size(), 2u);
  EXPECT_NEAR(table->lines[0].axes[0].mean, 10 * kNominal, 1e-12);
  EXPECT_NEAR(table->lines[0].axes[0].sd, 0.0, 1e-12);
  EXPECT_NEAR(table->lines[0].axes[1].sd, 20 * kNominal / std::sqrt(2.0), 1e-12);
  EXPECT_NEAR(table->lines[1].axes[0].sd, 10 * 1e-4 / std::sqrt(12.0), 3e-5);
}

TEST_F(BudgetTest, RunsHaveNumbersThatStayWhenMembersAreAdded) {
  const BudgetPlan few = read(""), many = read("groups = {}\n");
  const BudgetRuns runs(few, *mechanism_);
  EXPECT_EQ(runs.count(), 1u + 60u * 3u);
  EXPECT_EQ(runs.variant(runs.held(7, 0)).group, 0);
  EXPECT_EQ(runs.variant(runs.halved(7, 0)).halved, 0);
  EXPECT_EQ(runs.variant(runs.drawn(7)).member, 7u);
  EXPECT_TRUE(runs.variant(runs.nominal()).nominal);
  EXPECT_EQ(BudgetRuns(many, *mechanism_).drawn(59), runs.drawn(59));
}

}  // namespace budget_test
}  // namespace boresight
