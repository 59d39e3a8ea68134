// Every method in the one Integrator: its order where all is smooth, its counts, its faults.
#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "boresight/integrate/explicit_method.hpp"
#include "boresight/integrate/generalized_alpha.hpp"
#include "boresight/integrate/integrator.hpp"
#include "boresight/integrate/rosenbrock_method.hpp"

namespace boresight {
namespace methods_test {

// A driven, damped, hardening spring: not linear, not autonomous, second order, and exact because the drive is made for
// it. q = sin t + 0.3 cos 2t;  q'' = -q - q^3 - 0.2 q' + drive(t).
struct DrivenSpring {
  static double q(double t) { return std::sin(t) + 0.3 * std::cos(2.0 * t); }
  static double v(double t) { return std::cos(t) - 0.6 * std::sin(2.0 * t); }
  static double a(double t) { return -std::sin(t) - 1.2 * std::cos(2.0 * t); }
  void derivative(double t, const VecX& y, VecX& dy) const {
    const double drive = a(t) + q(t) + std::pow(q(t), 3) + 0.2 * v(t);
    dy[0] = y[1];
    dy[1] = -y[0] - std::pow(y[0], 3) - 0.2 * y[1] + drive;
  }
};

// With its own derivatives.
struct DrivenSpringWithDerivatives : DrivenSpring {
  void jacobian(double, const VecX& y, MatX& j) const { j << 0.0, 1.0, -1.0 - 3.0 * y[0] * y[0], -0.2; }
  void time_derivative(double t, const VecX&, VecX& ft) const {
    ft[0] = 0.0;
    ft[1] = -std::cos(t) + 2.4 * std::sin(2.0 * t) + v(t) + 3.0 * q(t) * q(t) * v(t) + 0.2 * a(t);
  }
};

VecX at(double t) {
  VecX y(2);
  y << DrivenSpring::q(t), DrivenSpring::v(t);
  return y;
}

template <typename S = DrivenSpring, typename M>
double end_error(M method, double h, double* dense_error = nullptr) {
  Integrator<M> integrator(std::move(method));
  S system;
  VecX y = at(0.0), inside(2);
  double largest = 0.0;
  const IntegrationSummary summary = integrator.run(system, 0.0, 3.0, y, {.step = h}, [&](const auto& step) {
    for (double share : {0.2, 0.5, 0.9}) {
      const double t = step.start() + share * (step.end() - step.start());
      step.at(t, inside);
      largest = std::max(largest, (inside - at(t)).norm());
    }
  });
  EXPECT_TRUE(summary.completed()) << summary;
  if (dense_error) *dense_error = largest;
  return (y - at(3.0)).norm();
}

template <typename S = DrivenSpring, typename M>
void expect_order(const M& method, double order, double dense_order, double h = 0.05) {
  double dense_coarse, dense_fine;
  const double coarse = end_error<S>(method, h, &dense_coarse), fine = end_error<S>(method, 0.25 * h, &dense_fine);
  EXPECT_NEAR(std::log(coarse / fine) / std::log(4.0), order, 0.25) << method.name();
  // The global error of dense output: that of the ends, or the interpolation's own if that is larger.
  EXPECT_GT(std::log(dense_coarse / dense_fine) / std::log(4.0), dense_order - 0.3) << method.name();
}

TEST(EveryMethod, ConvergesWithItsOrderOnASmoothProblem) {
  expect_order(ExplicitMethod(classical_rk4(), 2), 4, 4);
  expect_order(ExplicitMethod(bogacki_shampine32(), 2), 3, 3);
  expect_order(ExplicitMethod(dormand_prince54(), 2), 5, 5);
  expect_order<DrivenSpringWithDerivatives>(RosenbrockMethod(rodas3(), 2), 3, 3);
  expect_order<DrivenSpringWithDerivatives>(RosenbrockMethod(rodas4(), 2), 4, 4);
  expect_order(GeneralizedAlpha(0.8, 2), 2, 2);
  expect_order(GeneralizedAlpha(0.0, 2), 2, 2);
}

TEST(RosenbrockMethods, KeepTheirOrderWithFiniteDifferences) {
  expect_order(RosenbrockMethod(rodas3(), 2), 3, 3);
  expect_order(RosenbrockMethod(rodas4(), 2), 4, 4, 0.1);
}

// Error per step, against its estimate, both O(h^(error_order + 1)).
template <typename M>
void expect_error_order(M method) {
  DrivenSpring system;
  double estimate[2];
  for (int i = 0; i < 2; ++i) {
    const VecX y = at(0.7);
    const double h = i == 0 ? 0.08 : 0.02;
    method.begin(system, 0.7, y);
    ASSERT_EQ(method.attempt(system, 0.7, h, y), Attempt::done);
    estimate[i] = method.error().norm();
  }
  EXPECT_NEAR(std::log(estimate[0] / estimate[1]) / std::log(4.0), method.error_order() + 1, 0.3) << method.name();
}

TEST(EveryErrorEstimate, ShrinksWithItsOrder) {
  expect_error_order(ExplicitMethod(bogacki_shampine32(), 2));
  expect_error_order(ExplicitMethod(dormand_prince54(), 2));
  expect_error_order(RosenbrockMethod(rodas3(), 2));
  expect_error_order(RosenbrockMethod(rodas4(), 2));
  expect_error_order(GeneralizedAlpha(0.8, 2));
}

// The tolerance bounds the error of one step. That of the run is in proportion to it where the better of two solutions
// is carried on (local extrapolation); where the estimated one is, to the power order/(order + 1) of it.
template <typename M>
void expect_tolerance_met(M method, double power = 1.0) {
  Integrator<M> integrator(std::move(method));
  double error[2];
  for (int i = 0; i < 2; ++i) {
    const double tolerance = i == 0 ? 1e-5 : 1e-8;
    DrivenSpring system;
    VecX y = at(0.0);
    const IntegrationSummary summary =
        integrator.run(system, 0.0, 20.0, y, {.relative_tolerance = tolerance, .absolute_tolerance = tolerance});
    EXPECT_TRUE(summary.completed());
    error[i] = (y - at(20.0)).norm();
    EXPECT_LT(error[i], 100.0 * std::pow(tolerance, power)) << integrator.method().name() << ": " << summary;
    EXPECT_LT(summary.rejected(), summary.steps / 5 + 3) << integrator.method().name() << ": " << summary;
    EXPECT_EQ(summary.stiff_steps, 0);
  }
  EXPECT_NEAR(std::log10(error[0] / error[1]), 3.0 * power, 0.6) << integrator.method().name();
}

TEST(ErrorControl, KeepsTheErrorNearTheToleranceWithFewRejections) {
  expect_tolerance_met(ExplicitMethod(bogacki_shampine32(), 2));
  expect_tolerance_met(ExplicitMethod(dormand_prince54(), 2));
  expect_tolerance_met(RosenbrockMethod(rodas3(), 2));
  expect_tolerance_met(RosenbrockMethod(rodas4(), 2));
  expect_tolerance_met(GeneralizedAlpha(0.8, 2), 2.0 / 3.0);
}

// A journal that rests on its sleeve, 1e4 rad/s, while the place where it rests moves by a tenth of a millimetre.
struct RestingOnASpring {
  double rate = 1e4, travel = 1e-4;
  void derivative(double t, const VecX& y, VecX& dy) const {
    dy[0] = y[1];
    dy[1] = -rate * rate * (y[0] - travel * std::cos(t)) - 0.02 * rate * y[1];
  }
};

TEST(ImplicitMethods, StepOverASettledVibration) {
  const auto steps = [](auto method) {
    Integrator<decltype(method)> integrator(std::move(method));
    RestingOnASpring system;
    VecX y(2);
    y << 1e-4 + 1e-7, 0.0;
    IntegrationOptions options{.relative_tolerance = 0.0};
    options.absolute_tolerances = VecX::Zero(2);
    options.absolute_tolerances << 1e-9, 1e-5;
    const IntegrationSummary summary = integrator.run(system, 0.0, 1.0, y, options);
    EXPECT_TRUE(summary.completed()) << summary;
    EXPECT_NEAR(y[0], 1e-4 * std::cos(1.0), 1e-8) << integrator.method().name();
    return summary;
  };
  const IntegrationSummary pair = steps(ExplicitMethod(dormand_prince54(), 2));
  EXPECT_GT(pair.steps, 3000) << pair;
  EXPECT_GT(pair.stiff_steps, pair.steps / 4) << "the pair is held by stability and says so: " << pair;
  for (const IntegrationSummary& implicit :
       {steps(RosenbrockMethod(rodas4(), 2)), steps(RosenbrockMethod(rodas3(), 2)), steps(GeneralizedAlpha(0.5, 2))}) {
    EXPECT_LT(implicit.steps, pair.steps / 10) << implicit;
    EXPECT_GT(implicit.largest_step * 1e4, 50.0) << "fifty radians of the vibration in one step: " << implicit;
  }
}

TEST(GeneralizedAlphaMethod, HasTheSpectralRadiusItWasAskedForAtInfinity) {
  for (double rho : {0.0, 0.5, 0.9}) {
    struct FastSpring {
      void derivative(double, const VecX& y, VecX& dy) const {
        dy[0] = y[1];
        dy[1] = -1e12 * y[0];
      }
    } system;
    GeneralizedAlpha method(rho, 2);
    VecX y(2);
    y << 1.0, 0.0;
    method.begin(system, 0.0, y);
    // The powers of the amplification matrix shrink like rho^k, for its double root times k.
    double norm[2] = {};
    const int first = 100, last = 300;
    for (int k = 1; k <= last; ++k) {
      ASSERT_EQ(method.attempt(system, 0.0, 1.0, y), Attempt::done);
      method.finish(system, 1.0);
      y = method.proposed();
      method.advance();
      if (k == first) norm[0] = std::abs(y[0]);
      if (k == last) norm[1] = std::abs(y[0]);
    }
    if (rho == 0.0)
      EXPECT_LT(norm[0], 1e-100);
    else
      EXPECT_NEAR(std::pow(norm[1] / norm[0], 1.0 / (last - first)), rho, 0.02);
  }
}

TEST(Integrator, SaysWhyItStopped) {
  struct BlowUp {
    void derivative(double, const VecX& y, VecX& dy) const { dy[0] = y[0] * y[0]; }
  } system;
  VecX y = VecX::Constant(1, 1.0);
  Integrator<ExplicitMethod> pair(ExplicitMethod(dormand_prince54(), 1));
  IntegrationSummary summary = pair.run(system, 0.0, 2.0, y, {});
  EXPECT_EQ(summary.stop, StopReason::step_too_small) << summary;
  EXPECT_NEAR(summary.t, 1.0, 1e-4);
  EXPECT_TRUE(y.allFinite());

  y[0] = 1.0;
  Integrator<ExplicitMethod> fixed(ExplicitMethod(classical_rk4(), 1));
  summary = fixed.run(system, 0.0, 2.0, y, {.step = 0.01});
  EXPECT_EQ(summary.stop, StopReason::not_finite) << summary;
  EXPECT_TRUE(y.allFinite());

  y[0] = 1.0;
  summary = fixed.run(system, 0.0, 0.5, y, {});
  EXPECT_EQ(summary.stop, StopReason::invalid_options);
  EXPECT_NE(summary.message.find("no error estimate"), std::string::npos) << summary.message;
  summary = pair.run(system, 0.0, 0.5, y, {.relative_tolerance = -1.0});
  EXPECT_EQ(summary.stop, StopReason::invalid_options);
  EXPECT_NE(summary.message.find("relative_tolerance: found -1"), std::string::npos) << summary.message;
  summary = pair.run(system, 0.0, 0.5, y, {.largest_step = 0.01, .most_steps = 3});
  EXPECT_EQ(summary.stop, StopReason::too_many_steps);
  std::ostringstream text;
  text << summary;
  EXPECT_NE(text.str().find("too many steps"), std::string::npos);
}

// Iterations of a step that was far too long run away to where the spring is stiffer than any; that must not be what the shorter steps
// after it are solved with.
TEST(GeneralizedAlphaMethod, GoesOnAfterAStepWhoseIterationsRanAway) {
  struct CubicSpring {
    void derivative(double, const VecX& y, VecX& dy) const {
      dy[0] = y[1];
      dy[1] = -1e4 * std::pow(y[0], 3);
    }
  };
  const auto end_of = [](double first_step, IntegrationSummary& summary) {
    Integrator<GeneralizedAlpha> integrator(GeneralizedAlpha(0.8, 2));
    CubicSpring spring;
    VecX y(2);
    y << 0.5, 0.0;
    summary = integrator.run(spring, 0.0, 1.0, y,
                             {.relative_tolerance = 1e-6, .first_step = first_step, .most_steps = 100000});
    return y;
  };
  IntegrationSummary wild, tame;
  const VecX far = end_of(0.1, wild), near = end_of(1e-4, tame);
  ASSERT_TRUE(wild.completed()) << wild;
  ASSERT_TRUE(tame.completed()) << tame;
  ASSERT_GT(wild.rejected_no_convergence, 0) << "the first attempt does not run away: the test holds nothing";
  EXPECT_NEAR(far[0], near[0], 1e-3);
}

}  // namespace methods_test
}  // namespace boresight
