#include "boresight/play/journal/ring_contact.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace boresight {
namespace ring_contact_test {

// Force, moment over radius and energy of the ring by the midpoint rule, which converges fast on periodic functions.
struct Sum {
  double force = 0.0, moment = 0.0, energy = 0.0;
};
Sum quadrature(double stiffness, double depth, double swing) {
  constexpr int kPoints = 200000;
  Sum sum;
  for (int i = 0; i < kPoints; ++i) {
    const double c = std::cos(2.0 * std::numbers::pi * (i + 0.5) / kPoints), d = depth + swing * c;
    if (d <= 0.0) continue;
    sum.force += stiffness * d / kPoints;
    sum.moment += stiffness * d * c / kPoints;
    sum.energy += 0.5 * stiffness * d * d / kPoints;
  }
  return sum;
}

TEST(RingContact, IsTheIntegralOverTheRing) {
  const double K = 4e8, A = 2e-5;
  for (double share : {-1.5, -0.999, -0.9, -0.3, 0.0, 0.4, 0.95, 1.0, 1.7, 30.0}) {
    const Sum expected = quadrature(K, share * A, A);
    const RingForce<double> ring = ring_contact(K, share * A, A);
    EXPECT_NEAR(ring.force, expected.force, 1e-9 * K * A) << share;
    EXPECT_NEAR(ring.force * ring.moment_arm, expected.moment, 1e-9 * K * A) << share;
    EXPECT_NEAR(ring.energy, expected.energy, 1e-9 * K * A * A) << share;
  }
}

TEST(RingContact, IsThePapersLinearForceWithoutTilt) {
  const RingForce<double> ring = ring_contact(3e8, 1e-6, 0.0);
  EXPECT_DOUBLE_EQ(ring.force, 300.0);
  EXPECT_EQ(ring.moment_arm, 0.0);
  EXPECT_EQ(ring_contact(3e8, -1e-6, 0.0).force, 0.0);
}

TEST(RingContact, PassesSmoothlyFromAPointToTheWholeRing) {
  const double K = 4e8, A = 2e-5;
  for (double at : {-1.0, 1.0})
    for (double step : {1e-3, 1e-5, 1e-7}) {
      const RingForce<double> before = ring_contact(K, (at - step) * A, A), after = ring_contact(K, (at + step) * A, A);
      EXPECT_LT(std::abs(after.force - before.force), 2.1 * step * K * A);
      EXPECT_LT(std::abs(after.force * after.moment_arm - before.force * before.moment_arm), 2.1 * step * K * A);
    }
  // A contact that is about to part carries all its force at one point of the ring.
  EXPECT_NEAR(ring_contact(K, -0.99999 * A, A).moment_arm, 1.0, 1e-4);
}

}  // namespace ring_contact_test
}  // namespace boresight
