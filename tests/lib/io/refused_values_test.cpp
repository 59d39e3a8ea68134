// Keys and values that a mechanism file must not have, each with the line that says so.
#include <gtest/gtest.h>

#include <string>

#include "good_file.hpp"

namespace boresight {
namespace refused_values_test {

TEST(RefusedValue, NamesKeysThatAreUnknownMissingOrWithoutMeaning) {
  check({
      {"radial =", "radal =",
       R"~(f.toml:40: clearance[1].radal: found an unknown key, expected one of joint, journal, guide, radial, axial, journal_radius, cap_radius, sleeve_length, pad_radius, width_gap, height_gap, width, height, length, width_direction, axes, contact, friction, bearing, span, fixed_end, floating, preload, preload_stiffness, cross_mass, cross_radius, cross_inertia; did you mean radial?)~"},
      {"mass = \"1 kg\"\n", "# nothing\n",
       R"~(f.toml:4: body.arm.mass: found nothing, expected a mass such as "1.5 kg")~"},
      {"format = 1\n", "format = 1\nformatt = 2\n",
       R"~(f.toml:2: formatt: found an unknown key, expected one of format, name, gravity, body, payload, pattern, joint, motion, clearance, initial, spring, load, error, pointing; did you mean format?)~"},
      {"driven = true", "driven = true\nsecond_axis = [1, 0, 0]",
       R"~(f.toml:34: joint.P.second_axis: found a second axis on a prismatic joint, expected it only on a universal joint)~"},
      {"restitution = 0.9", "resitution = 0.9",
       R"~(f.toml:46: clearance.R.contact.resitution: found an unknown key, expected one of law, dissipation, restitution, young, poisson, density, minimum_impact_speed, stiffness_scale, stiffness, damping; did you mean restitution?)~"},
      {"torque = \"0.033\"", "torque = \"0.033\"\nforce = \"1\"",
       R"~(f.toml:59: load.1.force: found a key that has no meaning here, expected this table without it; did you mean torque?)~"},
      {"[payload]", "[payloads]",
       R"~(f.toml:16: payloads: found an unknown key, expected one of format, name, gravity, body, payload, pattern, joint, motion, clearance, initial, spring, load, error, pointing; did you mean payload?)~"},
      {"format = 1\n", "# no format\n", R"~(f.toml:1: format: found nothing, expected a whole number)~"},
      {"boresight = [0, 0, 1]\n", "# none\n",
       R"~(f.toml:4: body: found no body with a boresight, expected boresight = [0, 0, 1] or another direction on one body)~"},
      {"[motion]\nduration = \"1 s\"\n", "[motion]\n# none\n",
       R"~(f.toml:34: motion.duration: found nothing, expected a time such as "1 s")~"},
      {"x = [0, 1, 0]", "w = [0, 1, 0]",
       R"~(f.toml:9: body.arm.axes.w: found an unknown key, expected one of x, y, z; did you mean x?)~"},
  });
}

TEST(RefusedValue, SaysWhatKindOfValueAndWhichDimensionIsExpected) {
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
       R"~(f.toml:26: joint.R.axis.z: found the number nan, expected a finite number)~"},
      {"axis = [1, 0, 0]", "axis = \"x\"",
       R"~(f.toml:26: joint.R.axis: found "x", expected a direction: three numbers, not all zero)~"},
      {"driven = true", "driven = \"yes\"", R"~(f.toml:33: joint.P.driven: found "yes", expected true or false)~"},
      {"restitution = 0.9", "restitution = \"0.9\"",
       R"~(f.toml:46: clearance.R.contact.restitution: found "0.9", expected a number)~"},
      {"restitution = 0.9", "restitution = inf",
       R"~(f.toml:46: clearance.R.contact.restitution: found the number inf, expected a finite number)~"},
      {"name = \"arm\"", "name = 5",
       R"~(f.toml:5: body[1].name: found the number 5, expected a text in quotation marks)~"},
      {"rates = { R = \"6 rad/s\" }", "rates = { R = \"6 Hz\" }",
       R"~(f.toml:50: initial.rates.R: found "6 Hz", expected an angular rate such as "6 rad/s")~"},
      {"format = 1\n", "format = 2\n", R"~(f.toml:1: format: found the number 2, expected 1)~"},
      {"format = 1\n", "format = \"1\"\n", R"~(f.toml:1: format: found "1", expected a whole number)~"},
      {"format = 1\n", "format = 1.0\n",
       R"~(f.toml:1: format: found the number 1 with a decimal point, expected a whole number, such as 1)~"},
      {"restitution = 0.9", "restitution = nan",
       R"~(f.toml:46: clearance.R.contact.restitution: found the number nan, expected a finite number)~"},
      {"journal = \"arm\"\n", "# no journal\n",
       R"~(f.toml:37: clearance.R.journal: found nothing, expected one of the bodies of joint R: ground or arm)~"},
      {"[motion]", "[[motion]]", R"~(f.toml:34: motion: found a list of 1, expected a table [motion])~"},
      {"[[spring]]", "[spring]", R"~(f.toml:51: spring: found a table, expected tables [[spring]])~"},
      {"connects = [\"arm\", \"slider\"]", "connects = [\"arm\"]",
       R"~(f.toml:30: joint.P.connects: found ["arm"], expected two names of bodies)~"},
  });
}

TEST(RefusedValue, RefusesNumbersThatNothingRealHas) {
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
      {"sleeve_length = \"30 mm\"", "sleeve_length = \"30 mm\"\npad_radius = \"20 mm\"",
       R"~(f.toml:45: clearance.R.pad_radius: found it on "R", a revolute joint, expected it only on a planar joint, which has a pad)~"},
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

TEST(RefusedValue, NamesTheNearestName) {
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

TEST(RefusedValue, CountsTheLettersOfANameAndNotTheirBytes) {
  const auto named = [](int letters) {
    std::string name;
    for (int k = 0; k < letters; ++k) name += "ж";
    return error_of(kGood + "[[error]]\nname = \"" + name + "\"\ndrive = \"P\"\nlaw = \"1\"\nvalue = \"0.1 mm\"\n");
  };
  EXPECT_EQ(named(100), "no error");
  EXPECT_NE(named(101).find("expected a name of up to 100 characters"), std::string::npos) << named(101);
}

TEST(RefusedValue, RefusesWhatContradictsItself) {
  check({
      {"type = \"revolute\"\nconnects = [\"ground\", \"arm\"]\npoint = [\"0 mm\", \"0 mm\", \"0 mm\"]\naxis = [1, 0, "
       "0]\n",
       "type = \"fixed\"\nconnects = [\"ground\", \"arm\"]\npoint = [\"0 mm\", \"0 mm\", \"0 mm\"]\n\n",
       R"~(f.toml:38: clearance[1].joint: found "R", a fixed joint, expected a revolute, cylindrical, prismatic, planar, spherical or universal joint)~"},
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
       R"~(f.toml:41: clearance.P.axial: found it on "P", a prismatic joint, expected no axial clearance: the journal slides through its sleeve and has no end faces)~"},
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

TEST(RefusedValue, NamesExpressionsThatHaveNoValue) {
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

}  // namespace refused_values_test
}  // namespace boresight
