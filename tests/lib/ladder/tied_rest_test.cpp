// Shafts in two bearings with play, and other joints whose plays redundant joints tie together, without dynamics: where they rest by the
// quasistatic rung, held against closed forms and against the rungs with dynamics.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "boresight/ladder/ladder.hpp"
#include "boresight/play/joint_play.hpp"
#include "scenes.hpp"
#include "two_bearing_scenes.hpp"

namespace boresight {
namespace tied_rest_test {

constexpr double kSpan = 0.08, kHalfSleeve = 1e-3, kAxial = 20e-6, kWeight = 2.0 * 9.81;

// A horizontal shaft of 2 kg along x in bearings A at x = 0 and B at x = 80 mm, the drive at rest. at: where its weight acts [mm].
MechanismDescription shaft(const std::string& at, const std::string& clearance_A, const std::string& clearance_B) {
  const auto bearing = [](const std::string& joint, const std::string& radial, const std::string& axial) {
    return "[[clearance]]\njoint = \"" + joint + "\"\njournal = \"shaft\"\nradial = \"" + radial +
           "\"\njournal_radius = \"6 mm\"\nsleeve_length = \"2 mm\"\naxes = \"free\"\n" + axial +
           scenes::kContactAndFriction;
  };
  const std::string bodies = R"(["ground", "shaft"])";
  return read_mechanism_text(
      R"toml(format = 1
name = "shaft"
gravity = ["0 m/s^2", "0 m/s^2", "-9.81 m/s^2"]
[[body]]
name = "shaft"
mass = "2 kg"
center_of_mass = [")toml" +
          at + R"toml( mm", "0 mm", "0 mm"]
inertia = ["0.001 kg m^2", "0.002 kg m^2", "0.002 kg m^2"]
boresight = [1, 0, 0]
)toml" + scenes::gimbal_joint("A", "revolute", bodies, R"(["0 mm", "0 mm", "0 mm"])", "[1, 0, 0]", true) +
          scenes::gimbal_joint("B", "cylindrical", bodies, R"(["80 mm", "0 mm", "0 mm"])", "[1, 0, 0]", false) +
          "[motion]\nduration = \"20 ms\"\ndrives = { A = \"0\" }\n" +
          bearing("A", clearance_A, "axial = \"0.02 mm\"\ncap_radius = \"9 mm\"\n") + bearing("B", clearance_B, ""),
      "shaft.toml");
}

RunResult run(const MechanismDescription& m, const std::string& rung, const RunOptions& options = {}) {
  const auto mechanism = scenes::build(m);
  return make_rung(rung, mechanism)->run(mechanism->parameters(), options);
}

// A rigid shaft z = height + slope x on the ends of its two sleeves, each of which carries (K / 2) d^1.5 where it is pressed in by d: two
// balances in two unknowns, each falls as its unknown grows.
struct OnFourEnds {
  double clearance[2], stiffness[2], at;
  double height = 0.0, slope = 0.0, carries[2] = {0.0, 0.0};

