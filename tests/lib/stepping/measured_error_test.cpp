// What a run says of its steps, against steps of a half and a quarter.
#include "boresight/stepping/measured_error.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdio>

#include "boresight/io/mechanism_file.hpp"
#include "boresight/ladder/ladder.hpp"
#include "boresight/stepping/unstable_step.hpp"
#include "finer_run.hpp"
#include "scenes.hpp"

namespace boresight {
namespace measured_error_test {

constexpr std::array kStatistics = {&Statistics::max, &Statistics::rms, &Statistics::mean, &Statistics::p9973};
constexpr std::array kStatisticNames = {"max", "rms", "mean", "p99.73"};

std::shared_ptr<const Mechanism> example(const std::string& path, const std::vector<Setting>& settings = {}) {
  return std::make_shared<const Mechanism>(read_mechanism(std::string(BORESIGHT_EXAMPLES) + "/" + path, settings));
}

RunOptions bare() {
  RunOptions options;
  options.sample_spacing = 0.0;
  options.events = false;
  return options;
}

struct Coverage {
  int asked = 0, beyond = 0;
  double worst = 0.0;  // actual over stated
};

// One scene on one rung: the error stated of a run at the rung's own step, against runs at a half and a quarter of it. A line
// per scene: what is stated of maximum and RMS of the position error, and by how much they are off.
void hold(const std::string& name, const std::string& rung_name, const std::shared_ptr<const Mechanism>& mechanism,
          Coverage& coverage) {
  const auto rung = make_rung(rung_name, mechanism);
  const RunOptions options = bare();
  const RunResult run = rung->run(mechanism->parameters(), options);
  const MeasuredError error =
      measure_discretisation(*rung, mechanism->parameters(), options, run, {.most_seconds = 0.0});
  ASSERT_TRUE(error.measured) << name << ": " << error.why_not;
  std::array<double, kStatistics.size()> off{};
  for (const double share : {0.5, 0.25}) {
    const RunResult fine = rung->run(mechanism->parameters(), finer_run(options, run, share));
    for (std::size_t k = 0; k < kStatistics.size(); ++k)
      off[k] = std::max(off[k],
                        std::abs(fine.index.position_error.*kStatistics[k] - run.index.position_error.*kStatistics[k]));
  }
  std::printf("%-44s %-12s", name.c_str(), rung_name.c_str());
  for (std::size_t k = 0; k < kStatistics.size(); ++k) {
    const double value = run.index.position_error.*kStatistics[k], stated = error.stated.position_error.*kStatistics[k];
    if (value < 1e-9) continue;
    const double ratio = off[k] / std::max(stated, 1e-300);
    ++coverage.asked;
    if (ratio > 1.0) ++coverage.beyond;
    coverage.worst = std::max(coverage.worst, ratio);
    if (k < 2)
      std::printf("  %s %7.3f %% off, %7.3f %% stated%s", kStatisticNames[k], 100.0 * off[k] / value,
                  100.0 * stated / value,
                  error.scatters(&PointingIndices::position_error, kStatistics[k]) ? " (scatters)" : "");
  }
  std::printf("\n");
  std::fflush(stdout);
}

TEST(MeasuredError, CoversHalfAndQuarterStepsOfAMotionWithImpacts) {
  Coverage coverage;
  for (const char* rung : {"perturbation", "multibody"})
    hold("3-rrcpr, 0.2 s", rung, example("3-rrcpr/3-rrcpr.toml", {{"motion.duration", "0.2 s"}}), coverage);
  hold("3-rrcpr, 0.2 s, restitution 1", "perturbation",
       example("3-rrcpr/3-rrcpr.toml", {{"motion.duration", "0.2 s"}, {"clearance.F1.contact.restitution", "1"}}),
       coverage);
  EXPECT_EQ(coverage.beyond, 0) << coverage.worst;
}

TEST(MeasuredError, IsThatOfTheMethodWhereNothingScatters) {
  // A pendulum has no clearance: its error falls with the fourth power of the step, and neighbours agree.
  const auto mechanism = example("pendulum/pendulum.toml", {{"motion.duration", "1 s"}});
  const auto rung = make_rung("multibody", mechanism);
  RunOptions options = bare();
  options.step = 0.02;
  const RunResult coarse = rung->run(mechanism->parameters(), options);
  const MeasuredError error = measure_discretisation(*rung, mechanism->parameters(), options, coarse);
  ASSERT_TRUE(error.measured) << error.why_not;
  options.step = 0.001;
  const RunResult fine = rung->run(mechanism->parameters(), options);
  const double off = std::abs(coarse.index.position_error.max - fine.index.position_error.max);
  EXPECT_GE(error.stated.position_error.max, off);
  EXPECT_LE(error.stated.position_error.max, 6.0 * off + 1e-11);
  EXPECT_FALSE(error.scatters(&PointingIndices::position_error, &Statistics::max));
}

TEST(MeasuredError, SaysSoWhereItsTimeWouldNotDo) {
  const auto mechanism = example("3-rrcpr/3-rrcpr.toml", {{"motion.duration", "10 ms"}});
  const auto rung = make_rung("perturbation", mechanism);
  const RunResult run = rung->run(mechanism->parameters(), bare());
  EXPECT_TRUE(std::isnan(run.error.discretisation));
  const MeasuredError error =
      measure_discretisation(*rung, mechanism->parameters(), bare(), run, {.most_seconds = 1e-9});
  EXPECT_FALSE(error.measured);
  EXPECT_NE(error.why_not.find("s of CPU"), std::string::npos);
  EXPECT_EQ(error.runs, 0);
}

// A rung near its largest stable step: some of the steps beside the first cannot be followed.
class OnTheEdge final : public Rung {
 public:
  explicit OnTheEdge(double followed_below) : followed_below_(followed_below) {}
  std::string name() const override { return "perturbation"; }
  std::string leaves_out() const override { return ""; }
  RunResult run(const Parameters&, const RunOptions& options) const override {
    const double step = options.step > 0.0 ? options.step : 1e-4;
    if (step < 1e-4 && step > followed_below_) throw UnstableStep("the deviation is not finite", 0.0, step);
    RunResult result;
    result.end_time = 1.0;
    result.error.discretisation = kNotMeasured;  // as rungs that take steps say
    result.cost.steps = static_cast<std::int64_t>(1.0 / step);
    result.index.position_error.max = result.index.position_error.rms = 1e-3 + step;
    return result;
  }

