// Problems with published solutions: a ball that bounces with constant restitution, the error of fixed steps
// through an elastic impact, and the stiff classics of the Test Set for IVP Solvers (Bari).
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "boresight/integrate/explicit_method.hpp"
#include "boresight/integrate/rosenbrock_method.hpp"
#include "bouncing_mass.hpp"
#include "reference/reference.hpp"
#include "validation/printed.hpp"

namespace boresight {
namespace published_problems_test {

using testing_scenes::BouncingMass;
using testing_scenes::state_of;

// Loses the share 1 - e of its speed at each impact and rests once the impacts follow each other too closely
// to tell.
struct Ball {
  double restitution;
  bool resting = false;
  std::vector<double> impacts{};
  double rest = 0.0;
  void derivative(double, const VecX& y, VecX& dy) const {
    dy[0] = resting ? 0.0 : y[1];
    dy[1] = resting ? 0.0 : -9.81;
  }
  int gap_count() const { return 1; }
  void gaps(double, const VecX& y, VecX& g) const { g[0] = y[0]; }
  AfterEvent on_event(const GapEvent& event, VecX& y) {
    if (event.crossing == Crossing::lasting) {
      resting = true;
      rest = event.t;
      y.setZero();
      return AfterEvent::crossed;
    }
    if (event.crossing != Crossing::closing) return AfterEvent::crossed;
    impacts.push_back(event.t);
    y[0] = 0.0;
    y[1] *= -restitution;
    return AfterEvent::reflected;
  }
};

Ball dropped(double height, double restitution, double shortest_flight) {
  Ball ball{restitution};
  VecX y = state_of(height, 0.0);
  Integrator<ExplicitMethod> integrator(ExplicitMethod(dormand_prince54(), 2), 1);
  const IntegrationSummary summary = integrator.run(
      ball, 0.0, 10.0, y, {.relative_tolerance = 1e-9, .absolute_tolerance = 1e-12, .event_floor = shortest_flight});
  EXPECT_TRUE(summary.completed()) << summary;
  return ball;
}

// Times of the impacts, and when the last of infinitely many is over: sqrt(2 H / g) (1 + e) / (1 - e).
// Siconos' BouncingBallTS has the first ball at rest by 8.99 s, with steps of 5 ms.
TEST(BouncingBall, StrikesAndComesToRestWhenTheSeriesSays) {
  for (const reference::Row& row : reference::table("bouncing", "ball")) {
    const double height = row[0], restitution = row[1], end = row[2];
    const double shortest = 1e-6;
    const Ball ball = dropped(height, restitution, shortest);
    ASSERT_GE(ball.impacts.size(), row.values.size() - 3);
    for (std::size_t k = 3; k < row.values.size(); ++k) EXPECT_NEAR(ball.impacts[k - 3], row[k], 1.5e-9);
    EXPECT_TRUE(ball.resting);
    // The flights left out are a geometric series that begins below the shortest.
    EXPECT_NEAR(ball.rest, end, shortest / (1.0 - restitution));
    EXPECT_LE(ball.rest, end + 1e-9);
  }
}

// Hertz, undamped, steps that do not stop at the contact: root mean square of 1 - e over where in a step the
// contact begins, for so many steps in a contact.
TEST(FixedSteps, ThroughAnElasticImpactErrAsMuchAsComputed) {
  BouncingMass mass;
  mass.follows_memory = false;
  const double contact = reference::line("contact_laws", "undamped duration over depth and speed")[0] *
                         mass.depth(1.0);  // of an impact at 1 m/s [s]
  for (const reference::Row& row : reference::table("bouncing", "fixed steps")) {
    const double steps = row[0], error = row[1];
    const double h = contact / steps;
    double sum = 0.0;
    const int phases = 400;
    for (int k = 0; k < phases; ++k) {
      VecX y = state_of(h * (k + 0.5) / phases, -1.0);
      Integrator<ExplicitMethod> integrator(ExplicitMethod(classical_rk4(), 2), 1);
      integrator.run(mass, 0.0, 3.0 * steps * h, y, {.step = h, .locate_events = false});
      sum += std::pow(1.0 - y[1], 2.0);
    }
    EXPECT_NEAR(std::sqrt(sum / phases) / error, 1.0, 1e-3) << steps << " steps";
  }
}

// Robertson's reaction: rates 0.04, 3e7, 1e4.
struct Robertson {
  static constexpr bool autonomous = true;
  void derivative(double, const VecX& y, VecX& dy) const {
    const double a = 0.04 * y[0], b = 1e4 * y[1] * y[2], c = 3e7 * y[1] * y[1];
    dy << -a + b, a - b - c, c;
  }
  void jacobian(double, const VecX& y, MatX& j) const {
    j << -0.04, 1e4 * y[2], 1e4 * y[1], 0.04, -1e4 * y[2] - 6e7 * y[1], -1e4 * y[1], 0.0, 6e7 * y[1], 0.0;
  }
};

// y'' = mu (1 - y^2) y' - y with mu = 1000.
struct VanDerPol {
  static constexpr bool autonomous = true;
  void derivative(double, const VecX& y, VecX& dy) const { dy << y[1], 1e3 * (1.0 - y[0] * y[0]) * y[1] - y[0]; }
  void jacobian(double, const VecX& y, MatX& j) const {
    j << 0.0, 1.0, -2e3 * y[0] * y[1] - 1.0, 1e3 * (1.0 - y[0] * y[0]);
  }
};

template <typename System>
VecX solved(VecX y, double end, double tolerance, double absolute) {
  System system;
  Integrator<RosenbrockMethod> integrator(RosenbrockMethod(rodas4(), y.size()));
  const IntegrationSummary summary =
      integrator.run(system, 0.0, end, y, {.relative_tolerance = tolerance, .absolute_tolerance = absolute});
  EXPECT_TRUE(summary.completed()) << summary;
  return y;
}

// Significant correct digits of the worst component, as the test set counts them.
double digits(const VecX& y, const VecX& reference) {
  return -std::log10(((y - reference).array() / reference.array()).abs().maxCoeff());
}

TEST(StiffProblems, EndWhereTheTestSetPutsThem) {
  const Eigen::Vector3d robertson(0.2083340149701255e-7, 0.8333360770334713e-13, 0.9999999791665050);
  const VecX reaction = solved<Robertson>(Eigen::Vector3d(1.0, 0.0, 0.0), 1e11, 1e-9, 1e-22);
  EXPECT_GT(digits(reaction, robertson), 9.0);
  validation::expect_printed("Bari test set, Robertson", "y3 at 1e11 s", "0.9999999791665050", reaction[2], 1e-9);
  const Eigen::Vector2d van_der_pol(1.706167732170469, -0.8928097010248125e-3);
  const VecX oscillator = solved<VanDerPol>(Eigen::Vector2d(2.0, 0.0), 2000.0, 1e-9, 1e-12);
  EXPECT_GT(digits(oscillator, van_der_pol), 9.0);
  validation::expect_printed("Bari test set, van der Pol", "y at 2000 s", "1.706167732170469", oscillator[0], 2e-9);
  validation::expect_printed("Bari test set, van der Pol", "y' at 2000 s", "-0.0008928097010248125", oscillator[1],
                             1e-12);
}

}  // namespace published_problems_test
}  // namespace boresight
