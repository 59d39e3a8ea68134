// Which contact law is preferred by data of a known one, where the noise follows itself.
#include "boresight_analyses/calibration/law_comparison.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "four_bar_rig.hpp"

namespace boresight {
namespace law_comparison_test {

using four_bar::Bench;

const std::vector<std::string> kThree = {"clearance.D.radial", "clearance.D.contact.restitution",
                                         "clearance.D.friction.coefficient"};

CalibrationProblem problem_of(const Bench& bench, double noise, double follows, unsigned seed) {
  return four_bar::with_following_noise(bench, kThree, noise, follows, seed);
}

std::vector<LawScore> scores(const CalibrationProblem& problem, const std::vector<std::string>& laws,
                             const std::vector<bool>& fixed = {}) {
  Globals start = problem.start();
  for (int p = 0; p < problem.parameter_count(); ++p) {
    const ParameterPath path(problem.runs[0].mechanism->description(),
                             problem.parameters[static_cast<std::size_t>(p)].path);
    start.u[p] =
        problem.parameters[static_cast<std::size_t>(p)].coordinate(path.get(problem.runs[0].mechanism->parameters()));
  }
  FitOptions options;
  options.most_iterations = 15;
  options.cost_tolerance = 1e-4;
  options.fixed = fixed;
  std::vector<LawScore> found;
  for (const std::string& law : laws) found.push_back(law_score(problem, law, start, options));
  compare(found);
  return found;
}

TEST(LawComparison, CountsWhatALawKnowsAndIsEstimated) {
  const Bench bench({2.0}, 0.1, false);
  const CalibrationProblem problem = problem_of(bench, 0.01, 0.0, 1);
  std::vector<LawScore> found = scores(problem, {"hertz", "flores"});
  EXPECT_EQ(found[0].parameters, 3);  // radial, friction, and the variance
  EXPECT_EQ(found[1].parameters, 4);
  // Restitution held: neither law estimates it.
  found = scores(problem, {"hertz", "flores"}, {false, true, false});
  EXPECT_EQ(found[0].parameters, 3);
  EXPECT_EQ(found[1].parameters, 3);
}

// Flores' law made the data; restitution is held, so that the other one cannot take its place. A likelihood ratio beyond exp(5) for
// the wrong one, which is a difference of 10, comes by a chance of at most exp(-5). 60 studies find out a rate of 10 % with a chance of 99 %.
TEST(LawComparisonLong, TheWrongLawIsDecidedForNoMoreOftenForNoiseThatFollowsItself) {
  constexpr int kStudies = 60;
  const double nominal = std::exp(-5.0);
  const Bench bench({2.0}, 0.06, false);
  for (const double follows : {0.0, 0.9}) {
    int wrong = 0, wrong_as_if_white = 0;
    double per_one = 0.0;
    for (unsigned study = 0; study < kStudies; ++study) {
      const std::vector<LawScore> found =
          scores(problem_of(bench, 0.2, follows, 100 + study), {"lankarani-nikravesh", "flores"}, {false, true, false});
      wrong += found[1].difference > 10.0;
      wrong_as_if_white += found[1].cost + 2.0 * found[1].parameters > 10.0 + found[0].cost + 2.0 * found[0].parameters;
      per_one += static_cast<double>(found[0].values) / found[0].effective_values / kStudies;
    }
    std::printf(
        "autocorrelation %.1f: wrong law %.3f (as if white: %.3f), nominal %.3f; %.3g values an independent one\n",
        follows, double(wrong) / kStudies, double(wrong_as_if_white) / kStudies, nominal, per_one);
    EXPECT_LE(double(wrong) / kStudies, nominal + 2.0 * std::sqrt(nominal * (1.0 - nominal) / kStudies)) << follows;
    if (follows > 0.0) {
      EXPECT_GT(double(wrong_as_if_white) / kStudies, 0.05);
    }
  }
}

// However few windows there are, one is kept out where a share is asked for, and one is fitted.
TEST(HoldOut, KeepsAtLeastOneWindowOut) {
  const Bench bench({2.0, 2.2, 2.4}, 0.02, false);
  CalibrationProblem problem = problem_of(bench, 0.01, 0.0, 1);
  const auto held = [&](double share) {
    for (Window& w : problem.windows) w.held_out = false;
    hold_out_windows(problem, share);
    return std::count_if(problem.windows.begin(), problem.windows.end(), [](const Window& w) { return w.held_out; });
  };
  ASSERT_EQ(problem.windows.size(), 3u);
  EXPECT_EQ(held(0.0), 0);
  EXPECT_EQ(held(0.1), 1);
  EXPECT_EQ(held(0.25), 1);
  EXPECT_EQ(held(0.6), 1);
}

}  // namespace law_comparison_test
}  // namespace boresight
