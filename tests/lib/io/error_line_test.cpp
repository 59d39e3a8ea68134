// Whatever is wrong with a mechanism file: one line that says where, what was found, what was expected.
#include <gtest/gtest.h>

#include <cstdio>
#include <fstream>
#include <string>

#include "boresight/io/mechanism_file.hpp"
#include "boresight/mechanism/error.hpp"

namespace boresight {
namespace {

// A pendulum that carries a driven slider; the numbers on the right are the lines.
const std::string kGood = R"toml(format = 1
name = "test"
gravity = ["0 m/s^2", "0 m/s^2", "-9.81 m/s^2"]
[[body]]
name = "arm"
mass = "1 kg"
center_of_mass = ["0 mm", "0 mm", "100 mm"]
inertia = ["2 kg m^2", "2 kg m^2", "1 kg m^2"]
axes = { x = [0, 1, 0], z = [0, 0, 1] }
boresight = [0, 0, 1]
[[body]]
name = "slider"
mass = "2 kg"
center_of_mass = ["0 mm", "0 mm", "200 mm"]
inertia = ["2 kg m^2", "2 kg m^2", "1 kg m^2", "0.1 kg m^2", "0 kg m^2", "0 kg m^2"]
[payload]
body = "slider"
mass = "0 kg"
center_of_mass = ["0 mm", "0 mm", "200 mm"]
gyration = ["1 m", "1 m", "1 m"]
[[joint]]
name = "R"
type = "revolute"
connects = ["ground", "arm"]
point = ["0 mm", "0 mm", "0 mm"]
axis = [1, 0, 0]
[[joint]]
name = "P"
type = "prismatic"
connects = ["arm", "slider"]
point = ["0 mm", "0 mm", "0 mm"]
axis = [0, 0, 2]
driven = true
[motion]
duration = "1 s"
drives = { P = "0.01*sin(t)" }
[[clearance]]
joint = "R"
journal = "arm"
radial = "0.1 mm"
axial = "0.1 mm"
journal_radius = "10 mm"
cap_radius = "16 mm"
sleeve_length = "30 mm"
[clearance.contact]
restitution = 0.9
[clearance.friction]
coefficient = 0.03
[initial]
rates = { R = "6 rad/s" }
[[spring]]
connects = ["ground", "arm"]
points = [["0 m", "1 m", "0 m"], ["0 m", "0 m", "0.1 m"]]
stiffness = "100 N/m"
free_length = "0.5 m"
[[load]]
joint = "R"
torque = "0.033"
[[load]]
body = "slider"
point = ["0 m", "0 m", "0 m"]
force = ["0", "t", "0"]
)toml";

std::string with(const std::string& from, const std::string& to) {
  std::string text = kGood;
  const std::size_t place = text.find(from);
  EXPECT_NE(place, std::string::npos) << from;
  return place == std::string::npos ? text : text.replace(place, from.size(), to);
}

std::string error_of(const std::string& text, const std::vector<Setting>& settings = {}) {
  try {
    read_mechanism_text(text, "f.toml", settings);
  } catch (const InputError& error) {
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
    return error.what();
  }
  return "no error";
}

struct Case {
  const char *from, *to, *expected;
};

void check(std::initializer_list<Case> cases) {
  for (const Case& c : cases) EXPECT_EQ(error_of(with(c.from, c.to)), c.expected) << c.from << " -> " << c.to;
}

TEST(ErrorLine, IsAbsentWhereTheFileIsGood) { EXPECT_EQ(error_of(kGood), "no error"); }

TEST(ErrorLine, NamesKeysThatAreUnknownMissingOrWithoutMeaning) {
  check({
      {"radial =", "radal =",
       R"~(f.toml:40: clearance[1].radal: found an unknown key, expected one of joint, journal, radial, axial, journal_radius, cap_radius, sleeve_length, axes, contact, friction; did you mean radial?)~"},
      {"mass = \"1 kg\"\n", "# nothing\n",
       R"~(f.toml:4: body.arm.mass: found nothing, expected a mass such as "1.5 kg")~"},
      {"format = 1\n", "format = 1\nformatt = 2\n",
       R"~(f.toml:2: formatt: found an unknown key, expected one of format, name, gravity, body, payload, pattern, joint, motion, clearance, initial, spring, load, pointing; did you mean format?)~"},
      {"driven = true", "driven = true\nsecond_axis = [1, 0, 0]",
       R"~(f.toml:34: joint.P.second_axis: found a key that has no meaning here, expected no such key)~"},
      {"restitution = 0.9", "resitution = 0.9",
       R"~(f.toml:46: clearance.R.contact.resitution: found an unknown key, expected one of law, dissipation, restitution, young, poisson, density, minimum_impact_speed, stiffness_scale, stiffness, damping; did you mean restitution?)~"},
      {"torque = \"0.033\"", "torque = \"0.033\"\nforce = \"1\"",
       R"~(f.toml:59: load.1.force: found a key that has no meaning here, expected no such key; did you mean torque?)~"},
      {"[payload]", "[payloads]",
       R"~(f.toml:16: payloads: found an unknown key, expected one of format, name, gravity, body, payload, pattern, joint, motion, clearance, initial, spring, load, pointing; did you mean payload?)~"},
      {"format = 1\n", "# no format\n", R"~(f.toml:1: format: found nothing, expected a whole number)~"},
      {"boresight = [0, 0, 1]\n", "# none\n",
       R"~(f.toml:4: body: found no body with a boresight, expected boresight = [0, 0, 1] or another direction on one body)~"},
      {"[motion]\nduration = \"1 s\"\n", "[motion]\n# none\n",
       R"~(f.toml:34: motion.duration: found nothing, expected a time such as "1 s")~"},
      {"x = [0, 1, 0]", "w = [0, 1, 0]",
       R"~(f.toml:9: body.arm.axes.w: found an unknown key, expected one of x, y, z; did you mean x?)~"},
  });
}

TEST(ErrorLine, SaysWhatKindOfValueAndWhichDimensionIsExpected) {
  check({
      {"mass = \"1 kg\"", "mass = \"1 mm\"",
       R"~(f.toml:6: body.arm.mass: found "1 mm", expected a mass such as "1.5 kg")~"},
      {"mass = \"1 kg\"", "mass = 1",
       R"~(f.toml:6: body.arm.mass: found the number 1 without a unit, expected a mass such as "1.5 kg")~"},
      {"mass = \"1 kg\"", "mass = \"1\"",
       R"~(f.toml:6: body.arm.mass: found "1" without a unit, expected a mass such as "1.5 kg")~"},
      {"mass = \"1 kg\"", "mass = \"1 kgg\"",
       R"~(f.toml:6: body.arm.mass: found "1 kgg" with the unknown unit "kgg", expected a mass such as "1.5 kg"; did you mean kg?)~"},
      {"mass = \"1 kg\"", "mass = \"nan kg\"",
       R"~(f.toml:6: body.arm.mass: found "nan kg", expected a mass such as "1.5 kg")~"},
      {"mass = \"1 kg\"", "mass = true", R"~(f.toml:6: body.arm.mass: found true, expected a mass such as "1.5 kg")~"},
      {"mass = \"1 kg\"", "mass = [\"1 kg\"]",
       R"~(f.toml:6: body.arm.mass: found ["1 kg"], expected a mass such as "1.5 kg")~"},
      {"mass = \"1 kg\"", "mass = 1979-05-27",
       R"~(f.toml:6: body.arm.mass: found a date or time, expected a mass such as "1.5 kg")~"},
      {"\"-9.81 m/s^2\"]", "\"-9.81 m/s\"]",
       R"~(f.toml:3: gravity.z: found "-9.81 m/s", expected an acceleration such as "-9.81 m/s^2")~"},
      {"\"-9.81 m/s^2\"]", "-9.81]",
       R"~(f.toml:3: gravity.z: found the number -9.81 without a unit, expected an acceleration such as "-9.81 m/s^2")~"},
      {"\"0 m/s^2\", \"-9.81", "\"-9.81",
       R"~(f.toml:3: gravity: found ["0 m/s^2", "-9.81 m/s^2"], expected a list of three, each an acceleration such as "-9.81 m/s^2")~"},
      {"axis = [1, 0, 0]", "axis = [1, 0]",
       R"~(f.toml:26: joint.R.axis: found [1, 0], expected a direction: three numbers, not all zero)~"},
      {"axis = [1, 0, 0]", "axis = [1, 0, \"0\"]", R"~(f.toml:26: joint.R.axis.z: found "0", expected a number)~"},
      {"axis = [1, 0, 0]", "axis = [1, 0, nan]",
       R"~(f.toml:26: joint.R.axis.z: found the number nan, expected a number)~"},
      {"axis = [1, 0, 0]", "axis = \"x\"",
       R"~(f.toml:26: joint.R.axis: found "x", expected a direction: three numbers, not all zero)~"},
      {"driven = true", "driven = \"yes\"", R"~(f.toml:33: joint.P.driven: found "yes", expected true or false)~"},
      {"restitution = 0.9", "restitution = \"0.9\"",
       R"~(f.toml:46: clearance.R.contact.restitution: found "0.9", expected a number)~"},
      {"restitution = 0.9", "restitution = inf",
       R"~(f.toml:46: clearance.R.contact.restitution: found the number inf, expected a number)~"},
      {"name = \"arm\"", "name = 5",
       R"~(f.toml:5: body[1].name: found the number 5, expected a text in quotation marks)~"},
      {"rates = { R = \"6 rad/s\" }", "rates = { R = \"6 Hz\" }",
       R"~(f.toml:50: initial.rates.R: found "6 Hz", expected an angular rate such as "6 rad/s")~"},
      {"format = 1\n", "format = 2\n", R"~(f.toml:1: format: found the number 2, expected 1)~"},
      {"format = 1\n", "format = \"1\"\n", R"~(f.toml:1: format: found "1", expected a whole number)~"},
      {"[motion]", "[[motion]]", R"~(f.toml:34: motion: found a list of 1, expected a table [motion])~"},
      {"[[spring]]", "[spring]", R"~(f.toml:51: spring: found a table, expected tables [[spring]])~"},
      {"connects = [\"arm\", \"slider\"]", "connects = [\"arm\"]",
       R"~(f.toml:30: joint.P.connects: found ["arm"], expected two names of bodies)~"},
  });
}

TEST(ErrorLine, RefusesNumbersThatNothingRealHas) {
  check({
      {"mass = \"1 kg\"", "mass = \"-1 kg\"",
       R"~(f.toml:6: body.arm.mass: found "-1 kg", expected a mass above zero)~"},
      {"mass = \"1 kg\"", "mass = \"0 kg\"", R"~(f.toml:6: body.arm.mass: found "0 kg", expected a mass above zero)~"},
      {"mass = \"0 kg\"", "mass = \"-1 g\"",
       R"~(f.toml:18: payload.mass: found "-1 g", expected a mass of zero or more)~"},
      {"[\"2 kg m^2\", \"2 kg m^2\", \"1 kg m^2\"]", "[\"2 kg m^2\", \"2 kg m^2\", \"-1 kg m^2\"]",
       R"~(f.toml:8: body.arm.inertia: found a principal moment that is not positive, expected positive principal moments)~"},
      {"[\"2 kg m^2\", \"2 kg m^2\", \"1 kg m^2\"]", "[\"1 kg m^2\", \"1 kg m^2\", \"3 kg m^2\"]",
       R"~(f.toml:8: body.arm.inertia: found a principal moment larger than the sum of the other two, expected moments that a real body can have)~"},
      {"\"0.1 kg m^2\", \"0 kg", "\"5 kg m^2\", \"0 kg",
       R"~(f.toml:15: body.slider.inertia: found a principal moment that is not positive, expected positive principal moments)~"},
      {"[\"2 kg m^2\", \"2 kg m^2\", \"1 kg m^2\"]", "[\"2 kg m^2\", \"2 kg m^2\"]",
       R"~(f.toml:8: body.arm.inertia: found ["2 kg m^2", "2 kg m^2"], expected 3 or 6 moments of inertia (xx yy zz xy xz yz))~"},
      {"gyration = [\"1 m\", \"1 m\", \"1 m\"]", "gyration = [\"1 m\", \"1 m\", \"2 m\"]",
       R"~(f.toml:20: payload.gyration: found a squared radius larger than the sum of the other two, expected radii that a real body can have)~"},
      {"gyration = [\"1 m\", \"1 m\", \"1 m\"]", "gyration = [\"1 m\", \"1 m\", \"-1 m\"]",
       R"~(f.toml:20: payload.gyration: found a radius that is negative, expected radii of zero or more)~"},
      {"axis = [1, 0, 0]", "axis = [0, 0, 0]",
       R"~(f.toml:26: joint.R.axis: found three numbers without a direction, expected a direction: three numbers, not all zero)~"},
      {"x = [0, 1, 0]", "x = [0, 1, 0.1]",
       R"~(f.toml:9: body.arm.axes.z: found a direction that is not perpendicular to x, expected perpendicular axes)~"},
      {"x = [0, 1, 0], ", "", R"~(f.toml:9: body.arm.axes: found a table, expected at least two of x, y, z)~"},
      {"x = [0, 1, 0],", "x = [0, 1, 0], y = [1, 0, 0],",
       R"~(f.toml:9: body.arm.axes: found left-handed axes, expected right-handed axes)~"},
      {"duration = \"1 s\"", "duration = \"0 s\"",
       R"~(f.toml:35: motion.duration: found "0 s", expected a time above zero)~"},
      {"radial = \"0.1 mm\"", "radial = \"0 mm\"",
       R"~(f.toml:40: clearance.R.radial: found "0 mm", expected a length above zero)~"},
      {"axial = \"0.1 mm\"\njournal_radius", "axial = \"-0.1 mm\"\njournal_radius",
       R"~(f.toml:41: clearance.R.axial: found "-0.1 mm", expected a length of zero or more)~"},
      {"cap_radius = \"16 mm\"", "cap_radius = \"10.1 mm\"",
       R"~(f.toml:43: clearance.R.cap_radius: found "10.1 mm", expected more than journal_radius + radial)~"},
      {"sleeve_length = \"30 mm\"", "sleeve_length = \"-30 mm\"",
       R"~(f.toml:44: clearance.R.sleeve_length: found "-30 mm", expected a length above zero)~"},
      {"restitution = 0.9", "restitution = 0",
       R"~(f.toml:46: clearance.R.contact.restitution: found the number 0, expected a number from 1e-06 to 1 with law = "flores", whose damping grows without bound towards 0; laws that take 0: hunt-crossley, herbert-mcwhannell, lee-wang, lankarani-nikravesh, zhiying-qishao, carvalho-martins)~"},
      {"restitution = 0.9", "restitution = 1.01",
       R"~(f.toml:46: clearance.R.contact.restitution: found the number 1.01, expected a number from 0 to 1)~"},
      {"restitution = 0.9", "poisson = [0.33, 0.5]",
       R"~(f.toml:46: clearance.R.contact.poisson: found [0.33, 0.5], expected numbers of at least 0, below 0.5)~"},
      {"restitution = 0.9", "young = [\"72 GPa\", \"0 GPa\"]",
       R"~(f.toml:46: clearance.R.contact.young: found ["72 GPa", "0 GPa"], expected elastic moduli above zero)~"},
      {"restitution = 0.9", "young = [\"72 GPa\"]",
       R"~(f.toml:46: clearance.R.contact.young: found ["72 GPa"], expected two values: journal, sleeve)~"},
      {"restitution = 0.9", "minimum_impact_speed = \"0 m/s\"",
       R"~(f.toml:46: clearance.R.contact.minimum_impact_speed: found "0 m/s", expected a speed above zero)~"},
      {"restitution = 0.9", "stiffness_scale = 0",
       R"~(f.toml:46: clearance.R.contact.stiffness_scale: found the number 0, expected a number above zero)~"},
      {"coefficient = 0.03", "coefficient = -0.03",
       R"~(f.toml:48: clearance.R.friction.coefficient: found the number -0.03, expected a number of zero or more)~"},
      {"coefficient = 0.03", "static_speed = \"1 mm/s\"",
       R"~(f.toml:48: clearance.R.friction.static_speed: found "1 mm/s", expected dynamic_speed above static_speed)~"},
      {"coefficient = 0.03", "static_speed = \"-1 mm/s\"",
       R"~(f.toml:48: clearance.R.friction.static_speed: found "-1 mm/s", expected a speed of zero or more)~"},
      {"coefficient = 0.03", "viscosity = \"1 s/m\"",
       R"~(f.toml:48: clearance.R.friction.viscosity: found it with law = "modified-coulomb", expected it only with law = "lugre")~"},
      {"stiffness = \"100 N/m\"", "stiffness = \"-100 N/m\"",
       R"~(f.toml:54: spring.1.stiffness: found "-100 N/m", expected a stiffness of zero or more)~"},
      {"[\"0 m\", \"0 m\", \"0.1 m\"]", "[\"0 m\", \"1 m\", \"0 m\"]",
       R"~(f.toml:53: spring.1.points: found the same point twice, expected two points apart: the spring acts along the line between them)~"},
  });
}

TEST(ErrorLine, IsOfTheLetterBeyondAsciiThatStandsOutsideQuotationMarks) {
  const auto refused_at = [](int line) {
    return "f.toml:" + std::to_string(line) +
           ": found a letter beyond ASCII outside quotation marks, expected it inside them, or none";
  };
  const std::string name = "name = \"test\"";
  for (const char* fine : {"name = \"t\u00e9st\"  # \u00b5, \"", "name = 't\u00e9st\\'", "name = \"a \\\" \u00b5\"",
                           "name = \"\"\"\n\u00b5 \\\"\" \"\"\"\"\"  # \u00b5", "name = \'\'\'\u3000\n\\\'\'\'"})
    EXPECT_EQ(error_of(with(name, fine)), "no error") << fine;
  for (const char* stray : {"name = \"test\" \u00b5", "n\u00e4me = \"test\"", "name = \"test\"\u00a0", "name = \u00e9",
                            "name = \u4e00\"test\""})
    EXPECT_EQ(error_of(with(name, stray)), refused_at(2)) << stray;
  EXPECT_EQ(error_of(with(name, "name = \"\"\"\n\u00b5\\\n\"\"\" \u00b5")), refused_at(4));
  EXPECT_EQ(error_of("\xEF\xBB\xBF" + kGood), "no error");
}

TEST(ErrorLine, NamesTheNearestName) {
  check({
      {"body = \"slider\"\nmass", "body = \"slidr\"\nmass",
       R"~(f.toml:17: payload.body: found "slidr", expected the name of a body; did you mean slider?)~"},
      {"connects = [\"arm\", \"slider\"]", "connects = [\"amr\", \"slider\"]",
       R"~(f.toml:30: joint.P.connects: found "amr", expected the name of a body, or "ground"; did you mean arm?)~"},
      {"connects = [\"arm\", \"slider\"]", "connects = [\"grond\", \"slider\"]",
       R"~(f.toml:30: joint.P.connects: found "grond", expected the name of a body, or "ground"; did you mean ground?)~"},
      {"type = \"revolute\"", "type = \"revolut\"",
       R"~(f.toml:23: joint.R.type: found "revolut", expected one of "revolute", "prismatic", "cylindrical", "universal", "spherical", "planar", "fixed"; did you mean revolute?)~"},
      {"joint = \"R\"\njournal", "joint = \"S\"\njournal",
       R"~(f.toml:38: clearance[1].joint: found "S", expected the name of a joint; did you mean R?)~"},
      {"drives = { P", "drives = { Q",
       R"~(f.toml:36: motion.drives.Q: found "Q", expected the name of a joint; did you mean R?)~"},
      {"rates = { R", "rates = { T",
       R"~(f.toml:50: initial.rates.T: found "T", expected the name of a joint; did you mean R?)~"},
      {"\"0.01*sin(t)\"", "\"0.01*sni(t)\"",
       R"~(f.toml:36: motion.drives.P: found the unknown name "sni" in "0.01*sni(t)", expected t, pi or a function such as sin; did you mean sin?)~"},
      {"restitution = 0.9", "law = \"florez\"",
       R"~(f.toml:46: clearance.R.contact.law: found "florez", expected one of "flores", "hertz", "hunt-crossley", "herbert-mcwhannell", "lee-wang", "lankarani-nikravesh", "gonthier", "zhiying-qishao", "hu-guo", "carvalho-martins", "exact", "kelvin-voigt", "johnson", "radzimovsky", "dubowsky-freudenstein", "liu", "pereira"; did you mean flores?)~"},
      {"coefficient = 0.03", "law = \"coulomb\"",
       R"~(f.toml:48: clearance.R.friction.law: found "coulomb", expected one of "none", "modified-coulomb", "threlfall", "bengisu-akay", "brown-mcphee", "lugre")~"},
  });
}

TEST(ErrorLine, RefusesWhatContradictsItself) {
  check({
      {"name = \"slider\"", "name = \"arm\"",
       R"~(f.toml:12: body[2].name: found "arm" a second time (first in line 4), expected a name of its own)~"},
      {"name = \"slider\"", "name = \"\"",
       R"~(f.toml:12: body[2].name: found "", expected a name of up to 100 characters without . * = , { } [ ] and quotation marks)~"},
      {"name = \"slider\"", "name = \"ground\"",
       R"~(f.toml:12: body[2].name: found "ground", expected another name: "ground" is the ground)~"},
      {"name = \"slider\"", "name = \"a.b\"",
       R"~(f.toml:12: body[2].name: found "a.b", expected a name of up to 100 characters without . * = , { } [ ] and quotation marks)~"},
      {"name = \"P\"", "name = \"R\"",
       R"~(f.toml:28: joint[2].name: found "R" a second time (first in line 21), expected a name of its own)~"},
      {"name = \"slider\"", "name = \"slider\"\nboresight = [1, 0, 0]",
       R"~(f.toml:13: body.slider.boresight: found a second boresight (arm has one), expected one body with a boresight)~"},
      {"connects = [\"arm\", \"slider\"]", "connects = [\"arm\", \"arm\"]",
       R"~(f.toml:30: joint.P.connects: found "arm" twice, expected two different bodies)~"},
      {"type = \"prismatic\"", "type = \"cylindrical\"",
       R"~(f.toml:33: joint.P.driven: found a driven cylindrical joint, expected a drive on a revolute or prismatic joint)~"},
      {"drives = { P = \"0.01*sin(t)\" }", "# none",
       R"~(f.toml:34: motion.drives: found driven joints without a motion, expected a body's pose, or drives with a law for each driven joint)~"},
      {"drives = { P", "drives = { R",
       R"~(f.toml:36: motion.drives.R: found a law for joint "R", which is not driven, expected the name of a driven joint)~"},
      {"drives = { P = \"0.01*sin(t)\" }", "drives = {}",
       R"~(f.toml:36: motion.drives.P: found nothing, expected a law for every driven joint, an expression of t)~"},
      {"drives = {", "body = \"arm\"\ndrives = {",
       R"~(f.toml:37: motion.drives: found both a body's pose and drives, expected one of the two)~"},
      {"joint = \"R\"\njournal", "joint = \"P\"\njournal",
       R"~(f.toml:38: clearance[1].joint: found "P", a prismatic joint, expected a revolute, cylindrical or spherical joint)~"},
      {"journal = \"arm\"", "journal = \"slider\"",
       R"~(f.toml:39: clearance.R.journal: found "slider", expected one of the bodies of joint R: ground or arm)~"},
      {"[initial]", "[[clearance]]\njoint = \"R\"\n[initial]",
       R"~(f.toml:50: clearance[2].joint: found "R" a second time (first in line 37), expected one clearance per joint)~"},
      {"rates = { R", "rates = { P",
       R"~(f.toml:50: initial.rates.P: found a starting rate for joint "P", which is driven, expected a joint that is free)~"},
      {"rates = { R", "rates = { \"R.displacement\"",
       R"~(f.toml:50: initial.rates.R.displacement: found "displacement", expected "angle")~"},
      {"joint = \"R\"\ntorque = \"0.033\"", "torque = \"0.033\"",
       R"~(f.toml:56: load.1.body: found neither joint nor body, expected the joint or the body that the load acts on)~"},
      {"force = [\"0\", \"t\", \"0\"]", "force = [\"0\", \"t\"]",
       R"~(f.toml:62: load.2.force: found ["0", "t"], expected three expressions of t [N], along the world's x, y, z)~"},
      {"body = \"slider\"\npoint", "body = \"ground\"\npoint",
       R"~(f.toml:60: load.2.body: found "ground", expected the name of a body)~"},
      {"driven = true\n", "",
       R"~(f.toml:35: motion.drives.P: found a law for joint "P", which is not driven, expected the name of a driven joint)~"},
      {"drives = { P = \"0.01*sin(t)\" }", "body = \"arm\"",
       R"~(f.toml:34: motion.angles: found nothing, expected a table [motion.angles])~"},
  });
}

TEST(ErrorLine, NamesExpressionsThatHaveNoValue) {
  check({
      {"\"0.01*sin(t)\"", "\"0.01*sin(t\"",
       R"~(f.toml:36: motion.drives.P: found the end in "0.01*sin(t", expected a closing bracket)~"},
      {"\"0.01*sin(t)\"", "\"1/t\"",
       R"~(f.toml:36: motion.drives.P: found "1/t", which is not finite or not smooth at t = 0.000000 s, expected an expression that is finite with its first two derivatives during the motion)~"},
      {"\"0.01*sin(t)\"", "\"sqrt(t)\"",
       R"~(f.toml:36: motion.drives.P: found "sqrt(t)", which is not finite or not smooth at t = 0.000000 s, expected an expression that is finite with its first two derivatives during the motion)~"},
      {"\"0.01*sin(t)\"", "\"9^9^9^9\"",
       R"~(f.toml:36: motion.drives.P: found a power that is not a finite real number in "9^9^9^9", expected a finite expression of t)~"},
      {"\"0.01*sin(t)\"", "\"\"",
       R"~(f.toml:36: motion.drives.P: found the end in "", expected a number, a name or a bracket)~"},
      {"\"0.01*sin(t)\"", "1.5",
       R"~(f.toml:36: motion.drives.P: found the number 1.5, expected a text in quotation marks)~"},
      {"\"0\", \"t\", \"0\"", "\"0\", \"x\", \"0\"",
       R"~(f.toml:62: load.2.force: found the unknown name "x" in "x", expected t, pi or a function such as sin; did you mean t?)~"},
  });
}

TEST(ErrorLine, GivesTheLineOfAFaultInTheToml) {
  check({
      {"name = \"arm\"", "name = \"arm",
       R"~(f.toml:5: found a fault in the TOML (Error while parsing string: unescaped control characters other than TAB (U+0009) are explicitly prohibited), expected TOML 1.0)~"},
      {"mass = \"1 kg\"", "mass = \"1 kg\"\nmass = \"1 kg\"",
       R"~(f.toml:7: found a fault in the TOML (Error while parsing key-value pair: cannot redefine existing string 'mass'), expected TOML 1.0)~"},
      {"[motion]", "[motion",
       R"~(f.toml:34: found a fault in the TOML (Error while parsing table header: expected ']', saw '\n'), expected TOML 1.0)~"},
      {"mass = \"1 kg\"", "mass = ",
       R"~(f.toml:6: found a fault in the TOML (Error while parsing key-value pair: expected value, saw '\n'), expected TOML 1.0)~"},
      {"mass = \"1 kg\"", "mass = [ } ]",
       R"~(f.toml:6: found a fault in the TOML (Error while parsing value: could not determine value type), expected TOML 1.0)~"},
  });
}

TEST(ErrorLine, RefusesNestingThatWouldExhaustTheStack) {
  std::string key = "a";
  for (int i = 0; i < 100; ++i) key += ".a";
  EXPECT_EQ(error_of(with("[motion]", "[" + key + "]\n[motion]")),
            "f.toml:34: found a key of more than 64 parts, expected a shorter key");
  EXPECT_EQ(
      error_of(with("mass = \"1 kg\"", "mass = " + std::string(400, '['))),
      "f.toml:6: found a fault in the TOML (Error while parsing value: exceeded maximum nested value depth of 256 "
      "(TOML_MAX_NESTED_VALUES)), expected TOML 1.0");
}

TEST(ErrorLine, StaysOneLineWhateverTheFileHolds) {
  const std::string line = error_of(with("connects = [\"arm\", \"slider\"]",
                                         "connects = [\"a\\nb\\u0007" + std::string(5000, 'x') + "\", \"slider\"]"));
  EXPECT_LT(line.size(), 400u);
  EXPECT_EQ(line.substr(0, 45), "f.toml:30: joint.P.connects: found \"a b xxxxx");
}

TEST(ErrorLine, SaysThatAFileIsNotThereOrTooLarge) {
  const auto error_of_file = [](const std::string& path) -> std::string {
    try {
      read_mechanism(path);
    } catch (const InputError& error) {
      return error.what();
    }
    return "no error";
  };
  EXPECT_EQ(error_of_file("/nowhere/at/all.toml"),
            "/nowhere/at/all.toml: found no such file, expected a file that exists");
  EXPECT_EQ(error_of_file("/tmp"), "/tmp: found a folder, expected a file");
  const std::string path = testing::TempDir() + "boresight_too_large.toml";
  std::ofstream(path) << std::string((16u << 20) + 1, ' ');
  EXPECT_EQ(error_of_file(path), path + ": found a file of more than 16 MiB, expected a smaller file");
  std::remove(path.c_str());
}

TEST(ErrorLine, OfASettingNamesTheSettingAndNoLine) {
  EXPECT_EQ(error_of(kGood, {{"body.arm.mass", "2 kg"}}), "no error");
  EXPECT_EQ(error_of(kGood, {{"body.arm.mass", "-2kg"}}),
            "--set body.arm.mass=-2kg: body.arm.mass: found \"-2kg\", expected a mass above zero");
  EXPECT_EQ(error_of(kGood, {{"body.arm.mass", "2"}}),
            "--set body.arm.mass=2: body.arm.mass: found \"2\" without a unit, expected a mass such as \"1.5 kg\"");
  EXPECT_EQ(error_of(kGood, {{"body.arn.mass", "2 kg"}}),
            "--set body.arn.mass=2 kg: body.arn.mass: found a path that names nothing, expected the path of a value; "
            "did you mean "
            "body.arm.mass?");
  EXPECT_EQ(error_of(kGood, {{"clearance.R.contact.young.sleeve", "0 Pa"}}),
            "--set clearance.R.contact.young.sleeve=0 Pa: clearance.R.contact.young: found \"0 Pa\", expected elastic "
            "moduli above zero");
  EXPECT_EQ(error_of(kGood, {{"gravity.z", "1 m"}}),
            "--set gravity.z=1 m: gravity.z: found \"1 m\", expected an acceleration such as \"-9.81 m/s^2\"");
}

TEST(ErrorLine, CarriesItsPartsApart) {
  try {
    read_mechanism_text(with("radial =", "radal ="), "f.toml");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_EQ(error.origin.file, "f.toml");
    EXPECT_EQ(error.origin.line, 40);
    EXPECT_EQ(error.key, "clearance[1].radal");
    EXPECT_EQ(error.nearest, "radial");
  }
}

TEST(EditDistance, CountsASwapAsOne) {
  EXPECT_EQ(edit_distance("", ""), 0u);
  EXPECT_EQ(edit_distance("abc", ""), 3u);
  EXPECT_EQ(edit_distance("radial", "radail"), 1u);
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3u);
}

}  // namespace
}  // namespace boresight
