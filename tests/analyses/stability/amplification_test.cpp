// Limits of stability in theory and in measurement: on the axes, and Baumgarte's table.
#include "boresight_analyses/stability/amplification.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "boresight/formulations/ideal_simulation.hpp"
#include "boresight_analyses/stability/baumgarte_drift.hpp"
#include "boresight_analyses/stability/contact_oscillator.hpp"
#include "reference/reference.hpp"
#include "scenes.hpp"

namespace boresight {
namespace amplification_test {

TEST(MeasuredGrowth, IsTheLargerOfTwoPowers) {
  std::vector<double> real, complex;
  for (int n = 0; n < 12; ++n) {
    real.push_back(std::pow(0.9, n) - 0.4 * std::pow(-0.7, n));
    complex.push_back(std::pow(1.05, n) * std::cos(0.7 * n + 0.2));
  }
  EXPECT_NEAR(measured_growth(real), 0.9, 1e-12);
  EXPECT_NEAR(measured_growth(complex), 1.05, 1e-12);
  // Two powers are two unknowns: four values tell them, three do not.
  EXPECT_NEAR(measured_growth(std::vector<double>(real.begin(), real.begin() + 4)), 0.9, 1e-12);
  EXPECT_TRUE(std::isnan(measured_growth(std::vector<double>(real.begin(), real.begin() + 3))));
}

// The axes' limits (tests/reference/stability_limits.py) are the roots of |R| = 1 for R = 1 + z + z^2/2 + z^3/6 + z^4/24.
TEST(Rk4, HoldsALinearContactUpToTheLimitsOfTheory) {
  for (double omega : {2e3, 1.7e4}) {
    const auto undamped = [&](double z) {
      return measured_growth(classical_rk4(), ContactOscillator::of(0.8, omega, 0.0), z / omega);
    };
    EXPECT_NEAR(measured_limit(undamped, 2.8) / (2.0 * std::numbers::sqrt2), 1.0, 1e-4);
    // Nothing but a damper: the root -c/m on the real axis.
    const auto damped = [&](double z) {
      return measured_growth(classical_rk4(), {0.8, 1e-9 * omega * omega, 0.8 * omega}, z / omega);
    };
    EXPECT_NEAR(measured_limit(damped, 2.8) / reference::line("stability_limits", "axes")[0], 1.0, 1e-4);
  }
}

TEST(ExplicitPairs, HoldALinearContactUpToTheLimitsOfTheirTables) {
  for (const ExplicitTable* table : {&dormand_prince54(), &bogacki_shampine32()}) {
    const double omega = 5e3;
    const auto undamped = [&](double z) {
      return measured_growth(*table, ContactOscillator::of(1.0, omega, 0.0), z / omega);
    };
    const auto damped = [&](double z) {
      return measured_growth(*table, {1.0, 1e-9 * omega * omega, omega}, z / omega);
    };
    EXPECT_NEAR(measured_limit(undamped, table->imaginary_limit) / table->imaginary_limit, 1.0, 1e-3) << table->name;
    EXPECT_NEAR(measured_limit(damped, table->real_limit) / table->real_limit, 1.0, 1e-4) << table->name;
  }
}

TEST(Baumgarte, LimitsOfTheoryAreThoseOfTheTable) {
  const MethodCoefficients rk4 = coefficients(classical_rk4());
  for (const reference::Row& row : reference::table("stability_limits", "baumgarte"))  // zeta, largest stable beta h
    EXPECT_NEAR(theoretical_limit(rk4, row[0]) / row[1], 1.0, 1e-6) << row[0];
  // |R| per step of alpha h and beta h.
  for (const reference::Row& row : reference::table("stability_limits", "growth"))
    EXPECT_NEAR(theoretical_growth(rk4, row[0], row[1]), row[2], 1e-9) << row[0];
}

class DriftOfTheDefaultScene : public testing::Test {
 protected:
  std::shared_ptr<const Mechanism> mechanism_ = scenes::build(scenes::rrcpr());
  IdealMotion ideal_ = ideal_motion(*mechanism_, mechanism_->parameters());
  BaumgarteDrift drift_{*mechanism_, ideal_};
};

TEST_F(DriftOfTheDefaultScene, MeetsTheLimitsOfTheTable) {
  for (const reference::Row& row : reference::table("stability_limits", "baumgarte"))
    EXPECT_NEAR(baumgarte_limit(drift_, row[0]).measured / row[1], 1.0, 0.005) << row[0];
}

TEST_F(DriftOfTheDefaultScene, ShrinksPerStepAsTheAmplificationMatrixSays) {
  int held = 0;
  for (const reference::Row& row : reference::table("stability_limits", "growth")) {
    if (row[0] < 0.1) continue;  // the drift is too small a part of the motion
    ++held;
    EXPECT_NEAR(drift_.growth(row[0], row[1]), row[2], row[0] < 0.5 ? 1e-4 : 1e-3) << row[0];
  }
  EXPECT_EQ(held, 4);
}

// With alpha = beta = a the violation is w t exp(-a t): its peak w/(e a) stands at t = 1/a.
TEST_F(DriftOfTheDefaultScene, AfterAWrongVelocityPeaksAsTheoryForesees) {
  const double a = 2e4, h = 1e-6;
  double w = 0.0;
  const std::vector<double> violation = drift_.after_a_wrong_velocity(a, a, h, 150, w);
  const auto peak = std::max_element(violation.begin(), violation.end(),
                                     [](double x, double y) { return std::abs(x) < std::abs(y); });
  EXPECT_NEAR(*peak * std::numbers::e * a / w, 1.0, 1e-3);
  EXPECT_NEAR(static_cast<double>(peak - violation.begin()) * h * a, 1.0, 0.05);
}

TEST_F(DriftOfTheDefaultScene, WithoutStabilisationAWrongVelocityIsNeverForgotten) {
  double w = 0.0;
  const std::vector<double> violation = drift_.after_a_wrong_velocity(0.0, 0.0, 1e-6, 100, w);
  EXPECT_NEAR(violation[100] / (w * 1e-4), 1.0, 1e-3);
  EXPECT_NEAR(violation[50] / (w * 5e-5), 1.0, 1e-3);
}

}  // namespace amplification_test
}  // namespace boresight
