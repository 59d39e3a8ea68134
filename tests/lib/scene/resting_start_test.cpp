// Journals that start at rest: under constant loads nothing moves, on any rung, formulation or integrator.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "boresight/formulations/ideal_simulation.hpp"
#include "boresight/io/mechanism_file.hpp"
#include "boresight/ladder/ladder.hpp"
#include "boresight/scene/starting_journals.hpp"

namespace boresight {
namespace resting_start_test {

using Settings = std::vector<Setting>;

std::shared_ptr<const Mechanism> mechanism(const std::string& example, Settings more) {
  more.push_back({"initial.journals", "rest"});
  more.push_back({"motion.duration", "30 ms"});
  return std::make_shared<const Mechanism>(read_mechanism(std::string(BORESIGHT_EXAMPLES) + "/" + example, more));
}

// Drives that stand still, away from home and from any symmetry.
std::shared_ptr<const Mechanism> standing_four_bar(Settings more = {}) {
  more.push_back({"motion.drives.A", "0.3"});
  return mechanism("four-bar/four-bar.toml", std::move(more));
}
std::shared_ptr<const Mechanism> standing_platform(const std::string& file, Settings more = {}) {
  for (const Setting& s : Settings{{"motion.angles.psi", "0.4"},
                                   {"motion.angles.theta", "0.2"},
                                   {"motion.angles.phi", "-0.4"},
                                   {"motion.position.z", "500*cos(theta)"}})
    more.push_back(s);
  return mechanism("3-rrcpr/" + file, std::move(more));
}

struct RungSetup {
  const char *rung, *integrator, *formulation, *stabilisation;
};
const RungSetup kWays[] = {{"perturbation", "rk4", "", ""},
                           {"perturbation", "dopri5", "", ""},
                           {"perturbation", "rosenbrock", "", ""},
                           {"multibody", "rk4", "tree", "projection"},
                           {"multibody", "rk4", "tree", "baumgarte"},
                           {"multibody", "dopri5", "tree", ""},
                           {"multibody", "rosenbrock", "tree", ""},
                           {"multibody", "rk4", "paper", "baumgarte"},
                           {"multibody", "rk4", "paper", "projection"},
                           {"multibody", "rosenbrock", "paper", ""}};

RunResult run(const std::shared_ptr<const Mechanism>& m, const RungSetup& setup) {
  RunOptions options;
  options.integrator = setup.integrator;
  if (options.integrator != "rk4") options.tolerance = 1e-7;
  options.formulation = setup.formulation;
  options.stabilisation = setup.stabilisation;
  return make_rung(setup.rung, m)->run(m->parameters(), options);
}

// The error is what it was at the start, to a millionth of it, and no journal has struck or parted.
void expect_standing(const RunResult& r, const std::string& what) {
  ASSERT_GT(r.boresight.samples.size(), 10u) << what;
  const Vec3 first = r.boresight.samples.front().error.displacement;
  ASSERT_GT(first.norm(), 1e-5) << what;
  for (const PoseSample& s : r.boresight.samples)
    ASSERT_LT((s.error.displacement - first).norm(), 1e-6 * first.norm()) << what;
  EXPECT_NEAR(r.index.position_error.max, r.index.position_error.mean, 1e-6 * r.index.position_error.max) << what;
  for (const ContactSummary& c : r.contact) {
    EXPECT_EQ(c.impacts, 0) << what << ", " << c.joint;
    EXPECT_GT(c.contact_fraction, 0.999999) << what << ", " << c.joint;
    EXPECT_EQ(c.settled_from, 0.0) << what << ", " << c.joint;
  }
  for (const ContactEvent& e : r.events) {
    EXPECT_EQ(e.start, 0.0) << what;
    EXPECT_LT(e.start_speed, 1e-9) << what;
  }
}

TEST(RestingStart, NothingMovesWhereDrivesStandStill) {
  const auto m = standing_four_bar();
  for (const RungSetup& setup : kWays)
    expect_standing(run(m, setup), std::string(setup.rung) + ", " + setup.integrator + ", " + setup.formulation + " " +
                                       setup.stabilisation);
}

// Its coordinates hold no ball joint, which generalized-alpha asks for.
TEST(RestingStart, NothingMovesUnderGeneralizedAlpha) {
  const auto m = standing_platform("3-rrcpr.toml");
  expect_standing(run(m, {"multibody", "generalized-alpha", "tree", ""}), "generalized-alpha");
}

TEST(RestingStart, NothingMovesWhereAJournalMayTilt) {
  const auto m =
      standing_platform("3-rrcpr.toml", {{"clearance.F1.axes", "free"}, {"clearance.F1.sleeve_length", "120 mm"}});
  for (const RungSetup& setup : {kWays[0], kWays[2], kWays[3]})
    expect_standing(run(m, setup), std::string("tilting, ") + setup.rung + ", " + setup.integrator);
}

// Sleeves carry journals by normal forces alone as a motion starts: on an incline too, bristles that begin unbent have nothing to take up.
TEST(RestingStart, NothingMovesOnAnInclineUnderFrictionThatSticks) {
  const auto m = standing_platform("3-rrcpr.toml", {{"clearance.F1.friction.law", "lugre"},
                                                    {"clearance.F1.friction.coefficient", "0.3"},
                                                    {"gravity.x", "5 m/s^2"},
                                                    {"gravity.y", "6 m/s^2"}});
  for (const RungSetup& setup : {kWays[0], kWays[3], kWays[7]})  // those that carry bristles
    expect_standing(run(m, setup), std::string("LuGre, ") + setup.rung + ", " + setup.integrator);
}

TEST(RestingStart, TwelveJointsRestTogether) {
  const auto m = standing_platform("twelve-joints.toml");
  const StartingJournals start = starting_journals(*m, m->parameters(), ideal_motion(*m, m->parameters()));
  EXPECT_EQ(start.warning, "");
  const RunResult r = run(m, kWays[0]);
  const Vec3 first = r.boresight.samples.front().error.displacement;
  for (const PoseSample& s : r.boresight.samples) ASSERT_LT((s.error.displacement - first).norm(), 1e-6 * first.norm());
}

// Each number of them is set: none is what the memory held before.
TEST(StartingJournals, ThatDoNotTiltHaveNoSlopeAndCentredOnesNoOffset) {
  for (const char* journals : {"rest", "centred"}) {
    const std::vector<Setting> start = {{"initial.journals", journals}};
    const auto m =
        std::make_shared<const Mechanism>(read_mechanism(BORESIGHT_EXAMPLES "/crank-slider/crank-slider.toml", start));
    const StartingJournals found = starting_journals(*m, m->parameters(), ideal_motion(*m, m->parameters()));
    ASSERT_EQ(found.journals.size(), 1u);
    EXPECT_EQ(found.journals[0].slope, Vec3(Vec3::Zero())) << journals;
    EXPECT_EQ(found.journals[0].offset == Vec3(Vec3::Zero()), std::string(journals) == "centred") << journals;
  }
}

// A seat of the floating bearing that is out of line by more than its radial play: the shaft lies otherwise, as every rung starts it.
TEST(StartingJournals, AreThoseOfTheMechanismWithItsStandingErrors) {
  MechanismDescription drawn =
      read_mechanism(BORESIGHT_EXAMPLES "/bearing-pairs/gimbal.toml", {{"motion.duration", "1 ms"}});
  const auto floating = std::find_if(drawn.joints.begin(), drawn.joints.end(),
                                     [](const JointDescription& j) { return j.name == "yaw.floating"; });
  ErrorDescription seat;
  seat.name = "seat";
  seat.joint = static_cast<int>(floating - drawn.joints.begin());
  seat.body = kGround;
  seat.direction = Vec3::UnitX();
  seat.value = 12e-6;
  drawn.errors.push_back(seat);
  const auto m = std::make_shared<const Mechanism>(std::move(drawn));
  const IdealMotion commanded = ideal_motion(*m, m->parameters());
  const StartingJournals start = starting_journals(*m, m->parameters(), commanded);
  EXPECT_EQ(start.warning, "");
  Parameters without = m->parameters();
  without.error.assign(1, 0.0);
  const StartingJournals straight = starting_journals(*m, without, commanded);
  EXPECT_GT((start.journals[1].offset - straight.journals[1].offset).norm(), 0.5 * seat.value);
  for (const char* rung : {"perturbation", "multibody"}) {
    const RunResult run = make_rung(rung, m)->run(m->parameters(), {});
    ASSERT_EQ(run.clearances.size(), start.journals.size()) << rung;
    for (std::size_t c = 0; c < start.journals.size(); ++c) {
      const Vec3 offset = start.journals[c].offset;
      EXPECT_LT((run.clearances[c].front().offset - offset).norm(), 1e-3 * offset.norm()) << rung << ' ' << c;
    }
  }
}

TEST(RestingStart, IsWhereTheQuasistaticRungHasTheJournals) {
  const auto m = standing_platform("3-rrcpr.toml", {{"clearance.F1.friction.coefficient", "0"}});
  const RunResult resting = make_rung("quasistatic", m)->run(m->parameters(), {});
  const Vec3 rest = resting.clearances[0].front().offset;
  const auto started = [&](const char* rung) {
    return make_rung(rung, m)->run(m->parameters(), {}).clearances[0].front().offset;
  };
  EXPECT_LT((started("perturbation") - rest).norm(), 1e-9 * rest.norm());
  EXPECT_LT((started("multibody") - rest).norm(), 1e-3 * rest.norm());  // the square of the deviation
}

TEST(RestingStart, AMovingMechanismStartsInBalanceOnBothRungs) {
  const auto m = mechanism("four-bar/four-bar.toml", {});
  const RunResult linear = make_rung("perturbation", m)->run(m->parameters(), {});
  for (const char* formulation : {"tree", "paper"}) {
    RunOptions options;
    options.formulation = formulation;
    const RunResult exact = make_rung("multibody", m)->run(m->parameters(), options);
    const ClearanceSample &a = linear.clearances[0].front(), &b = exact.clearances[0].front();
    EXPECT_GT(a.offset.norm(), 4e-5);
    EXPECT_LT((a.offset - b.offset).norm(), 1e-3 * a.offset.norm()) << formulation;  // the square of the deviation
    // No more than the parts turn by (the rocker at 2 rad/s), far less than the speed of a journal that falls across its clearance.
    EXPECT_LT(b.offset_rate.norm(), 5e-3 * std::sqrt(2.0 * 9.81 * 5e-5)) << formulation;
    EXPECT_LT((a.offset_rate - b.offset_rate).norm(), 1e-2 * a.offset_rate.norm()) << formulation;
    // The load that the ideal joint carried, to the share of the clearance in the mechanism.
    EXPECT_NEAR(b.normal_force / a.normal_force, 1.0, 1e-2) << formulation;
  }
}

// Which of two parts is called the sleeve, and so in whose axes the offset counts, is the drawing's choice.
TEST(RestingStart, MovesOnTheSameWhicheverPartIsTheSleeve) {
  const auto drawn = mechanism("four-bar/four-bar.toml", {});
  MechanismDescription other = drawn->description();
  ClearanceDescription& play = other.clearances[0];
  const JointDescription& joint = other.joints[play.joint];
  play.journal = play.journal == joint.first ? joint.second : joint.first;
  const auto swapped = std::make_shared<const Mechanism>(std::move(other));
  for (const char* rung : {"perturbation", "multibody"}) {
    const RunResult a = make_rung(rung, drawn)->run(drawn->parameters(), {}),
                    b = make_rung(rung, swapped)->run(swapped->parameters(), {});
    const PoseSample &p = a.boresight.samples.front(), &q = b.boresight.samples.front();
    const Vec3 rate = a.clearances[0].front().offset_rate;
    ASSERT_GT(rate.norm(), 1e-6) << rung;
    EXPECT_LT((p.error.displacement - q.error.displacement).norm(), 1e-6 * p.error.displacement.norm()) << rung;
    EXPECT_LT((p.v - q.v).norm(), 3e-3 * rate.norm()) << rung;  // the clearance over the mechanism's size
  }
}

TEST(RestingStart, WithoutALoadJournalsStayInTheMiddle) {
  const auto m = standing_four_bar({{"gravity.x", "0 m/s^2"}, {"gravity.y", "0 m/s^2"}, {"gravity.z", "0 m/s^2"}});
  for (const char* rung : {"perturbation", "multibody"}) {
    const RunResult r = make_rung(rung, m)->run(m->parameters(), {});
    EXPECT_LT(r.clearances[0].front().offset.norm(), 1e-12) << rung;
    EXPECT_LT(r.index.position_error.max, 1e-12) << rung;
  }
}

// A torque that the bearing bears: the cross carries nothing of it, and rounding is no load.
constexpr const char* kTwistedShaft = R"toml(format = 1
name = "torque through a universal joint with parallel axes"
gravity = ["0 m/s^2", "0 m/s^2", "0 m/s^2"]

[[body]]
name = "input"
mass = "1 kg"
center_of_mass = ["40 mm", "0 mm", "0 mm"]
inertia = ["0.0002667 kg m^2", "0.0006667 kg m^2", "0.0006667 kg m^2"]

[[body]]
name = "shaft"
mass = "2.5 kg"
center_of_mass = ["230 mm", "0 mm", "0 mm"]
inertia = ["0.000375 kg m^2", "0.01894 kg m^2", "0.01894 kg m^2"]
boresight = [1, 0, 0]

[[joint]]
name = "motor"
type = "revolute"
connects = ["ground", "input"]
point = ["0 mm", "0 mm", "0 mm"]
axis = [1, 0, 0]
driven = true

[[joint]]
name = "cross"
type = "universal"
connects = ["input", "shaft"]
point = ["80 mm", "0 mm", "0 mm"]
axis = [0, 0, 1]
second_axis = [0, 1, 0]

[[joint]]
name = "bearing"
type = "revolute"
connects = ["ground", "shaft"]
point = ["460 mm", "0 mm", "0 mm"]
axis = [1, 0, 0]

[[load]]
joint = "bearing"
torque = "10"

[motion]
duration = "120 ms"
drives = { motor = "0.3*t" }

[[clearance]]
joint = "cross"
axes = "parallel"
cross_mass = "60 g"
cross_radius = "20 mm"
radial = "0.01 mm"
axial = "0.01 mm"
journal_radius = "6 mm"
cap_radius = "8 mm"
sleeve_length = "12 mm"
  [clearance.contact]
  law = "flores"
  restitution = 0.85
  young = ["207 GPa", "72 GPa"]
  poisson = [0.3, 0.33]
  density = "2700 kg/m^3"
  minimum_impact_speed = "1 mm/s"
)toml";

TEST(RestingStart, LoadsThatIdealConstraintsBearPushNoJournal) {
  const auto m = std::make_shared<const Mechanism>(read_mechanism_text(kTwistedShaft, "twisted.toml"));
  for (const char* rung : {"quasistatic", "perturbation", "multibody"}) {
    const RunResult r = make_rung(rung, m)->run(m->parameters(), {});
    EXPECT_LT(r.index.position_error.max, 1e-9) << rung;
    EXPECT_TRUE(r.warnings.empty()) << rung << ": " << r.warnings.front();
  }
}

TEST(RestingStart, JournalsThatStartFreeAreSaidToHaveToSettle) {
  Settings centred = {{"motion.drives.A", "0.3"}, {"initial.journals", "centred"}, {"motion.duration", "200 ms"}};
  const auto m = std::make_shared<const Mechanism>(
      read_mechanism(std::string(BORESIGHT_EXAMPLES) + "/four-bar/four-bar.toml", centred));
  for (const char* integrator : {"rk4", "rosenbrock"}) {
    RunOptions options;
    options.integrator = integrator;
    const RunResult whole = make_rung("perturbation", m)->run(m->parameters(), options);
    EXPECT_GT(whole.settled_from, whole.index.position_error.time_of_max) << integrator;
    ASSERT_FALSE(whole.warnings.empty()) << integrator;
    EXPECT_NE(whole.warnings.back().find("falls into the start"), std::string::npos) << whole.warnings.back();
    options.start = whole.settled_from;
    const RunResult later = make_rung("perturbation", m)->run(m->parameters(), options);
    EXPECT_LT(later.index.position_error.max, whole.index.position_error.max) << integrator;
    EXPECT_LT(later.contact[0].impacts, whole.contact[0].impacts) << integrator;
    EXPECT_LT(later.contact[0].max_force, whole.contact[0].max_force) << integrator;
    for (const std::string& warning : later.warnings)
      EXPECT_EQ(warning.find("falls into the start"), std::string::npos) << warning;
  }
}

}  // namespace resting_start_test
}  // namespace boresight