 private:
  double followed_below_;
};

TEST(MeasuredError, TakesTheNeighboursThatCanBeFollowed) {
  const RunResult run = OnTheEdge(1.0).run({}, {});
  const MeasuredError edge = measure_discretisation(OnTheEdge(0.96e-4), {}, {}, run);
  ASSERT_TRUE(edge.measured) << edge.why_not;
  EXPECT_GT(edge.stated.position_error.max, 0.5e-4) << "half the step moves it by as much";
}

// A rung of which every run is another draw; keeps what it gave.
class Scattering final : public Rung {
 public:
  std::string name() const override { return "perturbation"; }
  std::string leaves_out() const override { return ""; }
  RunResult run(const Parameters&, const RunOptions& options) const override {
    const double step = options.step > 0.0 ? options.step : 1e-4;
    RunResult result;
    result.end_time = 1.0;
    result.error.discretisation = kNotMeasured;
    result.cost.steps = static_cast<std::int64_t>(1.0 / step);
    result.index.position_error.max = 1e-3 * (1.0 + 0.3 * std::sin(1e7 * step + static_cast<double>(gave.size())));
    (step > 0.7e-4 ? gave : finer).push_back(result.index.position_error.max);
    return result;
  }
  mutable std::vector<double> gave, finer;
};

// Of two groups of three draws, the deviation within them has four degrees of freedom; the draw at hand is off its group's mean, and that one
// uncertain by sqrt(1/3) of it: Student's t of four degrees at 95 percent is 2.776.
TEST(MeasuredError, OfScatteringRunsIsByTheDeviationWithinBothGroups) {
  const Scattering rung;
  const RunResult run = rung.run({}, {});
  const MeasuredError error = measure_discretisation(rung, {}, {}, run);
  ASSERT_TRUE(error.measured) << error.why_not;
  ASSERT_EQ(rung.gave.size(), 3u);
  ASSERT_EQ(rung.finer.size(), 3u);
  const auto mean = [](const std::vector<double>& x) { return (x[0] + x[1] + x[2]) / 3.0; };
  double squares = 0.0;
  for (const auto* group : {&rung.gave, &rung.finer})
    for (const double x : *group) squares += std::pow(x - mean(*group), 2);
  const double spread = std::sqrt(squares / 4.0), shift = std::abs(mean(rung.gave) - mean(rung.finer));
  EXPECT_NEAR(error.spread.position_error.max, spread, 1e-12 * spread);
  EXPECT_NEAR(error.shift.position_error.max, shift, 1e-12 * spread);
  ASSERT_LT(shift, 2.776 * spread * std::sqrt(2.0 / 3.0)) << "no shift that stands out";
  EXPECT_NEAR(error.stated.position_error.max,
              std::abs(rung.gave[0] - mean(rung.gave)) + shift + 2.776 * spread * std::sqrt(4.0 / 3.0), 1e-3 * spread);
}

// A motion whose first peak all runs have in common. Later on they go their own ways, and hardly stay below it: `late` times as high, by chance.
// Where `moves`, the first peak falls into one part of the motion or into the next.
class PeakBeforeChance final : public Rung {
 public:
  PeakBeforeChance(double late, double chance, bool moves) : late_(late), chance_(chance), moves_(moves) {}
  std::string name() const override { return "perturbation"; }
  std::string leaves_out() const override { return ""; }
  RunResult run(const Parameters&, const RunOptions& options) const override {
    const double step = options.step > 0.0 ? options.step : 1e-4;
    RunResult result;
    result.end_time = 1.0;
    result.error.discretisation = kNotMeasured;
    result.cost.steps = static_cast<std::int64_t>(1.0 / step);
    const double draw = std::sin(1e7 * step + static_cast<double>(runs_));
    result.index.position_error.max = 1e-3;
    result.index.position_error.rms = 5e-4 * (1.0 + 0.01 * draw);
    auto& peaks = result.peaks[0];
    peaks.fill(4e-4);
    peaks[moves_ && runs_ % 2 == 1 ? 8 : 7] = 1e-3;
    peaks[25] = 1e-3 * (late_ + chance_ * draw);
    ++runs_;
    return result;
  }

