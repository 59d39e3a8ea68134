// Friction laws against their printed points and the cases with closed forms.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "boresight/contact/contact_friction.hpp"
#include "validation/printed.hpp"

namespace boresight {
namespace friction_law_test {

FrictionParameters parameters() {
  FrictionParameters p;
  p.coefficient = 0.3;
  p.static_coefficient = 0.45;
  return p;
}

double over_normal(const FrictionLaw& law, double v) { return v * law.force_per_velocity(v); }

TEST(Threlfall, RisesTo95PercentWithoutAJump) {
  const FrictionLaw law = make_friction_law("threlfall", parameters());
  EXPECT_EQ(over_normal(law, 0.0), 0.0);
  EXPECT_NEAR(over_normal(law, 0.5e-3), 0.3 * (1.0 - std::exp(-1.5)), 1e-15);
  validation::expect_printed("Threlfall 1978", "share of mu from v_d on; the printed value jumps by 0.0002", "0.95",
                             over_normal(law, 1e-3) / 0.3, 0.0003);
  EXPECT_NEAR(over_normal(law, 1e-3), over_normal(law, 1.0001e-3), 1e-15);
}

TEST(BengisuAkay, PeaksAtTheStaticCoefficientAndDecaysToTheKineticOne) {
  const FrictionLaw law = make_friction_law("bengisu-akay", parameters());
  EXPECT_EQ(over_normal(law, 0.0), 0.0);
  validation::expect_printed("Bengisu, Akay 1994", "friction over normal force at the static peak, 0.45 given", "0.45",
                             over_normal(law, 1e-3), 1e-15);
  EXPECT_NEAR(over_normal(law, 11e-3), 0.3 + 0.15 * std::exp(-1.0), 1e-15);
  EXPECT_NEAR(over_normal(law, 1.0), 0.3, 1e-12);
  // Slopes meet at the peak only where both vanish or the decay begins: continuous.
  EXPECT_NEAR(over_normal(law, 1e-3 - 1e-12), over_normal(law, 1e-3 + 1e-12), 1e-10);
}

TEST(BrownMcPhee, HasItsPrintedValueAtTheTransitionSpeed) {
  const FrictionLaw law = make_friction_law("brown-mcphee", parameters());
  validation::expect_printed("Brown, McPhee 2016, tanh 4", "share of the kinetic friction at the transition speed",
                             "0.999329299739067", (over_normal(law, 1e-3) - 0.15) / 0.3, 1e-11);
  EXPECT_NEAR(over_normal(law, 1.0), 0.3, 1e-6);
  double highest = 0.0;
  for (double v = 1e-5; v < 1e-2; v += 1e-6) highest = std::max(highest, over_normal(law, v));
  EXPECT_NEAR(highest, 0.45, 1e-3);
}

TEST(FrictionLaws, AreContinuousZeroAtRestAndNeverAboveTheStaticCoefficient) {
  for (const FrictionLawEntry& entry : friction_laws()) {
    const FrictionLaw law = make_friction_law(entry.name, parameters());
    double before = 0.0;
    for (double v = 0.0; v < 3e-3; v += 1e-7) {
      const double f = over_normal(law, v);
      ASSERT_TRUE(std::isfinite(f)) << entry.name;
      ASSERT_LE(f, 0.45 + 1e-3) << entry.name;
      ASSERT_NEAR(f, before, 3e-4) << entry.name << " at " << v;  // steepest: 4 mu / v_d
      before = f;
    }
  }
}

// A block of 1 kg with LuGre friction under a normal force of 1 N: x, v, z from the start, RK4.
struct Block {
  double x, v, z;
};
template <typename Force, typename Seen>
void follow(const LuGreT<double>& law, Block b, double belt, double duration, double h, const Force& force,
            const Seen& seen) {
  using State = Eigen::Vector3d;
  const auto derivative = [&](double t, const State& y) {
    const auto traction = law.traction({y[1] - belt, 0.0}, {y[2], 0.0}, std::numeric_limits<double>::infinity());
    return State(y[1], force(t, y[0]) + traction.force[0], traction.rate[0]);
  };
  State y(b.x, b.v, b.z);
  const long steps = std::lround(duration / h);
  for (long k = 0; k <= steps; ++k) {
    const double t = k * h;
    seen(t, y);
    const State k1 = derivative(t, y), k2 = derivative(t + 0.5 * h, y + 0.5 * h * k1);
    const State k3 = derivative(t + 0.5 * h, y + 0.5 * h * k2), k4 = derivative(t + h, y + h * k3);
    y += h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
  }
}

LuGreT<double> demonstration() {  // Canudas de Wit et al. (1995), table 1
  LuGreT<double> law;
  law.kinetic = 1.0;
  law.stiction = 1.5;
  law.stribeck_speed = 1e-3;
  law.damping_speed = 1e9;  // theirs does not decay
  law.bristle_stiffness = 1e5;
  law.bristle_damping = std::sqrt(1e5);
  return law;
}

TEST(LuGre, HoldsALoadBelowTheStaticCoefficientWhereCoulombCreeps) {
  // 1.2 N for 0.5 s: the bristles bend by 1.2e-5 m and then nothing moves.
  double middle = 0.0, last = 0.0;
  follow(
      demonstration(), {0.0, 0.0, 0.0}, 0.0, 0.5, 2e-5, [](double t, double) { return 1.2 * std::min(1.0, t / 0.1); },
      [&](double t, const Eigen::Vector3d& y) {
        if (t < 0.3) middle = y[0];
        last = y[0];
      });
  EXPECT_NEAR(last - middle, 0.0, 2e-6);  // modified Coulomb would creep by more than v_s * 0.2 s = 2e-5 m
  EXPECT_LT(last, 5e-5);
}

TEST(LuGre, SlidesUnderTheKineticCoefficient) {
  LuGreT<double> law = demonstration();
  for (const double v : {0.05, 0.5, 5.0}) {
    // The steady deflection g / s0.
    const auto traction = law.traction({v, 0.0}, {1.0 / 1e5, 0.0}, 1e300);
    EXPECT_NEAR(traction.rate[0], 0.0, 1e-9 * v);
    EXPECT_NEAR(traction.force[0], -1.0, 1e-8);
  }
}

// The bound on how fast bristles relax leaves the steady force of sliding alone.
TEST(LuGre, KeepsItsSteadyForceWhereTheStepCannotFollowTheBristles) {
  LuGreT<double> law = demonstration();
  law.bristle_damping = 0.0;
  Eigen::Vector2d z(0.0, 0.0);
  const double h = 1e-4;
  for (int k = 0; k < 40; ++k) z += h * law.traction({3.0, 4.0}, z, 1.0 / h).rate;  // relaxes at 5e5 1/s unbounded
  const Eigen::Vector2d force = law.traction({3.0, 4.0}, z, 1.0 / h).force;
  EXPECT_NEAR(force[0], -0.6, 1e-9);
  EXPECT_NEAR(force[1], -0.8, 1e-9);
}

// Block of 1 kg on a belt of 0.1 m/s held by a spring of 2 N/m, static and kinetic friction 1.5 and 1 N. Coulomb's friction lets it slip first
// when the spring holds 1.5 N, and then swing about 0.5 m, where the spring holds 1 N, until it moves with the belt again. LuGre's bristles
// creep while they bend, and break away early: stiffer ones come closer.
TEST(LuGre, SticksAndSlipsOnABeltAsCoulombsFrictionDoesTheMoreTheStifferItsBristles) {
  struct Figures {
    double first = 0.0, period = 0.0, highest = 0.0, lowest = 1.0, slowest = 0.0;
  };
  const auto with_bristles = [](double stiffness, double h) {
    LuGreT<double> law = demonstration();
    law.bristle_stiffness = stiffness;
    Figures f;
    bool sticking = true;
    follow(
        law, {0.0, 0.1, 0.0}, 0.1, 16.0, h, [](double, double x) { return -2.0 * x; },
        [&](double t, const Eigen::Vector3d& y) {
          f.highest = std::max(f.highest, y[0]);
          if (f.first > 0.0) f.lowest = std::min(f.lowest, y[0]);
          f.slowest = std::min(f.slowest, y[1]);
          const bool sticks = std::abs(y[1] - 0.1) < 0.005;
          if (sticking && !sticks) (f.first == 0.0 ? f.first : f.period) = t - f.first;
          sticking = sticks;
        });
    return f;
  };
  // x = 0.5 + 0.25 cos wt + (v / w) sin wt from the slip on, until it has the belt's speed again, at 0.25 m; then the belt takes it 0.5 m on.
  constexpr double v = 0.1, k = 2.0, stuck_again = 0.25;
  const double w = std::sqrt(k), amplitude = std::hypot(0.25, v / w);
  const double first = 0.75 / v,
               period = (std::numbers::pi + 2.0 * std::atan2(v / w, 0.25)) / w + (0.75 - stuck_again) / v;
  const double highest = 0.5 + amplitude, lowest = 0.5 - amplitude, slowest = -w * amplitude;
  const Figures soft = with_bristles(1e5, 4e-5), stiff = with_bristles(1e6, 4e-6);
  EXPECT_NEAR(soft.first / first, 1.0, 0.01);
  EXPECT_NEAR(soft.period / period, 1.0, 0.02);
  EXPECT_NEAR(soft.highest, highest, 0.01);
  EXPECT_NEAR(soft.lowest, lowest, 0.01);
  EXPECT_LT(std::abs(stiff.first - first), 0.8 * std::abs(soft.first - first));
  EXPECT_LT(std::abs(stiff.period - period), 0.5 * std::abs(soft.period - period));
  EXPECT_NEAR(stiff.slowest / slowest, 1.0, 0.01);
  EXPECT_LT(std::abs(stiff.slowest - slowest), 0.5 * std::abs(soft.slowest - slowest));
  EXPECT_LT(std::abs(stiff.highest - highest), 0.5 * std::abs(soft.highest - highest));
}

// Closed forms of Coulomb's friction, to the accuracy that a law regularised at 1 mm/s allows.
TEST(FrictionLaws, LetABlockSlideDownAnInclineAsCoulombsDoes) {
  const double slope = 20.0 * M_PI / 180.0, g = 9.81;
  for (const double mu : {0.1, 0.3})
    for (const FrictionLawEntry& entry : friction_laws()) {
      if (entry.kind == FrictionKind::none || entry.kind == FrictionKind::lugre) continue;
      FrictionParameters p;
      p.coefficient = mu;
      const FrictionLaw law = make_friction_law(entry.name, p);
      double v = 0.0;
      const double h = 1e-5;
      for (int k = 0; k < 100000; ++k) v += h * (g * std::sin(slope) - g * std::cos(slope) * over_normal(law, v));
      const double factor = entry.kind == FrictionKind::threlfall ? 1.0 - std::exp(-3.0) : 1.0;
      EXPECT_NEAR(v, g * (std::sin(slope) - factor * mu * std::cos(slope)), 2e-3) << entry.name;  // v_d is 1e-3 m/s
    }
}

TEST(FrictionLaws, BringASlidingSphereToRollAsCoulombsDoes) {
  // It slides at -mu g and spins up at 5/2 mu g until both meet, at 5/7 of its speed: after 2 v0 / (7 mu g).
  constexpr double v0 = 2.0, mu = 0.2, g = 9.81, rolls_from = 2.0 * v0 / (7.0 * mu * g),
                   on_the_way = v0 * rolls_from - 0.5 * mu * g * rolls_from * rolls_from;
  for (const char* name : {"modified-coulomb", "brown-mcphee", "bengisu-akay"}) {
    FrictionParameters p;
    p.coefficient = 0.2;
    const FrictionLaw law = make_friction_law(name, p);
    double v = 2.0, spin = 0.0, rolling = 0.0, way = 0.0;  // spin times radius
    const double h = 1e-5;
    for (int k = 0; k < 40000; ++k) {
      const double slip = v - spin, f = std::copysign(over_normal(law, std::abs(slip)), slip) * 9.81;
      v -= h * f;
      spin += 2.5 * h * f;
      if (rolling == 0.0) way += h * v;
      if (rolling == 0.0 && v - spin < 2e-3) rolling = k * h;
    }
    EXPECT_NEAR(v, 5.0 / 7.0 * v0, 1e-3) << name;
    EXPECT_NEAR(rolling, rolls_from, 1e-3) << name;
    EXPECT_NEAR(way, on_the_way, 1e-3 * 10.0 / 7.0) << name;
  }
}

TEST(FrictionLaws, TurnACoulombOscillatorWhereTheoryForesees) {
  // m = 1, k = 100: each half period, of pi / 10 s, takes 2 mu g / k = 0.01962 m off the amplitude; after the fifth the spring is weaker
  // than friction, and it sticks.
  const double lost = 2.0 * 0.1 * 9.81 / 100.0;
  double turning[5];
  for (int n = 0; n < 5; ++n) turning[n] = (n % 2 == 0 ? -1.0 : 1.0) * (0.1 - (n + 1) * lost);
  FrictionParameters p;
  p.coefficient = 0.1;
  p.static_speed = 1e-7;
  p.dynamic_speed = 1e-4;
  const FrictionLaw law = make_friction_law("modified-coulomb", p);
  double x = 0.1, v = 0.0;
  int turns = 0;
  const double h = 1e-6;
  for (int k = 0; k < 2000000; ++k) {
    const double before = v;
    v += h * (-100.0 * x - std::copysign(9.81 * over_normal(law, std::abs(v)), v));
    x += h * v;
    if (k > 1000 && before * v < 0.0) {
      ASSERT_LT(turns, 5);
      EXPECT_NEAR(x, turning[turns], 2e-5);
      EXPECT_NEAR(k * h, 0.1 * std::numbers::pi * (turns + 1), 3e-4);
      ++turns;
    }
  }
  EXPECT_EQ(turns, 5);
  // What the law lets it creep: v_s + (v_d - v_s) k x / (mu m g).
  EXPECT_LT(std::abs(v), 1e-7 + 1e-4 * 0.19 / 0.981 + 1e-6);
}

}  // namespace friction_law_test
}  // namespace boresight
