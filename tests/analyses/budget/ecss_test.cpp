// ECSS-E-ST-60-10C (15 November 2008), Control performance: its figures and its worked example.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "boresight_analyses/budget/classical.hpp"
#include "boresight_analyses/budget/half_cone.hpp"
#include "validation/printed.hpp"

namespace boresight {
namespace ecss_test {

constexpr double kPi = std::numbers::pi;
const char* const kFigureA5 = "ECSS-E-ST-60-10C, Figure A-5";
const char* const kAnnexC = "ECSS-E-ST-60-10C, Annex C";

// Figure A-5: e = A sin(omega t), A uniform on (0, 10). A quarter of a period holds every |e| equally often. `at`:
// where in its cell of amplitudes and times a sample lies; the middle integrates best, the upper end holds the
// quantiles of one alone.
EnsembleInTime figure_a5(double at) {
  constexpr int kMembers = 4000, kTimes = 2000;
  std::vector<std::vector<double>> sizes(kMembers);
  for (int k = 0; k < kMembers; ++k)
    for (int i = 0; i < kTimes; ++i)
      sizes[static_cast<std::size_t>(k)].push_back(10.0 * (k + at) / kMembers *
                                                   std::sin(0.5 * kPi * (i + at) / kTimes));
  return EnsembleInTime(std::move(sizes));
}

TEST(EcssFigureA5, IsReproducedToThePrintedDigits) {
  const EnsembleInTime ends = figure_a5(1.0), middles = figure_a5(0.5);
  const auto level = [](const EnsembleInTime& e, Interpretation i, double p) { return e.level(i, p, 0.9).value; };
  validation::expect_printed(kFigureA5, "ensemble, 95 %", "9.500", level(ends, Interpretation::ensemble, 0.95), 5e-4);
  validation::expect_printed(kFigureA5, "ensemble, 99.73 %", "9.973", level(ends, Interpretation::ensemble, 0.9973),
                             5e-4);
  validation::expect_printed(kFigureA5, "temporal, 95 %", "9.969", level(ends, Interpretation::temporal, 0.95), 5e-4);
  validation::expect_printed(kFigureA5, "temporal, 99.73 %", "10.000", level(ends, Interpretation::temporal, 0.9973),
                             5e-4);
  validation::expect_printed(kFigureA5, "mixed, 95 %", "8.154", level(middles, Interpretation::mixed, 0.95), 5e-4);
  validation::expect_printed(kFigureA5, "mixed, 99.73 %", "9.729", level(middles, Interpretation::mixed, 0.9973), 5e-4);
}

TEST(EcssFigureA5, TheClassicalRuleExceedsTheLargestPossibleErrorAndIsFlaggedWasteful) {
  const Contributor sinusoid{
      .name = "A5", .kind = ContributorClass::periodic, .parameter = {make_uniform(0.0, 10.0)}, .period = 1.0};
  const Moments mixed = moments(sinusoid, 0, ErrorIndex::ape, Interpretation::mixed, {}, 1.0);
  const std::vector<ClassicalLine> lines = {{"A5", "periodic", "", {mixed}}};
  const double three_sigma = total_of(lines).axis_level(0, 0.9973);
  validation::expect_printed(kFigureA5, "three sigma by the classical rule", "12.25", three_sigma, 5e-3);
  EXPECT_EQ(standing_of(three_sigma, 9.729), RuleStanding::wasteful);
  EXPECT_EQ(standing_of(total_of(lines).axis_level(0, 0.95), 8.154), RuleStanding::fair);
}

TEST(HalfCone, WithOneDeviationAndNoMeanIsRayleighs) {
  const char* const rayleigh = "Rayleigh's distribution, sqrt(-2 ln(1 - p))";
  validation::expect_printed(rayleigh, "half cone over one axis' deviation, 95 %", "2.448", equal_axes_factor(0.95, 2),
                             5e-4);
  validation::expect_printed(rayleigh, "half cone over one axis' deviation, 99.73 %", "3.439",
                             equal_axes_factor(0.9973, 2), 5e-4);
  EXPECT_NEAR(radius_of(0.9973, std::vector{0.0, 0.0}, std::vector{1.0, 1.0}), 3.4393, 1e-4);
}

TEST(ClassicalRule, IsCalledUnsafeOrWastefulOnlyBeyondWhatBothMayBeOffBy) {
  constexpr double kNothing = 1e-9;
  EXPECT_EQ(standing_of({9.1, {9.0, 9.2}}, {10.2, {10.0, 10.5}}, kNothing), RuleStanding::unsafe);
  EXPECT_EQ(standing_of({13.5, {13.0, 14.0}}, {10.2, {10.0, 10.5}}, kNothing), RuleStanding::wasteful);
  EXPECT_EQ(standing_of({10.3, {10.1, 10.6}}, {10.2, {10.0, 10.5}}, kNothing), RuleStanding::fair);
  EXPECT_EQ(standing_of({1e-19, {1e-19, 1e-19}}, {3e-19, {3e-19, 3e-19}}, kNothing), RuleStanding::fair);
  EXPECT_EQ(standing_of({0.0, {0.0, 0.0}}, {0.0, {0.0, 0.0}}, 0.0), RuleStanding::fair);
}

TEST(ClassicalRule, IsInDoubtWhereOtherMembersMayTellOtherwise) {
  constexpr double kNothing = 1e-9, kNoBound = std::numeric_limits<double>::infinity();
  const auto standing = [](const LevelOfMembers& rule, const LevelOfMembers& seen) {
    return standing_of(rule, seen, kNothing);
  };
  // Seen too low or too high, and not shown to be.
  EXPECT_EQ(standing({9.5, {9.0, 9.9}}, {10.2, {10.0, 10.5}}), RuleStanding::in_doubt);
  EXPECT_EQ(standing({13.0, {12.5, 14.0}}, {10.2, {10.0, 10.5}}), RuleStanding::in_doubt);
  // Half of the level seen, with members too few for an interval.
  EXPECT_EQ(standing({5.0, {}}, {10.0, {}}), RuleStanding::in_doubt);
  // Seen to be fair, of a level that may be far higher, or is hardly known at all.
  EXPECT_EQ(standing({10.0, {10.0, 10.0}}, {10.0, {9.0, kNoBound}}), RuleStanding::in_doubt);
  EXPECT_EQ(standing({10.0, {6.0, 15.0}}, {10.0, {9.0, 11.0}}), RuleStanding::in_doubt);
  EXPECT_EQ(standing({10.0, {}}, {10.0, {}}), RuleStanding::in_doubt);
}

// ECSS-E-ST-60-10C, A.2: the rule is for no mean. Offset 1, deviations (1, 1).
TEST(HalfCone, WithAnOffsetNeedsTheIntegralAndTheRuleIsUnsafe) {
  const double exact = radius_of(0.9973, std::vector{1.0, 0.0}, std::vector{1.0, 1.0});
  EXPECT_NEAR(exact, 4.021, 5e-4);
  EXPECT_EQ(standing_of(equal_axes_factor(0.9973, 2), exact), RuleStanding::unsafe);
}

TEST(HalfCone, HoldsForUnequalAxesFixedValuesAndThreeAxes) {
  const double one = radius_of(0.95, std::vector{0.0, 0.0}, std::vector{1.0, 0.0});
  EXPECT_NEAR(one, 1.959964, 1e-6);  // one axis alone
  EXPECT_NEAR(radius_of(0.95, std::vector{3.0, 4.0}, std::vector{0.0, 0.0}), 5.0, 1e-6);
  const double three = radius_of(0.95, std::vector{0.0, 0.0, 0.0}, std::vector{2.0, 2.0, 2.0});
  EXPECT_NEAR(three, 2.0 * 2.795483, 1e-5);  // chi with three degrees of freedom: sqrt(7.814728)
}

// An axis whose values differ by rounding does not scatter, whatever is made of its deviation.
TEST(HalfCone, TakesADeviationOfRoundingForNone) {
  for (const double probability : {0.7, 0.95}) {
    EXPECT_NEAR(radius_of(probability, std::vector{1.92e-4, 2e-6}, std::vector{1e-20, 4e-21}),
                std::hypot(1.92e-4, 2e-6), 1e-12);
    const double beside = radius_of(probability, std::vector{1.92e-4, 0.0}, std::vector{1e-19, 1e-4});
    const double alone = radius_of(probability, std::vector{0.0}, std::vector{1e-4});
    EXPECT_NEAR(beside, std::hypot(1.92e-4, alone), 1e-10);
  }
}

// Annex C: a satellite with a star tracker; arcsec; mixed interpretation, 95 %; window of RPE 30 s.
// The bias of the star tracker is printed as G(0, 6.67), G(0, 3.33): a third of 20 and of 10, its three sigma.
struct AnnexC {
  static std::vector<Contributor> contributors() {
    constexpr double kLong = 1e8, kShort = 1e-3, kWhite = 1e-9;  // periods and correlation time [s] against 30 s
    const auto delta = [](double v) { return make_discrete({v}, {1.0}); };
    const auto g = [](double mean, double sd) { return make_normal(mean, sd); };
    const auto u = [](double low, double high) { return make_uniform(low, high); };
    return {
        {.name = "star tracker noise",
         .kind = ContributorClass::random,
         .parameter = {delta(10), delta(5), delta(5)},
         .correlation_time = kWhite},
        {.name = "star tracker bias",
         .kind = ContributorClass::bias,
         .parameter = {g(0, 20. / 3), g(0, 10. / 3), g(0, 10. / 3)}},
        {.name = "controller, actuators",
         .kind = ContributorClass::random,
         .parameter = {g(1, 3), g(1, 3), g(1, 3)},
         .correlation_time = kWhite},
        {.name = "thermoelastic",
         .kind = ContributorClass::periodic,
         .parameter = {u(0, 4), u(0, 4), u(0, 4)},
         .period = kLong},
        {.name = "payload misalignment", .kind = ContributorClass::bias, .parameter = {u(-5, 5), u(-5, 5), u(-5, 5)}},
        {.name = "targeting",
         .kind = ContributorClass::periodic,
         .parameter = {g(0, 5), g(0, 1), g(0, 5)},
         .period = kLong},
        {.name = "flexible modes, slosh",
         .kind = ContributorClass::periodic,
         .parameter = {g(0, 3), g(0, 5), g(0, 3)},
         .period = kShort}};
  }
  static ClassicalTotal total(ErrorIndex index) {
    std::vector<ClassicalLine> lines;
    for (const Contributor& c : contributors()) {
      lines.push_back({c.name, to_string(c.kind), "", {}});
      for (int axis = 0; axis < 3; ++axis)
        lines.back().axes.push_back(moments(c, axis, index, Interpretation::mixed, {.window = 30.0}, 1e9));
    }
    return total_of(lines);
  }
};

TEST(EcssAnnexC, DeviationsOfApeAndRpeAreReproducedToThePrintedDigits) {
  const ClassicalTotal ape = AnnexC::total(ErrorIndex::ape), rpe = AnnexC::total(ErrorIndex::rpe);
  const char* const ape_printed[] = {"13.51", "8.37", "8.61"};
  const char* const rpe_printed[] = {"10.70", "6.89", "6.28"};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::string deviation = std::string("deviation about ") + "xyz"[axis] + " [arcsec]";
    validation::expect_printed(kAnnexC, "APE, " + deviation, ape_printed[axis], ape.axes[axis].sd, 0.005);
    validation::expect_printed(kAnnexC, "RPE, " + deviation, rpe_printed[axis], rpe.axes[axis].sd, 0.005);
  }
}

TEST(EcssAnnexC, LevelsAreReproducedToThePrintedDigits) {
  const ClassicalTotal ape = AnnexC::total(ErrorIndex::ape), rpe = AnnexC::total(ErrorIndex::rpe);
  validation::expect_printed(kAnnexC, "APE, level about x, 95 % [arcsec]", "27.01", ape.axis_level(0, 0.95), 0.005);
  validation::expect_printed(kAnnexC, "APE, level about y, 95 % [arcsec]", "16.75", ape.axis_level(1, 0.95), 0.005);
  // Printed 17.21, cut off: the axes' variances differ by exactly 4 (12.5 + 4.5 - 0.5 - 12.5), which with y = 16.75
  // leaves sqrt(16.745^2 + 16) = 17.216 as the least.
  EXPECT_NEAR(std::floor(100.0 * ape.axis_level(2, 0.95)) / 100.0, 17.21, 1e-9);
  validation::expect_printed(kAnnexC, "APE, level about z, 95 % [arcsec], which is printed cut off", "17.21",
                             ape.axis_level(2, 0.95), 0.01);
  validation::expect_printed(kAnnexC, "RPE, level about x, 95 % [arcsec]", "21.40", rpe.axis_level(0, 0.95), 0.005);
  validation::expect_printed(kAnnexC, "RPE, level about y, 95 % [arcsec]", "13.78", rpe.axis_level(1, 0.95), 0.005);
  validation::expect_printed(kAnnexC, "RPE, level about z, 95 % [arcsec]", "12.57", rpe.axis_level(2, 0.95), 0.005);
}

TEST(EcssAnnexC, ApeIsMetAndRpeIsNot) {
  const ClassicalTotal ape = AnnexC::total(ErrorIndex::ape), rpe = AnnexC::total(ErrorIndex::rpe);
  const double ape_limit[] = {60, 20, 20}, rpe_limit[] = {30, 10, 10};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    EXPECT_LE(ape.axis_level(axis, 0.95), ape_limit[axis]);
    EXPECT_EQ(rpe.axis_level(axis, 0.95) <= rpe_limit[axis], axis == 0);
  }
}