 private:
  double late_, chance_;
  bool moves_;
  mutable int runs_ = 0;
};

TEST(MeasuredError, OfAMaximumIsNoLessThanWhatALaterPartMayReach) {
  const auto stated = [](double late, double chance, bool moves) {
    const PeakBeforeChance rung(late, chance, moves);
    const RunResult run = rung.run({}, {});
    const MeasuredError error = measure_discretisation(rung, {}, {}, run);
    EXPECT_TRUE(error.measured) << error.why_not;
    return error.stated.position_error.max;
  };
  EXPECT_GT(stated(0.9, 0.09, false), 0.5e-4);  // the next run may well be above
  EXPECT_LT(stated(0.9, 0.0, false), 1e-9);
  EXPECT_LT(stated(0.5, 0.04, false), 1e-9) << "far below, whatever chance does";
  EXPECT_LT(stated(0.5, 0.0, true), 1e-9) << "a peak between two parts is none by chance";
}

// A run whose neighbours all fail went through by chance: what smaller steps give says what it is worth.
TEST(MeasuredError, IsThatOfFinerRunsWhereNoNeighbourCanBeFollowed) {
  const RunResult run = OnTheEdge(1.0).run({}, {});
  const MeasuredError alone = measure_discretisation(OnTheEdge(0.8e-4), {}, {}, run);
  ASSERT_TRUE(alone.measured) << alone.why_not;
  EXPECT_GT(alone.stated.position_error.max, 1e-4) << "the step's own part";
  EXPECT_NE(alone.basis.find("by chance"), std::string::npos) << alone.basis;
  const MeasuredError none = measure_discretisation(OnTheEdge(0.4e-4), {}, {}, run);
  EXPECT_FALSE(none.measured);
  EXPECT_NE(none.why_not.find("step too large"), std::string::npos) << none.why_not;
}

// Forty instants are few for a motion of a second: what they leave out of a root mean square is seen, and no less is stated.
TEST(MeasuredError, IsThatOfInstantsWhereARungTakesNoSteps) {
  const auto mechanism = example("3-rrcpr/3-rrcpr.toml", {{"initial.journals", "rest"}});
  for (const char* name : {"quasistatic", "envelope"}) {
    const auto rung = make_rung(name, mechanism);
    RunOptions few = bare(), many = bare();
    few.share_of_longest_step = 50.0;
    many.share_of_longest_step = 0.1;
    const RunResult coarse = rung->run(mechanism->parameters(), few);
    EXPECT_TRUE(std::isnan(coarse.error.discretisation)) << name;
    const MeasuredError error = measure_discretisation(*rung, mechanism->parameters(), few, coarse);
    EXPECT_TRUE(error.measured && error.by_instants) << name;
    const double off =
        std::abs(coarse.index.position_error.rms - rung->run(mechanism->parameters(), many).index.position_error.rms);
    EXPECT_GT(off, 1e-9 * coarse.index.position_error.rms) << name;
    EXPECT_LE(off, error.stated.position_error.rms) << name;
    EXPECT_LE(error.stated.position_error.rms, 0.01 * coarse.index.position_error.rms) << name;
  }
}

TEST(MeasuredError, IsMeasuredByTolerancesUnderErrorControl) {
  const auto mechanism = example("3-rrcpr/3-rrcpr.toml", {{"motion.duration", "50 ms"}});
  const auto rung = make_rung("perturbation", mechanism);
  RunOptions options = bare();
  options.integrator = "rosenbrock";
  const RunResult run = rung->run(mechanism->parameters(), options);
  const MeasuredError error = measure_discretisation(*rung, mechanism->parameters(), options, run);
  ASSERT_TRUE(error.measured) << error.why_not;
  options.tolerance = 1e-5;
  const RunResult fine = rung->run(mechanism->parameters(), options);
  EXPECT_LE(std::abs(run.index.position_error.rms - fine.index.position_error.rms), error.stated.position_error.rms);
  EXPECT_NE(error.basis.find("tolerance"), std::string::npos);
}

// The examples and four ways to make the default scene harder. What is stated holds with 95 percent confidence, so that one
// index in twenty may lie beyond it, give or take two standard errors of that count, and not by much.
// Prints a line per scene: rungs_tests --gtest_filter=MeasuredErrorLong.*
TEST(MeasuredErrorLong, CoversHalfAndQuarterStepsOfTheExamples) {
  Coverage coverage;
  const auto rrcpr = [](std::vector<Setting> settings) { return example("3-rrcpr/3-rrcpr.toml", settings); };
  for (const char* rung : {"perturbation", "multibody"}) {
    hold("3-rrcpr", rung, rrcpr({}), coverage);
    hold("3-rrcpr, restitution 1", rung, rrcpr({{"clearance.F1.contact.restitution", "1"}}), coverage);
    hold("3-rrcpr, friction 0.5", rung, rrcpr({{"clearance.F1.friction.coefficient", "0.5"}}), coverage);
    hold("3-rrcpr, payload 10 t, 0.3 s", rung, rrcpr({{"payload.mass", "10000 kg"}, {"motion.duration", "0.3 s"}}),
         coverage);
    hold("3-rrcpr, free axes, 120 mm, 0.1 s", rung,
         rrcpr({{"clearance.F1.axes", "free"}, {"clearance.F1.sleeve_length", "120 mm"}, {"motion.duration", "0.1 s"}}),
         coverage);
    hold("crank-slider", rung, example("crank-slider/crank-slider.toml"), coverage);
    hold("four-bar", rung, example("four-bar/four-bar.toml"), coverage);
    hold("2-us-pointing", rung, example("2-us-pointing/2-us-pointing.toml"), coverage);
    hold("spatial-double-crank", rung, example("spatial-double-crank/spatial-double-crank.toml"), coverage);
    hold("spatial-slider-crank", rung, example("spatial-slider-crank/spatial-slider-crank.toml"), coverage);
  }
  hold("flores-slider-crank", "perturbation", example("flores-slider-crank/flores-slider-crank.toml"), coverage);
  hold("3-rrr", "perturbation", example("3-rrr/3-rrr.toml"), coverage);
  std::printf("%d of %d indices beyond what was stated; actual over stated at most %.2f\n", coverage.beyond,
              coverage.asked, coverage.worst);
  EXPECT_GE(coverage.asked, 60);
  const double nominal = 0.05 * coverage.asked;
  EXPECT_LE(coverage.beyond, nominal + 2.0 * std::sqrt(0.95 * nominal));
  EXPECT_LE(coverage.worst, 2.0);
}

}  // namespace measured_error_test
}  // namespace boresight