  double end(int bearing, double x) const {
    const double z = height + slope * x, depth = std::abs(z) - clearance[bearing];
    return depth > 0.0 ? std::copysign(0.5 * stiffness[bearing] * std::pow(depth, 1.5), -z) : 0.0;
  }
  void balance() {
    const auto root = [](double& unknown, double reach, const auto& value) {
      double low = -reach, high = reach;
      for (int k = 0; k < 200; ++k) {
        unknown = 0.5 * (low + high);
        (value() > 0.0 ? low : high) = unknown;
      }
    };
    root(slope, 0.01, [&] {
      root(height, 1e-3, [&] {
        double up = -kWeight;
        for (const int bearing : {0, 1}) {
          carries[bearing] = 0.0;
          for (const double side : {-1.0, 1.0}) carries[bearing] += end(bearing, bearing * kSpan + side * kHalfSleeve);
          up += carries[bearing];
        }
        return up;
      });
      double turns = -kWeight * at;
      for (const int bearing : {0, 1})
        for (const double side : {-1.0, 1.0}) {
          const double x = bearing * kSpan + side * kHalfSleeve;
          turns += x * end(bearing, x);
        }
      return turns;
    });
  }
};

// As on the four ends; and by the lever rule, where both bearings carry: each journal at the bottom of its sleeve if its share of the weight is
// carried from below, at the top if not, pressed in by what Hertz's law gives way under it.
void expect_at_rest(double at, double clearance_A, double clearance_B, bool by_lever_rule = true) {
  const auto micrometres = [](double m) { return std::to_string(1e6 * m) + " um"; };
  const MechanismDescription m = shaft(std::to_string(1e3 * at), micrometres(clearance_A), micrometres(clearance_B));
  const RunResult r = run(m, "quasistatic");
  const std::vector<JointPlay> plays = joint_plays(m, scenes::build(m)->parameters());
  OnFourEnds shaft{{clearance_A, clearance_B}, {plays[0].normal_law().stiffness, plays[1].normal_law().stiffness}, at};
  shaft.balance();
  const double share[] = {kWeight * (kSpan - at) / kSpan, kWeight * at / kSpan};
  const PoseError& error = r.boresight.samples.back().error;
  for (int c = 0; c < 2; ++c) {
    const double pressed = std::pow(std::abs(share[c]) / plays[c].normal_law().stiffness, 2.0 / 3.0);
    const double height = error.displacement.z() - error.rotation.y() * (c * kSpan - at);
    // Along its axis the shaft lies somewhere in its play, and what is measured there is off by as much of its slope.
    const double known = 0.01 * pressed + 1.05 * kAxial * std::abs(shaft.slope);
    EXPECT_NEAR(height, shaft.height + c * kSpan * shaft.slope, known) << c;
    const Vec3& offset = r.clearances[c].back().offset;
    EXPECT_NEAR(std::hypot(offset.x(), offset.z()), std::abs(height), known) << c;
    if (!by_lever_rule) continue;
    EXPECT_NEAR(shaft.carries[c], share[c], 0.05 * kWeight) << c;  // the sleeves are short against the span
    // One end alone gives way 2^(2/3) as far, and lies half a sleeve off the middle.
    EXPECT_NEAR(height, -std::copysign((c == 0 ? clearance_A : clearance_B) + pressed, share[c]),
                0.6 * pressed + kHalfSleeve * std::abs(shaft.slope))
        << c;
  }
  EXPECT_NEAR(error.displacement.y(), 0.0, 1e-12);
  EXPECT_NEAR(error.rotation.z(), 0.0, 1e-12);
}

TEST(TiedRest, BothJournalsOfAShaftLieAtTheBottomUnderAWeightBetweenThem) {
  expect_at_rest(0.03, 20e-6, 20e-6);
  expect_at_rest(0.06, 10e-6, 25e-6);
}

TEST(TiedRest, AWeightOutsideOfTheSpanLiftsTheFarJournal) {
  expect_at_rest(0.11, 20e-6, 30e-6);
  expect_at_rest(-0.02, 20e-6, 30e-6);
}

TEST(TiedRest, ABearingWithNextToNoPlayHoldsTheShaftByItsTwoEnds) {
  expect_at_rest(0.03, 1e-9, 30e-6, false);
  expect_at_rest(0.03, 30e-6, 1e-9, false);
}

TEST(TiedRest, WithoutALoadJournalsStayInTheMiddle) {
  MechanismDescription m = shaft("30", "20 um", "20 um");
  m.gravity.setZero();
  EXPECT_LT(run(m, "quasistatic").index.position_error.max, 1e-12);
}

// Rounding must not decide whether a shaft lies in the middle of its play or at its end.
TEST(TiedRest, NextToNoPushMovesAShaftAlongItsAxisInProportion) {
  const auto along = [](double share) {
    MechanismDescription m = shaft("40", "20 um", "20 um");
    m.gravity.x() = share * 9.81;
    return run(m, "quasistatic").boresight.samples.back().error.displacement.x();
  };
  const double nothing = along(0.0), little = along(1e-7) - nothing;
  EXPECT_LT(std::abs(nothing), 1e-3 * kAxial);
  EXPECT_GT(little, 0.01 * kAxial);
  EXPECT_NEAR(along(3e-7) - nothing, 3.0 * little, 3e-3 * little);
  EXPECT_NEAR(along(-3e-7) - nothing, -3.0 * little, 3e-3 * little);
  EXPECT_LT(along(3e-7), 0.9 * kAxial);
  EXPECT_GT(along(1e-4), 0.999 * kAxial);
  EXPECT_LT(along(-1e-4), -0.999 * kAxial);
}

// A plane loop of five bars without gravity, every journal free in its sleeve: its inertia turns where the journals lie, and nothing holds them
// along the pins but their own tilt.
MechanismDescription five_bars(bool backwards, const std::string& more = "") {
  std::vector<std::string> bars, pins, plays;
  const Vec3 at[] = {{0, 0, 0}, {-0.3, 0.5, 0}, {0.4, 0.9, 0}, {1.1, 0.5, 0}, {0.8, 0, 0}};
  const auto vector = [](double x, double y, double z) {
    return "[\"" + std::to_string(x) + " m\", \"" + std::to_string(y) + " m\", \"" + std::to_string(z) + " m\"]";
  };
  for (int k = 0; k < 4; ++k) {
    const Vec3 middle = 0.5 * (at[k] + at[k + 1]);
    bars.push_back("[[body]]\nname = \"bar" + std::to_string(k) + "\"\nmass = \"" + std::to_string(10 + 15 * k) +
                   " kg\"\ncenter_of_mass = " + vector(middle.x(), middle.y(), 0.05 * k - 0.1) +
                   "\ninertia = [\"0.5 kg m^2\", \"1 kg m^2\", \"1.2 kg m^2\"]\n" +
                   (k == 3 ? "boresight = [1, 0, 0]\n" : ""));
  }
  for (int k = 0; k < 5; ++k) {
    const std::string name = "j" + std::to_string(k);
    std::string first = k == 0 ? "ground" : "bar" + std::to_string(k - 1),
                second = k == 4 ? "ground" : "bar" + std::to_string(k);
    const bool driven = k == 0 || k == 4;
    if (backwards && !driven) std::swap(first, second);
    if (k == 4) std::swap(first, second);
    pins.push_back("[[joint]]\nname = \"" + name + "\"\ntype = \"revolute\"\nconnects = [\"" + first + "\", \"" +
                   second + "\"]\npoint = " + vector(at[k].x(), at[k].y(), 0.0) + "\naxis = [0, 0, 1]\n" +
                   (driven ? "driven = true\n" : ""));
    plays.push_back("[[clearance]]\njoint = \"" + name + "\"\njournal = \"bar" + std::to_string(std::min(k, 3)) +
                    "\"\nradial = \"" + std::to_string(60 + 40 * k) +
                    " um\"\naxial = \"80 um\"\ncap_radius = \"60 mm\"\njournal_radius = \"40 mm\"\nsleeve_length = "
                    "\"120 mm\"\naxes = \"free\"\n" +
                    scenes::kContactAndFriction);
  }
  std::string text = "format = 1\nname = \"five bars\"\ngravity = [\"0 m/s^2\", \"0 m/s^2\", \"0 m/s^2\"]\n";
  for (std::vector<std::string>* list : {&bars, &pins, &plays}) {
    if (backwards) std::reverse(list->begin(), list->end());
    for (const std::string& part : *list) text += part;
  }
  return read_mechanism_text(
      text + more + "[motion]\nduration = \"0.2 s\"\ndrives = { j0 = \"0.3*t\", j4 = \"-0.2*t^2\" }\n", "five.toml");
}

// How far they lie apart in the two orders, and how far they slide along the pins.
struct InBothOrders {
  double apart = 0.0, slides = 0.0;
};
InBothOrders in_both_orders(const std::string& more) {
  const RunResult drawn = run(five_bars(false, more), "quasistatic"),
                  backwards = run(five_bars(true, more), "quasistatic");
  EXPECT_EQ(drawn.boresight.samples.size(), backwards.boresight.samples.size());
  const double along = drawn.boresight.samples.front().error.displacement.z();
  InBothOrders found;
  for (std::size_t k = 0; k < std::min(drawn.boresight.samples.size(), backwards.boresight.samples.size()); ++k) {
    const Vec3 &one = drawn.boresight.samples[k].error.displacement,
               &other = backwards.boresight.samples[k].error.displacement;
    found.slides = std::max(found.slides, std::abs(one.z() - along));
    found.apart = std::max(found.apart, (one - other).norm());
  }
  return found;
}

TEST(TiedRest, SlidesAlongWhatNothingHoldsByTheSameInAnyOrderOfTheParts) {
  const InBothOrders found = in_both_orders("");
  EXPECT_GT(found.slides, 1e-6);
  EXPECT_LT(found.apart, 1e-11);
}

TEST(TiedRest, BesideADamperThatTurnsIsTheSameInAnyOrderOfTheParts) {
  const InBothOrders found = in_both_orders(
      "[[spring]]\nconnects = [\"ground\", \"bar1\"]\npoints = [[\"0 m\", \"-0.2 m\", \"0.1 m\"], [\"0.1 m\", \"0.7 "
      "m\", "
      "\"-0.1 m\"]]\nstiffness = \"1e4 N/m\"\ndamping = \"3e4 N s/m\"\nfree_length = \"0.5 m\"\n");
  EXPECT_LT(found.apart, 1e-11);
}

TEST(TiedRest, IsWhereTheRungsWithDynamicsStart) {
  const MechanismDescription m = scenes::gimbal_by_shorthand();
  const auto first = [&](const char* rung) { return run(m, rung).clearances; };
  const auto resting = first("quasistatic"), linear = first("perturbation"), exact = first("multibody");
  ASSERT_EQ(resting.size(), 4u);
  for (std::size_t c = 0; c < resting.size(); ++c) {
    const auto start = [&](const std::vector<std::vector<ClearanceSample>>& of) { return of[c].front().offset; };
    const Vec3 rest = start(resting);
    ASSERT_GT(std::hypot(rest.x(), rest.z()), 5e-6);
    EXPECT_LT((start(linear) - rest).norm(), 1e-3 * rest.norm()) << c;
    EXPECT_LT((start(exact) - rest).norm(), 2e-3 * rest.norm()) << c;  // the square of the deviation
  }
}

TEST(TiedRest, ASlowGimbalWithoutFrictionIsFollowedByMultibodyWithinWhatTheQuasistaticRungStates) {
  MechanismDescription m = scenes::from_corpus(
      "gimbal-in-bearing-pairs", {{"motion.drives.yaw", "0.2*sin(3*t)"}, {"motion.drives.pitch", "0.15*sin(4*t)"}});
  for (ClearanceDescription& c : m.clearances) {
    c.parameters.contact.restitution = 0.2;
    c.parameters.friction.coefficient = 0.0;
  }
  const RunResult resting = run(m, "quasistatic"), exact = run(m, "multibody");
  EXPECT_LT(resting.error.largest_model(), 0.3);
  for (const auto quantity : {PointingQuantity::position_error, PointingQuantity::boresight_error}) {
    const double of_exact = exact.index.of(quantity).rms;
    ASSERT_GT(of_exact, 1e-6);
    EXPECT_NEAR(resting.index.of(quantity).rms / of_exact, 1.0, resting.error.model_of(quantity));
  }
}

// Bearing B is built 100 um beside A, of which the two plays take 20 um each: with nothing else to press on it, the shaft leans against both.
TEST(TiedRest, AnErrorThatUsesUpThePlayTiltsAShaftThatNothingLoads) {
  MechanismDescription m = shaft("40", "20 um", "20 um");
  m.gravity.setZero();
  ErrorDescription beside;
  beside.name = "beside";
  beside.kind = ErrorDescription::Kind::translation;
  beside.joint = 1;
  beside.body = kGround;
  beside.direction = Vec3::UnitZ();
  beside.value = 100e-6;
  m.errors.push_back(beside);
  const double tilt = (100e-6 - 2.0 * 20e-6) / kSpan;
  for (const char* rung : {"quasistatic", "perturbation", "multibody"}) {
    const RunResult r = run(m, rung);
    // On two edges of each sleeve, 2 mm long, it can lean a little less.
    EXPECT_NEAR(r.index.boresight_error.max / tilt, 1.0, 0.04) << rung;
    for (const ContactSummary& contact : r.contact) EXPECT_LT(contact.max_force, 1.0) << rung << ' ' << contact.joint;
  }
}

}  // namespace tied_rest_test
}  // namespace boresight