// Tables B-1 to B-7 as the limits of the exact filters, and the drift.
TEST(EcssAnnexB, TheTablesOfShortAndLongPeriodsAreLimitsOfTheFilters) {
  const DistributionPtr a = make_uniform(0.0, 3.0);  // mean 1.5, sd 0.866, rms 1.732, worst 3
  const Windows windows{.window = 1.0, .separation = 5e5};
  const auto of = [&](double period, ErrorIndex index, Interpretation i) {
    const Contributor c{.name = "", .kind = ContributorClass::periodic, .parameter = {a}, .period = period};
    return moments(c, 0, index, i, windows, 1e9);
  };
  validation::PrintedTable table_9("ECSS-E-ST-60-10C, Tables B-1 to B-7", "moments of a long sinusoid's indices", 1e-9),
      table_5("ECSS-E-ST-60-10C, Tables B-1 to B-7", "moments that vanish, and of short sinusoids", 1e-5);
  // Long, a separation of half the period: the index is twice the sinusoid.
  table_9.expect("mean", 2.0 * 1.5, of(1e6, ErrorIndex::pde, Interpretation::ensemble).mean);
  table_9.expect("sd", 2.0 * std::sqrt(0.75), of(1e6, ErrorIndex::pde, Interpretation::ensemble).sd);
  table_9.expect("sd", std::sqrt(2.0) * 3.0, of(1e6, ErrorIndex::pde, Interpretation::temporal).sd);
  table_9.expect("sd", std::sqrt(2.0) * std::sqrt(3.0), of(1e6, ErrorIndex::pde, Interpretation::mixed).sd);
  table_5.expect("sd", 0.0, of(1e6, ErrorIndex::rpe, Interpretation::mixed).sd);
  table_9.expect("sd", std::sqrt(1.5), of(1e6, ErrorIndex::mpe, Interpretation::mixed).sd);
  // Short.
  table_5.expect("sd", std::sqrt(1.5), of(1e-5, ErrorIndex::rpe, Interpretation::mixed).sd);
  table_5.expect("sd", 0.0, of(1e-5, ErrorIndex::mpe, Interpretation::mixed).sd);
}

// Small errors are as Gaussian as large ones: the radius scales with them, also where axes are correlated.
TEST(ClassicalTotal, HasARadiusInProportionToItsErrors) {
  for (const double size : {1.0, 1e-6}) {
    ClassicalTotal alike{.axes = {{.mean = 0.0, .sd = size}, {.mean = 0.0, .sd = size}}};
    alike.covariance.diagonal() << size * size, size * size, 0.0;
    EXPECT_NEAR(alike.radius_integrated(0.95) / size, std::sqrt(-2.0 * std::log(0.05)), 1e-6);
    // Wholly correlated: one error along the diagonal of the two axes, sqrt(2) as large. 1.959964: 97.5 % of a normal.
    ClassicalTotal together = alike;
    together.covariance(0, 1) = together.covariance(1, 0) = size * size;
    EXPECT_NEAR(together.radius_integrated(0.95) / size, std::sqrt(2.0) * 1.959964, 1e-5);
  }
}

}  // namespace ecss_test
}  // namespace boresight
