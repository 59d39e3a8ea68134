// Problems whose answer is known, each found to 1e-6.
#include "boresight_analyses/optimise/minimise.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

#include "validation/printed.hpp"

namespace boresight {
namespace minimise_test {

using testing::HasSubstr;
using Values = std::span<const double>;
using Gradient = std::span<double>;

MinimisationOptions fine() { return {.global_evaluations = 200, .local_evaluations = 2000, .tolerance = 1e-9}; }

// (x-1)^2 + 10 (y-0.3 x)^2, least at (1, 0.3).
MinimisationProblem quadratic() {
  MinimisationProblem p{.lower = {-2, -1}, .upper = {3, 4}, .start = {2.5, 3}};
  p.objective = [](Values x, Gradient) { return std::pow(x[0] - 1, 2) + 10 * std::pow(x[1] - 0.3 * x[0], 2); };
  return p;
}

TEST(Minimise, FindsTheBottomOfAQuadraticWithoutGradients) {
  const Minimum m = minimise(quadratic(), fine());
  EXPECT_TRUE(m.converged);
  EXPECT_NEAR(m.x[0], 1.0, 1e-6);
  EXPECT_NEAR(m.x[1], 0.3, 1e-6);
  EXPECT_EQ(m.global, "direct-l");
  EXPECT_EQ(m.local, "bobyqa");
}

TEST(Minimise, EveryUnconstrainedPairOfAlgorithmsAgrees) {
  for (const char* global : {"none", "direct-l", "crs2", "mlsl", "isres"})
    for (const char* local : {"cobyla", "bobyqa"}) {
      MinimisationOptions options = fine();
      options.global = global;
      options.local = local;
      const Minimum m = minimise(quadratic(), options);
      EXPECT_NEAR(m.x[0], 1.0, 1e-6) << global << ' ' << local;
      EXPECT_NEAR(m.x[1], 0.3, 1e-6) << global << ' ' << local;
    }
}

// Hock and Schittkowski (1981), problem 71 without its equation: x1 x4 (x1 + x2 + x3) + x3 over 1 <= x <= 5
// with x1 x2 x3 x4 >= 25 and |x|^2 <= 40. Its published optimum, 17.0140173 at
// (1, 4.7429994, 3.8211503, 1.3794082), keeps |x|^2 = 40 with equality, and the less-than-or-equal lets
// nothing better in.
MinimisationProblem hock_schittkowski_71(bool gradients) {
  MinimisationProblem p{.lower = {1, 1, 1, 1}, .upper = {5, 5, 5, 5}, .start = {1, 5, 5, 1}};
  p.gradients = gradients;
  p.objective = [](Values x, Gradient g) {
    if (!g.empty()) {
      g[0] = x[3] * (2 * x[0] + x[1] + x[2]);
      g[1] = x[0] * x[3];
      g[2] = x[0] * x[3] + 1;
      g[3] = x[0] * (x[0] + x[1] + x[2]);
    }
    return x[0] * x[3] * (x[0] + x[1] + x[2]) + x[2];
  };
  p.constraints.push_back([](Values x, Gradient g) {
    const double product = x[0] * x[1] * x[2] * x[3];
    for (std::size_t i = 0; i < g.size(); ++i) g[i] = -product / x[i] / 25.0;
    return 1.0 - product / 25.0;
  });
  p.constraints.push_back([](Values x, Gradient g) {
    double squares = 0.0;
    for (std::size_t i = 0; i < 4; ++i) squares += x[i] * x[i];
    for (std::size_t i = 0; i < g.size(); ++i) g[i] = 2.0 * x[i] / 40.0;
    return squares / 40.0 - 1.0;
  });
  return p;
}

TEST(Minimise, FindsTheConstrainedOptimumOfHockAndSchittkowski71) {
  for (const bool gradients : {true, false})
    for (const char* local : {"auto", "mma"}) {
      if (!gradients && std::string(local) == "mma") continue;
      MinimisationOptions options = fine();
      options.global = "none";
      options.local = local;
      options.local_evaluations = 20000;
      const Minimum m = minimise(hock_schittkowski_71(gradients), options);
      validation::expect_printed("Hock and Schittkowski 1981, problem 71",
                                 "optimum by " + m.local + (gradients ? ", with gradients" : ", without gradients"),
                                 "17.0140173", m.objective, 1e-6 * 17.0);
      EXPECT_LE(m.violation, 1e-8);
    }
}

// Six valleys; the deepest one is not the one the start lies in.
TEST(Minimise, SearchesTheWholeBoxBeforeItDescends) {
  MinimisationProblem p{.lower = {0}, .upper = {6}, .start = {0.1}};
  p.objective = [](Values x, Gradient) {
    return std::cos(2 * std::numbers::pi * x[0]) + 0.05 * std::pow(x[0] - 3.6, 2);
  };
  const Minimum m = minimise(p, fine());
  EXPECT_NEAR(m.x[0], 3.5, 0.01);
  EXPECT_THAT(m.why, HasSubstr("DIRECT-L"));
}

TEST(Minimise, WhereNothingKeepsTheConstraintsReturnsWhatBreaksThemLeast) {
  MinimisationProblem p = quadratic();
  p.constraints.push_back([](Values x, Gradient) { return 5.0 - x[0]; });
  const Minimum m = minimise(p, fine());
  EXPECT_NEAR(m.x[0], 3.0, 1e-6);
  EXPECT_NEAR(m.violation, 2.0, 1e-6);
}

TEST(Minimise, RefusesAlgorithmsThatCannotTakeTheProblem) {
  MinimisationProblem p = quadratic();
  EXPECT_THROW(minimise(p, {.local = "slsqp"}), std::invalid_argument);
  p.constraints.push_back([](Values x, Gradient) { return x[0]; });
  EXPECT_THROW(minimise(p, {.global = "crs2"}), std::invalid_argument);
  EXPECT_THROW(minimise(p, {.local = "bobyqa"}), std::invalid_argument);
  EXPECT_THROW(minimise(p, {.global = "annealing"}), std::invalid_argument);
}

TEST(Minimise, WhatTheObjectiveThrowsIsThrownOn) {
  MinimisationProblem p = quadratic();
  struct Full {};
  p.objective = [](Values x, Gradient) -> double {
    if (x[0] < 0.5) throw Full{};
    return x[0];
  };
  EXPECT_THROW(minimise(p, fine()), Full);
}

TEST(Minimise, AnInterruptionKeepsTheBestPlaceSeen) {
  MinimisationProblem p = quadratic();
  int left = 20;
  MinimisationOptions options = fine();
  options.interrupted = [&] { return --left < 0; };
  const Minimum m = minimise(p, options);
  EXPECT_TRUE(m.interrupted);
  EXPECT_FALSE(m.converged);
  EXPECT_EQ(m.evaluations, 20);
  EXPECT_LT(m.objective, p.objective(p.start, {}));
}

}  // namespace minimise_test
}  // namespace boresight
