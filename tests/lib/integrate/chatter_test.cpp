// What a contact does to the memory of the problem: changed at accepted, located events only; chatter ends in lasting
// contact, and the steps go on.
#include <gtest/gtest.h>

#include "boresight/integrate/explicit_method.hpp"
#include "boresight/integrate/generalized_alpha.hpp"
#include "boresight/integrate/rosenbrock_method.hpp"
#include "bouncing_mass.hpp"

namespace boresight {
namespace chatter_test {

using testing_scenes::BouncingMass;
using testing_scenes::state_of;

// A ball dropped on a hard floor that loses half its speed at each impact, x' = -e x': infinitely many impacts in a
// finite time.
struct HardFloor {
  double gravity = 10.0, restitution = 0.5;
  bool resting = false;
  int impacts = 0, lastings = 0;
  void derivative(double, const VecX& y, VecX& dy) const {
    dy[0] = resting ? 0.0 : y[1];
    dy[1] = resting ? 0.0 : -gravity;
  }
  int gap_count() const { return 1; }
  void gaps(double, const VecX& y, VecX& g) const { g[0] = y[0]; }
  AfterEvent on_event(const GapEvent& event, VecX& y) {
    if (event.crossing == Crossing::lasting) {
      ++lastings;
      resting = true;
      y.setZero();
      return AfterEvent::crossed;
    }
    if (event.crossing != Crossing::closing) return AfterEvent::crossed;
    ++impacts;
    y[0] = 0.0;
    y[1] *= -restitution;
    return AfterEvent::reflected;
  }
};

template <typename M>
void expect_rest(M method) {
  HardFloor floor;
  VecX y = state_of(0.05, 0.0);
  Integrator<M> integrator(std::move(method), 1);
  // Drop of 0.1 s; the impacts pile up at 0.1 (1 + e)/(1 - e) = 0.3 s.
  const IntegrationSummary summary =
      integrator.run(floor, 0.0, 1.0, y, {.relative_tolerance = 1e-6, .absolute_tolerance = 1e-9, .event_floor = 1e-5});
  EXPECT_EQ(summary.stop, StopReason::reached_end) << summary;
  EXPECT_EQ(floor.lastings, 1) << summary;
  EXPECT_TRUE(floor.resting);
  // Flights of 0.2 e^k s until one is shorter than the floor: k = 15.
  EXPECT_EQ(floor.impacts, 15) << summary;
  EXPECT_LT(summary.steps, 300) << summary;
}

TEST(Chatter, EndsInLastingContactWithoutTheStepCollapsing) {
  expect_rest(ExplicitMethod(dormand_prince54(), 2));
  expect_rest(ExplicitMethod(bogacki_shampine32(), 2));
  expect_rest(RosenbrockMethod(rodas4(), 2));
  expect_rest(GeneralizedAlpha(0.5, 2));
}

// A soft floor with losses: the ball bounces, and comes to rest within its own weight's penetration.
template <typename M>
void expect_settled(M method, double most_steps) {
  BouncingMass mass{.gravity = 10.0, .stiffness = 1e9};
  mass.flores(0.5);
  VecX y = state_of(1e-4, 0.0);
  Integrator<M> integrator(std::move(method), 1);
  IntegrationOptions options{.relative_tolerance = 0.0};
  options.absolute_tolerances = VecX::Zero(2);
  options.absolute_tolerances << 1e-8, 1e-5;
  const IntegrationSummary summary = integrator.run(mass, 0.0, 1.0, y, options);
  EXPECT_EQ(summary.stop, StopReason::reached_end) << summary;
  EXPECT_TRUE(mass.touching);
  EXPECT_NEAR(-y[0], std::pow(10.0 / 1e9, 2.0 / 3.0), 3e-8);
  EXPECT_LT(static_cast<double>(summary.steps), most_steps) << summary;
}

TEST(Chatter, OfASoftFloorSettlesAndIsSteppedOverByTheImplicitMethod) {
  expect_settled(RosenbrockMethod(rodas4(), 2), 400.0);
  expect_settled(ExplicitMethod(dormand_prince54(), 2), 2000.0);
}

// Exact memory: the ball under gravity g dropped from h arrives at sqrt(2 g h), whatever the steps; and every impact is
// told once, however many trial steps crossed it.
TEST(ImpactMemory, TakesTheSpeedAtTheEventAndNeverThatOfARejectedStep) {
  for (double tolerance : {1e-3, 1e-5, 1e-7}) {
    BouncingMass mass{.gravity = 10.0, .stiffness = 1e9};
    mass.flores(0.9);
    VecX y = state_of(1e-3, 0.0);
    Integrator<ExplicitMethod> integrator(ExplicitMethod(dormand_prince54(), 2), 1);
    const IntegrationSummary summary =
        integrator.run(mass, 0.0, 0.02, y,
                       {.relative_tolerance = tolerance, .absolute_tolerance = 1e-3 * tolerance, .first_step = 1e-2});
    ASSERT_TRUE(summary.completed()) << summary;
    ASSERT_EQ(mass.closing_times.size(), 1u) << summary;
    EXPECT_NEAR(mass.closing_times[0], std::sqrt(2.0 * 1e-3 / 10.0), 1e-12) << tolerance;
    EXPECT_NEAR(mass.closing_speeds[0], std::sqrt(2.0 * 10.0 * 1e-3), 1e-11) << tolerance;
    EXPECT_EQ(mass.impact_speed, mass.closing_speeds[0]);
    EXPECT_GT(summary.rejected_by_error, 0) << "trial steps across the impact were rejected: " << summary;
  }
}

}  // namespace chatter_test
}  // namespace boresight
