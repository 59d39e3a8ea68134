// How long a step may be, measured on runs and not on the table: the limit of RK4 against theory (2.785 on the real
// axis, 2 sqrt 2 on the imaginary; Hairer and Wanner 1996, section IV.2).
#include <gtest/gtest.h>

#include <cmath>

#include "boresight/integrate/explicit_method.hpp"
#include "boresight/integrate/integrator.hpp"

namespace boresight {
namespace stability_test {

struct Decay {
  void derivative(double, const VecX& y, VecX& dy) const { dy = -y; }
};
struct Vibration {
  void derivative(double, const VecX& y, VecX& dy) const {
    dy[0] = y[1];
    dy[1] = -y[0];
  }
};

// Whether a thousand steps of h let a unit start grow.
template <typename S>
bool grows(const ExplicitTable& table, double h, Eigen::Index size) {
  S system;
  VecX y = VecX::Constant(size, 1.0);
  Integrator<ExplicitMethod> integrator(ExplicitMethod(table, size));
  const IntegrationSummary summary = integrator.run(system, 0.0, 1000.0 * h, y, {.step = h});
  return !summary.completed() || y.norm() > std::sqrt(static_cast<double>(size));
}

template <typename S>
double measured_limit(const ExplicitTable& table, Eigen::Index size) {
  double stable = 0.5, unstable = 8.0;
  while (unstable - stable > 1e-4) {
    const double h = 0.5 * (stable + unstable);
    (grows<S>(table, h, size) ? unstable : stable) = h;
  }
  return 0.5 * (stable + unstable);
}

TEST(Stability, OfRk4EndsWhereTheorySays) {
  EXPECT_NEAR(measured_limit<Decay>(classical_rk4(), 1) / 2.785, 1.0, 0.02);
  EXPECT_NEAR(measured_limit<Vibration>(classical_rk4(), 2) / (2.0 * std::sqrt(2.0)), 1.0, 0.02);
}

TEST(Stability, OfThePairOnDecayEndsWhereItsConstantSays) {
  EXPECT_NEAR(measured_limit<Decay>(dormand_prince54(), 1) / dormand_prince54().real_limit, 1.0, 0.02);
}

}  // namespace stability_test
}  // namespace boresight
