// Standing errors in a budget, against closed forms: a mirror on one driven axis that turns at a constant rate, whose boresight is
// off by what its drive is off by.
#include <gmock/gmock.h>
#include <unistd.h>

#include <cmath>

#include "boresight/io/mechanism_file.hpp"
#include "boresight_analyses/budget/budget.hpp"

namespace boresight {
namespace {

constexpr double kOffset = 2e-4, kRipple = 3e-4;  // [rad], at their largest

constexpr const char* kMirror = R"toml(
format = 1
gravity = ["0 m/s^2", "0 m/s^2", "0 m/s^2"]
[[body]]
name = "mirror"
mass = "1 kg"
center_of_mass = ["0 mm", "0 mm", "0 mm"]
inertia = ["0.01 kg m^2", "0.01 kg m^2", "0.01 kg m^2"]
boresight = [0, 0, 1]
[[joint]]
name = "Y"
type = "revolute"
connects = ["ground", "mirror"]
point = ["0 mm", "0 mm", "0 mm"]
axis = [0, 1, 0]
driven = true
[[error]]
name = "offset"
drive = "Y"
[[error]]
name = "ripple"
drive = "Y"
law = "sin(10*pi*q)"
[[error]]
name = "seat"
joint = "Y"
body = "ground"
translation = [1, 0, 0]
[motion]
duration = "1 s"
drives = { Y = "t" }
)toml";

class BudgetOfErrors : public testing::Test {
 protected:
  // Of these errors, each between minus and plus its largest value with two values alone, so that every square is known.
  Budget budget(const std::vector<std::pair<std::string, std::string>>& drawn) const {
    std::string study;
    for (const auto& [path, value] : drawn)
      study += "[[random]]\nparameter = \"" + path + "\"\ndistribution = { discrete = { values = [\"-" + value +
               "\", \"" + value + "\"] } }\n";
    study += "[budget]\nmembers = 40\nattribution = 12\nsampling = \"1 ms\"\nwindow = \"0.2 s\"\n";
    Document document = Document::from_text(study, "study.toml");
    Cursor root(document);
    Study of;
    of.index.quantity = "boresight_error";
    const BudgetPlan plan =
        read_budget_plan(root, of, mechanism_->description(), mechanism_->duration(), [](const Setting&) {});
    const BudgetRuns runs(plan, *mechanism_);
    const BudgetModel model("multibody", mechanism_, plan, runs, {"boresight_error", "max"}, {}, false);
    const std::filesystem::path folder =
        std::filesystem::temp_directory_path() / ("boresight-budget-errors-" + std::to_string(::getpid()));
    std::filesystem::create_directories(folder);
    std::vector<std::string> names;
    for (const auto& [path, value] : drawn) names.push_back(path);
    SampleStore store(folder / "samples.db", {{"study", "test"}}, names);
    for (const NumberRange& range : runs.missing(store))
      for (std::uint64_t number = range.first; number < range.end; ++number) {
        SampleRecord record{.number = number, .inputs = std::vector<double>(drawn.size()), .outcome = {}};
        runs.values(number, record.inputs);
        const Sample sample{number, record.inputs};
        model.evaluate({&sample, 1}, {&record.outcome, 1}, std::atomic<bool>{false});
        EXPECT_EQ(record.outcome.status, Outcome::Status::done) << record.outcome.message;
        store.add(record);
      }
    store.commit();
    Budget b = budget_of(plan, runs, *mechanism_, PointingQuantity::boresight_error, store);
    std::filesystem::remove_all(folder);
    return b;
  }

  // Of the half cone, of the worst member at all its times but five in a hundred.
  static double mixed(const Budget& b, ErrorIndex index) {
    for (const BudgetLevel& l : b.levels)
      if (l.index == index && l.interpretation == Interpretation::mixed && l.axis == 2) return l.level.value;
    return -1.0;
  }
  static const ClassicalLine& line(const Budget& b, ErrorIndex index, std::size_t number) {
    for (const ClassicalTable& t : b.tables)
      if (t.index == index && t.interpretation == Interpretation::mixed) return t.lines.at(number);
    throw std::out_of_range("no such table");
  }

  const std::shared_ptr<const Mechanism> mechanism_ =
      std::make_shared<const Mechanism>(read_mechanism_text(kMirror, "mirror.toml"));
};

TEST_F(BudgetOfErrors, AConstantOffsetIsInApeAndMpeAndNotInRpe) {
  const Budget b = budget({{"error.offset", "0.2 mrad"}});
  EXPECT_NEAR(mixed(b, ErrorIndex::ape), kOffset, 1e-6 * kOffset);
  EXPECT_NEAR(mixed(b, ErrorIndex::mpe), kOffset, 1e-6 * kOffset);
  EXPECT_LT(mixed(b, ErrorIndex::rpe), 1e-6 * kOffset);
  ASSERT_EQ(b.contributions.size(), 1u);
  EXPECT_EQ(b.contributions[0].kind, kDriveKind);
  EXPECT_NEAR(b.contributions[0].share, 1.0, 1e-9);
}

// sin(10 pi t): a window of 0.2 s is one period. Its mean is nothing, what is left is the sinusoid: 95 % of the time below
// sin(0.95 pi / 2) of its amplitude, its square half of that of the amplitude.
TEST_F(BudgetOfErrors, ARippleOfTheDriveIsInRpeAsASinusoidAndNotInMpe) {
  const Budget b = budget({{"error.ripple", "0.3 mrad"}});
  EXPECT_NEAR(mixed(b, ErrorIndex::rpe), kRipple * std::sin(0.95 * M_PI / 2.0), 2e-3 * kRipple);
  EXPECT_LT(mixed(b, ErrorIndex::mpe), 1e-3 * kRipple);
  const std::vector<Moments>& axes = line(b, ErrorIndex::rpe, 0).axes;
  EXPECT_NEAR(std::hypot(axes.at(0).sd, axes.at(1).sd), kRipple / std::sqrt(2.0), 2e-3 * kRipple);
}

TEST_F(BudgetOfErrors, SharesAreThoseOfTheMeanSquaresAndAddUpWhicheverMembersAreAttributed) {
  const Budget b = budget({{"error.offset", "0.2 mrad"}, {"error.ripple", "0.3 mrad"}, {"error.seat", "1 mm"}});
  ASSERT_EQ(b.contributions.size(), 3u);
  const double offset = kOffset * kOffset, ripple = 0.5 * kRipple * kRipple;
  // The product of offset and ripple is nothing over whole periods.
  EXPECT_NEAR(b.contributions[0].share, offset / (offset + ripple), 5e-3);
  EXPECT_NEAR(b.contributions[1].share, ripple / (offset + ripple), 5e-3);
  EXPECT_NEAR(b.contributions[2].share, 0.0, 1e-9);
  EXPECT_EQ(b.contributions[2].kind, kGeometryKind);
  EXPECT_NEAR(b.contributions[0].share + b.contributions[1].share, 1.0, 1e-6);
}

}  // namespace
}  // namespace boresight
