// Vibrations that grow while a method's steps are too long for them: R(h lambda) of A-stable methods is small there too.
#include <gtest/gtest.h>

#include <cmath>

#include "boresight/integrate/generalized_alpha.hpp"
#include "boresight/integrate/growth_watch.hpp"
#include "boresight/integrate/integrator.hpp"
#include "boresight/integrate/rosenbrock_method.hpp"

namespace boresight {
namespace growth_test {

constexpr double kFast = 1e4, kGrowth = 200.0, kStart = 1e-9, kEnd = 0.05;  // [1/s], [1/s], [m], [s]
constexpr double kTolerance = 1e-3;

// A mass on a spring whose damper feeds it, beside one that swings slowly: q = (fast, slow).
struct FedVibration {
  double growth = kGrowth;
  void derivative(double, const VecX& y, VecX& dy) const {
    dy[0] = y[2];
    dy[1] = y[3];
    dy[2] = 2.0 * growth * y[2] - (kFast * kFast + growth * growth) * y[0];
    dy[3] = -100.0 * y[1];
  }
};

// Largest |y| of the vibration over the last tenth of the motion.
template <typename M>
double end_of_vibration(M method, bool follow_growth, double growth = kGrowth) {
  FedVibration system{growth};
  VecX y(4);
  y << kStart, 1.0, 0.0, 0.0;
  Integrator<M> integrator(std::move(method));
  IntegrationOptions options{.relative_tolerance = 0.0, .absolute_tolerance = kTolerance};
  options.follow_growth = follow_growth;
  double largest = 0.0;
  const IntegrationSummary summary = integrator.run(system, 0.0, kEnd, y, options, [&](const AcceptedStep<M>& step) {
    if (step.end() > 0.9 * kEnd) largest = std::max(largest, std::abs(step.state()[0]));
  });
  EXPECT_EQ(summary.stop, StopReason::reached_end) << summary.message;
  return largest;
}

TEST(Growth, IsDampedByStepsThatAreTooLongForItAndFollowedWhereAsked) {
  // From as much as the tolerance lets pass to e^10 times that, less what steps of a radian damp.
  const RosenbrockMethod rosenbrock(rodas4(), 4);
  EXPECT_LT(end_of_vibration(rosenbrock, false), kStart);
  EXPECT_NEAR(std::log(end_of_vibration(rosenbrock, true) / kTolerance), kGrowth * kEnd, 1.0);
  const GeneralizedAlpha alpha(0.8, 4);
  EXPECT_LT(end_of_vibration(alpha, false), kStart);
  EXPECT_NEAR(std::log(end_of_vibration(alpha, true) / kTolerance), kGrowth * kEnd, 4.0);
}

TEST(Growth, OfNothingShortensNoStep) {
  for (const double growth : {-200.0, 0.0}) {
    FedVibration system{growth};
    VecX y(4), other(4);
    y << kStart, 1.0, 0.0, 0.0;
    other = y;
    Integrator<RosenbrockMethod> integrator({rodas4(), 4});
    IntegrationOptions options{.relative_tolerance = 0.0, .absolute_tolerance = kTolerance};
    const long steps = integrator.run(system, 0.0, kEnd, y, options).steps;
    options.follow_growth = true;
    EXPECT_EQ(integrator.run(system, 0.0, kEnd, other, options).steps, steps) << growth;
    EXPECT_EQ(y, other);
  }
}

TEST(Growth, AsksForStepsOfOneRadian) {
  MatX jacobian(2, 2);
  jacobian << 0.0, 1.0, -(kFast * kFast + kGrowth * kGrowth), 2.0 * kGrowth;
  EXPECT_NEAR(growing_vibration(jacobian, 1.0).step * std::hypot(kFast, kGrowth), 1.0, 1e-9);
  // Grown by less than e until the end, or damped: nothing to follow.
  EXPECT_EQ(growing_vibration(jacobian, 0.9 / kGrowth).step, std::numeric_limits<double>::infinity());
  jacobian(1, 1) = -2.0 * kGrowth;
  EXPECT_EQ(growing_vibration(jacobian, 1.0).step, std::numeric_limits<double>::infinity());
}

}  // namespace growth_test
}  // namespace boresight
