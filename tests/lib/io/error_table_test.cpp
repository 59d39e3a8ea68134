// [[error]] tables: what is read, and the line for what is not.
#include <gtest/gtest.h>

#include "boresight/mechanism/parameter_path.hpp"
#include "good_file.hpp"

namespace boresight {
namespace error_table_test {

const std::string kPlace = "[[clearance]]\njoint = \"R\"";

std::string file_with(const std::string& tables) { return with(kPlace, tables + "\n" + kPlace); }

MechanismDescription read_with(const std::string& tables, const std::vector<Setting>& settings = {}) {
  return read_mechanism_text(file_with(tables), "f.toml", settings);
}

TEST(ErrorTable, SaysWhatIsDisplacedTurnedDrivenAndGrown) {
  const MechanismDescription m = read_with(R"toml([[error]]
name = "arm.length"
joint = "P"
body = "arm"
translation = [0, 3, 4]
value = "-20 um"
[[error]]
name = "squareness"
joint = "R"
body = "ground"
rotation = "axis"
[[error]]
name = "P.screw"
drive = "P"
law = "sin(2*pi*q/0.005) + t^2"
value = 1e-4
[[error]]
name = "warming"
body = "arm"
expansion = "23.6e-6 1/K"
value = "5 K")toml");
  ASSERT_EQ(m.errors.size(), 4u);
  EXPECT_EQ(m.errors[0].kind, ErrorDescription::Kind::translation);
  EXPECT_LT((m.errors[0].direction - Vec3(0.0, 0.6, 0.8)).norm(), 1e-15);
  EXPECT_DOUBLE_EQ(m.errors[0].value, -20e-6);
  EXPECT_EQ(m.errors[1].body, kGround);
  EXPECT_EQ(m.errors[1].direction, Vec3(Vec3::UnitX()));
  EXPECT_EQ(m.errors[1].value, 0.0);
  EXPECT_EQ(m.errors[2].value, 1e-4);
  EXPECT_EQ(m.errors[3].coefficient, 23.6e-6);
  EXPECT_EQ(m.errors[3].value, 5.0);
  // The law along a motion, by the chain rule; against f(q(t), t) differentiated by hand with q = 1e-3 t^3.
  const double t = 0.7, w = 2.0 * 3.14159265358979323846 / 0.005;
  const TimeValue q{1e-3 * t * t * t, 3e-3 * t * t, 6e-3 * t};
  const TimeValue f = m.errors[2].law->at(q, t);
  EXPECT_NEAR(f.value, std::sin(w * q.value) + t * t, 1e-14);
  EXPECT_NEAR(f.rate, w * q.rate * std::cos(w * q.value) + 2.0 * t, 1e-13);
  EXPECT_NEAR(f.acceleration,
              w * q.acceleration * std::cos(w * q.value) - w * w * q.rate * q.rate * std::sin(w * q.value) + 2.0,
              1e-11);
}

TEST(ErrorTable, GivesEveryErrorAPathWithItsUnit) {
  const MechanismDescription m = read_with(R"toml([[error]]
name = "arm.length"
joint = "P"
body = "arm"
translation = "axis"
[[error]]
name = "P.offset"
drive = "P"
[[error]]
name = "tilt"
joint = "R"
body = "arm"
rotation = [0, 0, 1])toml",
                                           {{"error.arm.length", "0.1 mm"}, {"error.P.offset", "2e-6"}});
  Parameters p = nominal_parameters(m);
  EXPECT_EQ(p.error, (std::vector<double>{1e-4, 2e-6, 0.0}));
  const ParameterPath length(m, "error.arm.length"), tilt(m, "error.tilt");
  EXPECT_EQ(length.unit(), "m");
  EXPECT_EQ(tilt.unit(), "rad");
  tilt.set(p, 1e-3);
  EXPECT_EQ(p.error[2], 1e-3);
  EXPECT_EQ(length.get(p), 1e-4);
  EXPECT_THROW(ParameterPath(m, "error.*"), InputError);  // lengths and angles are not one value
  ParameterPath(m, "body.arm.center_of_mass.y").set(p, 0.25);
  EXPECT_EQ(p.body_center[0], Vec3(0.0, 0.25, 0.1));
}

// A scale is a share of what its drive does, and users write shares.
TEST(ErrorTable, TakesTheScaleOfADriveAsAShare) {
  const auto table = [](const std::string& law, const std::string& value) {
    return "[[error]]\nname = \"P.scale\"\ndrive = \"P\"\nlaw = \"" + law + "\"\nvalue = " + value;
  };
  for (const char* value : {"\"250 ppm\"", "\"0.025 %\"", "2.5e-4", "\"2.5e-4 1\"", "\"0.25 mm\""})
    for (const char* law : {"q", "q*cos(t)"})
      EXPECT_NEAR(read_with(table(law, value)).errors[0].value, 2.5e-4, 1e-18) << value;
  const MechanismDescription m = read_with(table("2*q", "\"1 ppm\""), {{"error.P.scale", "-30 ppm"}});
  EXPECT_NEAR(m.errors[0].value, -30e-6, 1e-18);
  EXPECT_TRUE(names_scales(m, "error.P.scale"));
  EXPECT_TRUE(names_scales(m, "error.*"));
  EXPECT_FALSE(names_scales(m, "payload.mass"));
  // An offset or a ripple is a length: a share of what?
  for (const char* law : {"1", "sin(2*pi*q/0.005)", "q + 1", "q^2", "0"}) {
    EXPECT_THROW(read_with(table(law, "\"250 ppm\"")), InputError) << law;
    EXPECT_FALSE(is_scale(read_with(table(law, "1e-6")).errors[0])) << law;
  }
  EXPECT_EQ(error_of(file_with(table("q", "\"1 kg\""))),
            "f.toml:41: error.P.scale: found \"1 kg\", expected a share or a length such as \"250 ppm\"");
}

TEST(ErrorTable, IsRefusedInOneLineThatSaysWhy) {
  const auto refused = [](const std::string& table, const std::string& expected) {
    EXPECT_EQ(error_of(file_with("[[error]]\nname = \"e\"\n" + table)), "f.toml:" + expected);
  };
  refused("joint = \"P\"\nbody = \"arm\"",
          "37: error.e.translation: found none of translation, rotation, drive and expansion, expected exactly one of "
          "them");
  refused("joint = \"P\"\nbody = \"arm\"\nrotation = [1, 0, 0]\ndrive = \"P\"",
          "42: error.e.drive: found both rotation and drive, expected one of the two: a table is one error");
  refused("joint = \"P\"\nbody = \"ground\"\ntranslation = [1, 0, 0]",
          "40: error.e.body: found \"ground\", expected one of the two bodies that \"P\" connects");
  refused("drive = \"P\"\nlaw = \"q\"\nvalue = \"0.001\"",
          "41: error.e: found \"0.001\" in quotes and without a unit, expected a number without quotes, or a "
          "text with "
          "its unit");
  refused("drive = \"R\"", "39: error.e.drive: found \"R\", which is not driven, expected the name of a driven joint");
  refused("drive = \"P\"\nlaw = \"sin(x)\"",
          "40: error.e.law: found the unknown name \"x\" in \"sin(x)\", expected q, t, pi or a function such as sin; "
          "did you "
          "mean q?");
  refused("drive = \"P\"\nlaw = \"1/t\"",
          "40: error.e.law: found \"1/t\", which is not finite or not smooth at t = 0.000000 s, expected an expression "
          "that is finite with its first two derivatives during the motion");
  refused("drive = \"P\"\nlaw = \"abs(t-0.3)\"",
          "40: error.e.law: found \"abs(t-0.3)\", which jumps or has a corner at t = 0.300000 s, expected a law whose "
          "value "
          "and rate are continuous: round a corner off, as abs(x) to sqrt(x^2 + e^2)");
  refused("joint = \"P\"\nbody = \"arm\"\nrotation = [1, 0, 0]\nvalue = \"1 mm\"",
          "42: error.e: found \"1 mm\", expected an angle such as \"30 deg\"");
  refused("joint = \"P\"\nbody = \"arm\"\ntranslation = [1, 0, 0]\nvalue = 1e-3",
          "42: error.e: found the number 0.001 without a unit, expected a length such as \"0.1 mm\"");
  refused("joint = \"P\"\nbody = \"arm\"\ntranslation = \"towards R\"",
          "41: error.e.translation: found \"towards R\", which is at the same point as \"P\", expected a joint "
          "elsewhere, or "
          "three numbers");
  refused("body = \"arm\"\nexpansion = \"1e-5 K\"",
          "40: error.e.expansion: found \"1e-5 K\", expected a coefficient of expansion such as \"23.6e-6 1/K\"");
  refused(
      "drive = \"P\"\n[[error]]\nname = \"e.f\"\ndrive = \"P\"",
      "41: error[2].name: found \"e.f\" beside \"e\", expected names of which none begins with another and a dot, as "
      "paths must tell them apart");
}

// A star stands for a whole name, dots and all.
TEST(ErrorTable, IsSetByAStarWhateverItsNamesHold) {
  const auto errors = [](const std::string& path) {
    std::string text;
    for (const char* name : {"a", "b.c", "b.d.length"})
      text += "[[error]]\nname = \"" + std::string(name) + "\"\njoint = \"R\"\nbody = \"arm\"\nrotation = [0, 0, 1]\n";
    return nominal_parameters(read_with(text, {{path, "1 mrad"}})).error;
  };
  EXPECT_EQ(errors("error.*"), (std::vector<double>{1e-3, 1e-3, 1e-3}));
  EXPECT_EQ(errors("error.b.c"), (std::vector<double>{0.0, 1e-3, 0.0}));
  EXPECT_EQ(errors("error.*.length"), (std::vector<double>{0.0, 0.0, 1e-3}));
  EXPECT_EQ(errors("error.b.*"), (std::vector<double>{0.0, 1e-3, 1e-3}));
  // Names that hold what a table of errors may hold, too.
  EXPECT_EQ(nominal_parameters(read_with("[[error]]\nname = \"arm.rotation\"\njoint = \"R\"\nbody = \"arm\"\n"
                                         "rotation = [0, 0, 1]\n",
                                         {{"error.*", "1 mrad"}}))
                .error,
            (std::vector<double>{1e-3}));
}

}  // namespace error_table_test
}  // namespace boresight
