// Orders through one contact, y'' = F/m - g with F = K d^1.5 (1 + h d'/d'0): what steps that do not stop at contact
// lose, what stopping at it gives back, and what the rough start of the force itself takes.
#include <gtest/gtest.h>

#include <cstdio>

#include "boresight/integrate/explicit_method.hpp"
#include "boresight/integrate/rosenbrock_method.hpp"
#include "bouncing_mass.hpp"

namespace boresight {
namespace contact_order_test {

using testing_scenes::BouncingMass;
using testing_scenes::state_of;

// A mass thrown at the floor at 1 m/s under a load of 2000 m/s^2 (strong, so that a speed latched late differs),
// damped: one contact of about 0.3 ms.
BouncingMass scene() {
  BouncingMass mass{.gravity = 2000.0, .stiffness = 1e10};
  mass.flores(0.7);
  return mass;
}
constexpr double kHeight = 1e-4, kSpeed = 1.0, kEnd = 6e-4;
double impact_speed() { return std::sqrt(kSpeed * kSpeed + 2.0 * 2000.0 * kHeight); }

// The answer that all others are held against: steps under error control at rounding level, events located.
const VecX& exact() {
  static const VecX y = [] {
    BouncingMass mass = scene();
    Integrator<ExplicitMethod> integrator(ExplicitMethod(dormand_prince54(), 2), 1);
    VecX state = state_of(kHeight, -kSpeed);
    integrator.run(mass, 0.0, kEnd, state, {.relative_tolerance = 1e-13, .absolute_tolerance = 1e-17});
    return state;
  }();
  return y;
}

// Root mean square over many phases of the first step against the contact; position over depth and speed over speed.
template <typename Run>
double error_over_phases(Run&& run) {
  double sum = 0.0;
  const int phases = 24;
  for (int k = 0; k < phases; ++k) {
    VecX error = run((k + 0.5) / phases) - exact();
    error[0] *= 1e4;
    sum += error.squaredNorm();
  }
  return std::sqrt(sum / phases);
}

// Plain steps of h, the first one a share of h.
template <typename M, typename S>
VecX with_steps(const M& method, S mass, double h, double phase, IntegrationOptions options) {
  Integrator<M> integrator(method, 1);
  VecX y = state_of(kHeight, -kSpeed);
  options.step = h;
  IntegrationSummary first = integrator.run(mass, 0.0, phase * h, y, options);
  const IntegrationSummary rest = integrator.run(mass, phase * h, kEnd, y, options);
  EXPECT_TRUE(first.completed() && rest.completed()) << rest;
  return y;
}

template <typename M>
double observed_order(const M& method, const BouncingMass& mass, const IntegrationOptions& options, double h) {
  const auto error = [&](double step) {
    return error_over_phases([&](double phase) { return with_steps(method, mass, step, phase, options); });
  };
  const double coarse = error(h), fine = error(h / 8.0);
  const double order = std::log(coarse / fine) / std::log(8.0);
  std::printf("    %-22s h %.2e: %.2e, h/8: %.2e, order %.2f\n", method.name(), h, coarse, fine, order);
  return order;
}

const ExplicitMethod rk4(classical_rk4(), 2), pair(dormand_prince54(), 2), loose_pair(bogacki_shampine32(), 2);
const RosenbrockMethod rosenbrock(rodas4(), 2), loose_rosenbrock(rodas3(), 2);

// The impact speed is known exactly, so that nothing but the steps across the edge of the force errs.
BouncingMass scene_with_known_speed() {
  BouncingMass mass = scene();
  mass.follows_memory = false;
  mass.touching = true;
  mass.impact_speed = impact_speed();
  return mass;
}
// Never told of events, so it keeps that speed.
struct KeepsItsSpeed : BouncingMass {
  AfterEvent on_event(const GapEvent&, VecX&) { return AfterEvent::crossed; }
};

TEST(Contact, HoldsStepsThatDoNotStopAtItToOrderTwoAndAHalf) {
  const KeepsItsSpeed mass{scene_with_known_speed()};
  const auto order = [&](const auto& method) {
    const auto error = [&](double step) {
      return error_over_phases(
          [&](double phase) { return with_steps(method, mass, step, phase, {.locate_events = false}); });
    };
    const double coarse = error(8e-6), fine = error(1e-6);
    std::printf("    %-22s %.2e, %.2e, order %.2f\n", method.name(), coarse, fine,
                std::log(coarse / fine) / std::log(8.0));
    return std::log(coarse / fine) / std::log(8.0);
  };
  EXPECT_NEAR(order(rk4), 2.5, 0.2);
  EXPECT_NEAR(order(pair), 2.5, 0.2);
}

TEST(Contact, HoldsALateLatchedSpeedToOrderOne) {
  // Latched at the end of the step that found the contact, as an integrator without located events would.
  BouncingMass mass = scene();
  mass.follows_memory = false;
  mass.impact_speed = impact_speed();
  EXPECT_NEAR(observed_order(rk4, mass, {.locate_events = false}, 4e-6), 1.0, 0.15);
}

// Stopping at the event is not enough: the force grows as the 1.5th power of the time since, so that the solution has
// no fourth derivative where the step begins.
TEST(Contact, StillHoldsUniformStepsToOrderTwoAndAHalfWhenTheyStopAtIt) {
  EXPECT_NEAR(observed_order(rk4, scene(), {}, 8e-6), 2.5, 0.2);
}

TEST(Contact, LetsStepsThatStopAtItAndAreGradedHaveTheirFullOrder) {
  // Down to where the rounding of the event's time begins to show.
  EXPECT_NEAR(observed_order(rk4, scene(), {.grading_time = 1e-4}, 1.6e-5), 4.0, 0.3);
  EXPECT_NEAR(observed_order(loose_pair, scene(), {.grading_time = 1e-4}, 1.6e-5), 3.0, 0.3);
  EXPECT_GT(observed_order(pair, scene(), {.grading_time = 1e-4, .grading_power = 3.0}, 3.2e-5), 4.7);
  EXPECT_NEAR(observed_order(rosenbrock, scene(), {.grading_time = 1e-4}, 1.6e-5), 4.0, 0.3);
  EXPECT_NEAR(observed_order(loose_rosenbrock, scene(), {.grading_time = 1e-4}, 1.6e-5), 3.0, 0.3);
}

// Where the force begins smoothly (linear stiffness, as of the axial faces), stopping is enough.
TEST(Contact, OfLinearStiffnessNeedsNothingButStoppingAtIt) {
  BouncingMass mass{.gravity = 2000.0, .stiffness = 1e8, .power = 1.0};
  BouncingMass across = mass;
  across.follows_memory = false;
  across.touching = true;
  const auto error = [&](const BouncingMass& system, double h, bool locate) {
    VecX reference = state_of(kHeight, -kSpeed);
    BouncingMass copy = mass;
    Integrator<ExplicitMethod>(pair, 1).run(copy, 0.0, kEnd, reference,
                                            {.relative_tolerance = 1e-13, .absolute_tolerance = 1e-17});
    double sum = 0.0;
    for (int k = 0; k < 24; ++k) {
      VecX difference = with_steps(rk4, system, h, (k + 0.5) / 24, {.locate_events = locate}) - reference;
      difference[0] *= 1e4;
      sum += difference.squaredNorm();
    }
    return std::sqrt(sum / 24);
  };
  // Where a step meets the end of the contact depends on where one met its start, so that single steps scatter: a fit
  // over ten.
  double n = 0.0, sx = 0.0, sy = 0.0, sxx = 0.0, sxy = 0.0;
  for (double h = 8e-6; n < 10.0; h *= 0.67, ++n) {
    const double x = std::log(h), y = std::log(error(across, h, false));
    sx += x, sy += y, sxx += x * x, sxy += x * y;
  }
  EXPECT_NEAR((n * sxy - sx * sy) / (n * sxx - sx * sx), 2.0, 0.2);
  EXPECT_NEAR(std::log(error(mass, 1.6e-5, true) / error(mass, 2e-6, true)) / std::log(8.0), 4.0, 0.2);
}

// Under error control the steps grade themselves: error against the number of steps has the full order.
template <typename M>
double work_order(const M& method, double loose, double tight) {
  double error[2], steps[2];
  for (int i = 0; i < 2; ++i) {
    BouncingMass mass = scene();
    VecX y = state_of(kHeight, -kSpeed);
    IntegrationOptions options{.relative_tolerance = i == 0 ? loose : tight};
    options.absolute_tolerances = VecX::Zero(2);
    options.absolute_tolerances << 1e-4 * options.relative_tolerance, options.relative_tolerance;
    Integrator<M> integrator(method, 1);
    const IntegrationSummary summary = integrator.run(mass, 0.0, kEnd, y, options);
    EXPECT_TRUE(summary.completed()) << summary;
    EXPECT_EQ(summary.closings, 1);
    EXPECT_EQ(summary.openings, 1);
    error[i] = std::hypot(1e4 * (y[0] - exact()[0]), y[1] - exact()[1]);
    steps[i] = static_cast<double>(summary.steps);
    std::printf("    %-22s tolerance %.0e: error %.2e, steps %ld, rejected %ld, evaluations %ld\n", method.name(),
                options.relative_tolerance, error[i], summary.steps, summary.rejected(), summary.cost.evaluations);
  }
  return std::log(error[0] / error[1]) / std::log(steps[1] / steps[0]);
}

TEST(Contact, LetsErrorControlKeepTheFullOrderInStepsTaken) {
  EXPECT_GT(work_order(loose_pair, 1e-5, 1e-9), 2.7);
  EXPECT_GT(work_order(pair, 1e-6, 1e-11), 4.5);
  EXPECT_GT(work_order(rosenbrock, 1e-5, 1e-9), 3.6);
  EXPECT_GT(work_order(loose_rosenbrock, 1e-5, 1e-9), 2.7);
}

}  // namespace contact_order_test
}  // namespace boresight
