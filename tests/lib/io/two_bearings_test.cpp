// A [[clearance]] that stands for two bearings: what it becomes, how it is set, what is refused.
#include <gmock/gmock.h>

#include <algorithm>

#include "boresight/mechanism/parameter_path.hpp"
#include "good_file.hpp"

namespace boresight {
namespace two_bearings_test {

// kGood with its revolute joint in a bearing pair.
std::string pair(const std::string& more = "span = \"60 mm\"\n") {
  return with("radial = \"0.1 mm\"\n", "radial = \"0.1 mm\"\nbearing = \"pair\"\n" + more);
}

// kGood with a universal joint in place of the revolute one.
std::string universal(const std::string& more = "cross_mass = \"50 g\"\ncross_radius = \"20 mm\"\n") {
  std::string text = kGood;
  const auto replace = [&](const std::string& from, const std::string& to) {
    text.replace(text.find(from), from.size(), to);
  };
  replace("type = \"revolute\"", "type = \"universal\"");
  replace("axis = [1, 0, 0]\n", "axis = [1, 0, 0]\nsecond_axis = [0, 1, 0]\n");
  replace("journal = \"arm\"\n", more);
  replace("[initial]\nrates = { R = \"6 rad/s\" }\n", "");
  replace("[[load]]\njoint = \"R\"\ntorque = \"0.033\"\n", "");
  return text;
}

MechanismDescription read(const std::string& text, const std::vector<Setting>& settings = {}) {
  return read_mechanism_text(text, "f.toml", settings);
}

const ClearanceParameters& play(const MechanismDescription& m, const std::string& joint) {
  for (const ClearanceDescription& c : m.clearances)
    if (m.joints[c.joint].name == joint) return c.parameters;
  throw std::logic_error("no play in " + joint);
}

TEST(BearingPair, IsAFixedBearingAndAFloatingOneHalfASpanToEitherSide) {
  for (const bool at_end : {false, true}) {
    const auto m = read(pair(at_end ? "span = \"60 mm\"\nfixed_end = \"end\"\n" : "span = \"60 mm\"\n"));
    ASSERT_EQ(m.joints.size(), 3u);
    EXPECT_EQ(m.joints[0].name, "R");
    EXPECT_EQ(m.joints[1].name, "R.floating");
    EXPECT_EQ(m.joints[2].name, "P");
    EXPECT_EQ(m.joints[0].type, JointType::revolute);
    EXPECT_EQ(m.joints[1].type, JointType::cylindrical);
    EXPECT_EQ(m.joints[0].point, Vec3(at_end ? 0.03 : -0.03, 0.0, 0.0));
    EXPECT_EQ(m.joints[1].point, Vec3(at_end ? -0.03 : 0.03, 0.0, 0.0));
    EXPECT_EQ(m.joints[1].origin.line, 37);
    EXPECT_EQ(m.motion.drives.count(2), 1u);
    ASSERT_EQ(m.clearances.size(), 2u);
    for (const ClearanceDescription& c : m.clearances) {
      EXPECT_EQ(c.axes, JournalAxes::free);
      EXPECT_EQ(c.origin.line, 37);
      EXPECT_EQ(c.parameters.radial, 1e-4);
      EXPECT_EQ(c.parameters.contact.restitution, 0.9);
      EXPECT_EQ(c.parameters.friction.coefficient, 0.03);
    }
    EXPECT_EQ(play(m, "R").axial, 1e-4);
    EXPECT_EQ(play(m, "R.floating").cap_radius, 0.0);
  }
}

TEST(BearingPair, HasADriveAtItsFixedBearing) {
  std::string text = pair();
  const std::string axis = "axis = [1, 0, 0]\n", drives = "drives = { ", rates = "rates = { R = \"6 rad/s\" }\n";
  text.replace(text.find(axis), axis.size(), axis + "driven = true\n");
  text.replace(text.find(drives), drives.size(), drives + "R = \"t\", ");
  text.replace(text.find(rates), rates.size(), "");
  const std::string load = "[[load]]\njoint = \"R\"\ntorque = \"0.033\"\n";
  text.replace(text.find(load), load.size(), "");
  const auto m = read(text);
  EXPECT_TRUE(m.joints[0].driven);
  EXPECT_FALSE(m.joints[1].driven);
  EXPECT_EQ(m.motion.drives.count(0), 1u);
}

TEST(BearingPair, MayHaveAFloatingBearingOfItsOwnSize) {
  const auto m = read(pair(
      "span = \"60 mm\"\nfloating = { radial = \"0.2 mm\", journal_radius = \"8 mm\", sleeve_length = \"12 mm\" }\n"));
  EXPECT_EQ(play(m, "R").radial, 1e-4);
  EXPECT_EQ(play(m, "R.floating").radial, 2e-4);
  EXPECT_EQ(play(m, "R.floating").journal_radius, 8e-3);
  EXPECT_EQ(play(m, "R.floating").sleeve_length, 12e-3);
}

// From the housing at the floating bearing to the shaft at the fixed one, pressed together by its force over its stiffness.
TEST(BearingPair, IsPreloadedByASpringAlongItsShaft) {
  const std::string preloaded = "span = \"60 mm\"\npreload = \"50 N\"\n";
  const std::size_t of_file = read(pair()).springs.size();  // which keep their paths
  for (const bool at_end : {false, true}) {
    const auto m = read(pair(preloaded + (at_end ? "fixed_end = \"end\"\n" : "")));
    ASSERT_EQ(m.springs.size(), of_file + 1);
    const SpringDescription& s = m.springs.back();
    EXPECT_EQ(s.first, kGround);
    EXPECT_EQ(s.second, 0);
    EXPECT_EQ(s.first_point, m.joints[1].point);
    EXPECT_EQ(s.second_point, m.joints[0].point);
    EXPECT_EQ(s.parameters.stiffness, 0.0);
    EXPECT_NEAR(s.parameters.pull(0.06, 0.0), -50.0, 1e-9);
  }
  const auto stiff = read(pair(preloaded + "preload_stiffness = \"10 N/mm\"\n"));
  EXPECT_NEAR(stiff.springs.back().parameters.pull(0.06, 0.0), -50.0, 1e-9);
  EXPECT_NEAR(stiff.springs.back().parameters.pull(0.059, 0.0), -60.0, 1e-9);
  EXPECT_EQ(read(pair(preloaded), {{"clearance.R.preload", "80 N"}}).springs.back().parameters.preload, 80.0);
}

// A parameter like any other: it scatters and is swept by a path of its own, and whatever its spring's stiffness is, it is the force at home.
TEST(BearingPair, HasAPathOfItsPreload) {
  const auto m = read(pair("span = \"60 mm\"\npreload = \"50 N\"\npreload_stiffness = \"10 N/mm\"\n"));
  Parameters p = nominal_parameters(m);
  const ParameterPath preload(m, "clearance.R.preload"), stiffness(m, "spring.2.stiffness"),
      all(m, "clearance.*.preload");
  EXPECT_EQ(preload.unit(), "N");
  EXPECT_EQ(preload.get(p), 50.0);
  preload.set(p, 80.0);
  stiffness.set(p, 2e4);
  EXPECT_NEAR(p.spring[1].pull(0.06, 0.0), -80.0, 1e-9);
  all.set(p, 30.0);
  EXPECT_NEAR(p.spring[1].pull(0.06, 0.0), -30.0, 1e-9);
  EXPECT_EQ(p.spring[0], nominal_parameters(m).spring[0]);
  EXPECT_THROW(ParameterPath(read(pair()), "clearance.R.preload"), InputError);
}

// Where the bearings stand is drawn once: a study varies numbers of the bearings, and the message says which.
TEST(BearingPair, SaysWhatOfItAStudyVariesWhereItsSpanIsAskedFor) {
  const auto m = read(pair());
  const auto fault = [&](const std::string& path) -> std::string {
    try {
      ParameterPath(m, path);
    } catch (const InputError& error) {
      return error.what();
    }
    return "no fault";
  };
  const std::string span = fault("clearance.R.span");
  EXPECT_THAT(span, testing::HasSubstr("of clearance.R one of radial, axial, "));
  EXPECT_THAT(span, testing::HasSubstr("floating.radial ..."));
  EXPECT_THAT(span, testing::HasSubstr("one value for a whole study, which --set changes"));
  EXPECT_THAT(span, testing::Not(testing::HasSubstr("did you mean")));
  EXPECT_THAT(fault("body.arm.inertia"), testing::HasSubstr("of body.arm one of mass, center_of_mass.x ..."));
  EXPECT_THAT(fault("motion.duration"),
              testing::HasSubstr("gravity.x ..., payload.mass ..., body.arm.mass ..., clearance.R.radial ..."));
  // A slip is still told from what does not vary.
  EXPECT_THAT(fault("clearance.R.radiall"), testing::HasSubstr("did you mean clearance.R.radial?"));
  EXPECT_THAT(fault("clearance.R.floating.radal"), testing::HasSubstr("did you mean clearance.R.floating.radial?"));
  EXPECT_THAT(fault("clearance.RR.radial"), testing::HasSubstr("did you mean clearance.R.radial?"));
  const auto wider = read(pair(), {{"clearance.R.span", "70 mm"}});
  EXPECT_NEAR((wider.joints[1].point - m.joints[1].point).norm(), 5e-3, 1e-12);
}

TEST(BearingPair, IsSetByThePathsOfItsBearings) {
  EXPECT_EQ(play(read(pair(), {{"clearance.R.radial", "0.3 mm"}}), "R.floating").radial, 1e-4);
  EXPECT_EQ(play(read(pair(), {{"clearance.R.floating.radial", "0.3 mm"}}), "R").radial, 1e-4);
  EXPECT_EQ(play(read(pair(), {{"clearance.R.floating.radial", "0.3 mm"}}), "R.floating").radial, 3e-4);
  const auto both = read(pair(), {{"clearance.*.radial", "0.3 mm"}, {"clearance.*.contact.restitution", "0.5"}});
  for (const char* joint : {"R", "R.floating"}) {
    EXPECT_EQ(play(both, joint).radial, 3e-4);
    EXPECT_EQ(play(both, joint).contact.restitution, 0.5);
  }
  EXPECT_EQ(read(pair(), {{"clearance.R.span", "80 mm"}}).joints[0].point.x(), -0.04);
  EXPECT_EQ(read(kGood, {{"clearance.R.bearing", "pair"}, {"clearance.R.span", "80 mm"}}).joints.size(), 3u);
}

TEST(BearingPair, MayBeCopiedByAPattern) {
  const std::string text = R"toml(format = 1
gravity = ["0 m/s^2", "0 m/s^2", "-9.81 m/s^2"]
[[body]]
name = "hub"
mass = "1 kg"
center_of_mass = ["0 mm", "0 mm", "0 mm"]
inertia = ["2 kg m^2", "2 kg m^2", "1 kg m^2"]
boresight = [0, 0, 1]
[motion]
duration = "1 s"
[[pattern]]
count = 4
axis = "z"
[[pattern.body]]
name = "arm{i}"
mass = "1 kg"
center_of_mass = ["0 mm", "50 mm", "0 mm"]
inertia = ["2 kg m^2", "2 kg m^2", "1 kg m^2"]
[[pattern.joint]]
name = "R{i}"
type = "revolute"
connects = ["hub", "arm{i}"]
point = ["100 mm", "0 mm", "10 mm"]
axis = [1, 0, 0]
[[pattern.joint]]
name = "U{i}"
type = "universal"
connects = ["ground", "arm{i}"]
point = ["0 mm", "100 mm", "0 mm"]
axis = [1, 0, 0]
second_axis = [0, 1, 0]
[[pattern.clearance]]
joint = "R{i}"
bearing = "pair"
span = "60 mm"
journal = "arm{i}"
radial = "0.1 mm"
axial = "0.1 mm"
journal_radius = "10 mm"
cap_radius = "16 mm"
sleeve_length = "30 mm"
[[pattern.clearance]]
joint = "U{i}"
cross_mass = "50 g"
cross_radius = "20 mm"
radial = "0.1 mm"
axial = "0.1 mm"
journal_radius = "4 mm"
cap_radius = "6 mm"
sleeve_length = "8 mm"
)toml";
  const auto m = read(text);
  ASSERT_EQ(m.joints.size(), 16u);
  ASSERT_EQ(m.bodies.size(), 9u);
  EXPECT_EQ(m.joints[4].name, "R2");
  EXPECT_LT((m.joints[4].point - Vec3(0.0, 0.07, 0.01)).norm(), 1e-15);
  EXPECT_LT((m.joints[5].point - Vec3(0.0, 0.13, 0.01)).norm(), 1e-15);
  EXPECT_EQ(m.joints[6].name, "U2.first");
  EXPECT_EQ(m.bodies[6].name, "U2.cross");
  EXPECT_LT((m.bodies[6].center_of_mass - Vec3(-0.1, 0.0, 0.0)).norm(), 1e-15);
  EXPECT_LT((m.bodies[6].axes.col(1) - Vec3(-1.0, 0.0, 0.0)).norm(), 1e-15);
}

TEST(UniversalJoint, WithPlayIsACrossInTwoRevolutes) {
  const auto m = read(universal());
  ASSERT_EQ(m.bodies.size(), 3u);
  const BodyDescription& cross = m.bodies[2];
  EXPECT_EQ(cross.name, "R.cross");
  EXPECT_EQ(cross.mass, 0.05);
  EXPECT_EQ(cross.origin.line, 38);
  // Two thin rods of 25 g and 40 mm: m l^2 / 12 across each.
  const double rod = 0.025 * 0.04 * 0.04 / 12.0;
  EXPECT_NEAR(cross.inertia(0, 0), rod, 1e-12 * rod);
  EXPECT_NEAR(cross.inertia(1, 1), rod, 1e-12 * rod);
  EXPECT_NEAR(cross.inertia(2, 2), 2.0 * rod, 1e-12 * rod);
  ASSERT_EQ(m.joints.size(), 3u);
  EXPECT_EQ(m.joints[0].name, "R.first");
  EXPECT_EQ(m.joints[0].first, kGround);
  EXPECT_EQ(m.joints[0].second, 2);
  EXPECT_EQ(m.joints[0].axis, Vec3::UnitX());
  EXPECT_EQ(m.joints[1].name, "R.second");
  EXPECT_EQ(m.joints[1].first, 2);
  EXPECT_EQ(m.joints[1].second, 0);
  EXPECT_EQ(m.joints[1].axis, Vec3::UnitY());
  ASSERT_EQ(m.clearances.size(), 2u);
  for (const ClearanceDescription& c : m.clearances) {
    EXPECT_EQ(c.journal, 2);
    EXPECT_EQ(c.origin.line, 38);
    EXPECT_EQ(m.joints[c.joint].type, JointType::revolute);
  }
}

TEST(UniversalJoint, WithPlayIsSetByThePathsOfItsParts) {
  const auto m = read(universal(), {{"clearance.R.second.radial", "0.3 mm"}, {"body.R.cross.mass", "80 g"}});
  EXPECT_EQ(play(m, "R.first").radial, 1e-4);
  EXPECT_EQ(play(m, "R.second").radial, 3e-4);
  EXPECT_EQ(m.bodies[2].mass, 0.08);
  EXPECT_EQ(read(universal(), {{"clearance.R.cross_mass", "80 g"}}).bodies[2].mass, 0.08);
  for (const BodyDescription& body : read(universal(), {{"body.*.mass", "80 g"}}).bodies) EXPECT_EQ(body.mass, 0.08);
  const auto moments =
      read(universal("cross_mass = \"50 g\"\ncross_inertia = [\"3 kg mm^2\", \"4 kg mm^2\", \"5 kg mm^2\"]\n"));
  EXPECT_DOUBLE_EQ(moments.bodies[2].inertia(1, 1), 4e-6);
}

TEST(UniversalJoint, WithPlayMayStartAtARateOfEitherPart) {
  const auto m =
      read(universal() + "[initial]\nrates = { \"R.first\" = \"2 rad/s\", \"R.second.angle\" = \"3 rad/s\" }\n");
  ASSERT_EQ(m.initial_rates.size(), 2u);
  for (const InitialRateDescription& rate : m.initial_rates)
    EXPECT_EQ(rate.rate, m.joints[rate.joint].name == "R.first" ? 2.0 : 3.0);
}

TEST(BearingPair, LetsErrorsNameEitherBearing) {
  const auto m = read(pair() +
                      "[[error]]\nname = \"seat\"\njoint = \"R.floating\"\nbody = \"arm\"\ntranslation = [0, 0, 1]\n"
                      "[[error]]\nname = \"lean\"\njoint = \"R\"\nbody = \"arm\"\nrotation = \"towards R.floating\"\n");
  ASSERT_EQ(m.errors.size(), 2u);
  EXPECT_EQ(m.joints[m.errors[0].joint].name, "R.floating");
  EXPECT_EQ(m.joints[m.errors[1].joint].name, "R");
  EXPECT_EQ(m.errors[1].direction, Vec3::UnitX());
}

// An error of the universal joint is one of its bearing in that body: a file stays valid when its joint gets play.
TEST(UniversalJoint, WithPlayKeepsItsErrors) {
  const auto m = read(universal() +
                      "[[error]]\nname = \"hand\"\njoint = \"R\"\nbody = \"arm\"\ntranslation = [0, 0, 1]\n"
                      "[[error]]\nname = \"foot\"\njoint = \"R\"\nbody = \"ground\"\nrotation = \"axis\"\n"
                      "[[error]]\nname = \"turned\"\njoint = \"R\"\nbody = \"arm\"\nrotation = \"axis\"\n");
  ASSERT_EQ(m.errors.size(), 3u);
  EXPECT_EQ(m.joints[m.errors[0].joint].name, "R.second");
  EXPECT_EQ(m.joints[m.errors[1].joint].name, "R.first");
  EXPECT_EQ(m.joints[m.errors[2].joint].name, "R.second");
  for (const std::size_t e : {1u, 2u}) EXPECT_EQ(m.errors[e].direction, Vec3::UnitX());
}

struct Refused {
  std::string text, expected;
  std::vector<Setting> settings;
};

TEST(TwoBearings, AreRefusedInOneLineWhereTheyMakeNoSense) {
  const std::vector<Refused> all = {
      {pair(""), "f.toml:37: clearance.R.span: found nothing, expected", {}},
      {pair("span = \"0 mm\"\n"), "f.toml:42: clearance.R.span: found \"0 mm\", expected a length above zero", {}},
      {pair("span = \"20 mm\"\n"),
       "f.toml:42: clearance.R.span: found \"20 mm\", expected at least half of both sleeves' lengths",
       {}},
      {pair("span = \"60 mm\"\nfloating = { axial = \"1 mm\" }\n"),
       "f.toml:43: clearance.R.floating.axial: found an unknown key, expected one of radial, journal_radius",
       {}},
      {with("radial = \"0.1 mm\"\n", "radial = \"0.1 mm\"\nspan = \"1 mm\"\n"),
       "f.toml:41: clearance.R.span: found it on a single bearing, expected it with bearing = \"pair\"",
       {}},
      {pair("span = \"60 mm\"\npreload = \"0 N\"\n"),
       "f.toml:43: clearance.R.preload: found \"0 N\", expected a force above zero",
       {}},
      {pair("span = \"60 mm\"\npreload_stiffness = \"1 N/mm\"\n"),
       "f.toml:43: clearance.R.preload_stiffness: found it without a preload, expected it with preload",
       {}},
      {with("radial = \"0.1 mm\"\n", "radial = \"0.1 mm\"\npreload = \"1 N\"\n"),
       "f.toml:41: clearance.R.preload: found it on a single bearing, expected it with bearing = \"pair\"",
       {}},
      {with("type = \"revolute\"", "type = \"cylindrical\""),
       "--set clearance.R.bearing=pair: clearance.R.bearing: found \"pair\" on \"R\", a cylindrical joint, expected it "
       "on a "
       "revolute joint",
       {{"clearance.R.bearing", "pair"}}},
      {with("radial = \"0.1 mm\"\n", "radial = \"0.1 mm\"\ncross_mass = \"1 kg\"\n"),
       "f.toml:41: clearance.R.cross_mass: found it on \"R\", a revolute joint, expected it on a universal joint",
       {}},
      {pair() + "[[clearance]]\njoint = \"R\"\n",
       "clearance[2].joint: found \"R\" a second time (first in line 37), expected one clearance per joint",
       {}},
      {pair() + "[[clearance]]\njoint = \"R.floating\"\njournal = \"arm\"\n",
       "clearance[2].joint: found \"R.floating\" a second time (first in line 37)",
       {}},
      {universal("cross_radius = \"20 mm\"\n"), "f.toml:38: clearance.R.cross_mass: found nothing, expected", {}},
      {universal("cross_mass = \"50 g\"\n"),
       "f.toml:38: clearance.R.cross_radius: found neither cross_radius nor cross_inertia, expected one of the two",
       {}},
      {universal("cross_mass = \"50 g\"\ncross_inertia = [\"1 kg mm^2\", \"1 kg mm^2\", \"5 kg mm^2\"]\n"),
       "f.toml:38: body.R.cross.inertia: found a principal moment larger than the sum of the other two",
       {}},
      {universal("journal = \"arm\"\ncross_mass = \"50 g\"\ncross_radius = \"20 mm\"\n"),
       "f.toml:40: clearance.R.journal: found it on \"R\", a universal joint, expected no journal: the cross carries",
       {}},
      {universal() + "[[clearance]]\njoint = \"R\"\n",
       "clearance[2].joint: found \"R\" a second time (first in line 38)",
       {}},
      {universal() + "[[load]]\njoint = \"R\"\ntorque = \"1\"\n",
       "joint: found \"R\", expected the name of a joint",
       {}},
  };
  for (const Refused& refused : all)
    EXPECT_NE(error_of(refused.text, refused.settings).find(refused.expected), std::string::npos)
        << error_of(refused.text, refused.settings) << "\ninstead of " << refused.expected;
}

TEST(TwoBearings, HaveNamesThatNoUserCanTake) {
  EXPECT_NE(error_of(with("name = \"R\"", "name = \"R.floating\"")).find("a name of up to 100 characters without ."),
            std::string::npos);
}

}  // namespace two_bearings_test
}  // namespace boresight
