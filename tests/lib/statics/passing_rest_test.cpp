// A maximum that lies where loads change their signs is told of as that: two bearings on one axis, whose axial loads cross zero one
// shortly after the other, and rests that lie on opposite sides but for that moment.
#include "boresight/statics/passing_rest.hpp"

#include <gmock/gmock.h>

#include "boresight/io/mechanism_file.hpp"
#include "boresight/statics/quasistatic.hpp"

namespace boresight {
namespace passing_rest_test {

using testing::HasSubstr;

std::string point_at(const char* x) { return std::string("[\"") + x + "\", \"0 mm\", \"0 mm\"]\n"; }

std::string body(const std::string& name, const char* x) {
  return "[[body]]\nname = \"" + name + "\"\nmass = \"1 kg\"\ncenter_of_mass = " + point_at(x) +
         "inertia = [\"1e-3 kg m^2\", \"1e-3 kg m^2\", \"1e-3 kg m^2\"]\n";
}

std::string bearing(const std::string& name, const std::string& sleeve, const std::string& journal, const char* x,
                    const std::string& axial) {
  return "[[joint]]\nname = \"" + name + "\"\ntype = \"revolute\"\nconnects = [\"" + sleeve + "\", \"" + journal +
         "\"]\npoint = " + point_at(x) + "axis = [1, 0, 0]\ndriven = true\n[[clearance]]\njoint = \"" + name +
         "\"\njournal = \"" + journal + "\"\nradial = \"0.03 mm\"\naxial = \"" + axial + R"toml("
journal_radius = "8 mm"
cap_radius = "12 mm"
sleeve_length = "60 mm"
contact = { law = "flores", restitution = 0.85, young = ["207 GPa", "72 GPa"], poisson = [0.3, 0.33], density = "2700 kg/m^3" }
)toml";
}

// Along the axis as the law says, and some newtons across it.
std::string load(const std::string& on, const std::string& along, const char* x) {
  return "[[load]]\nbody = \"" + on + "\"\nforce = [\"" + along + "\", \"0\", \"10\"]\npoint = " + point_at(x);
}

// The load of the first bearing is that of both, the load of the second one the head's alone.
RunResult rests_under(const std::string& on_shaft, const std::string& on_head) {
  const std::string text =
      "format = 1\nname = \"two bearings in a row\"\n"
      "gravity = [\"0 m/s^2\", \"0 m/s^2\", \"0 m/s^2\"]\n" +
      body("shaft", "0 mm") + body("head", "100 mm") + "boresight = [1, 0, 0]\n" +
      bearing("near", "ground", "shaft", "0 mm", "0.1 mm") + bearing("far", "shaft", "head", "100 mm", "0.06 mm") +
      "[motion]\nduration = \"1 s\"\ndrives = { near = \"0.01*t\", far = \"0.01*t\" }\n" +
      load("shaft", on_shaft, "0 mm") + load("head", on_head, "100 mm");
  const auto mechanism = std::make_shared<const Mechanism>(read_mechanism_text(text, "bearings.toml"));
  return make_rests(mechanism)->run(mechanism->parameters(), {});
}

std::string passages_in(const RunResult& result) {
  std::string all;
  for (const std::string& warning : result.warnings)
    if (warning.find("of a passage") != std::string::npos) all += warning + "\n";
  return all;
}

TEST(PassingRest, IsNamedWhereTheMaximumIsThatOfAnInstant) {
  // Zero at t = (pi - 1) / (2 pi) = 0.3408 s and half a second later.
  const RunResult result = rests_under("-20*sin(2*pi*t + 1) - 0.02", "10*sin(2*pi*t + 1)");
  EXPECT_GT(result.index.position_error.max, 1.5 * result.index.position_error.rms);
  const std::string said = passages_in(result);
  EXPECT_THAT(said, HasSubstr("position"));
  EXPECT_THAT(said, HasSubstr("near and far"));
  const double t = result.index.position_error.time_of_max;
  EXPECT_LT(std::min(std::abs(t - 0.3408), std::abs(t - 0.8408)), 2e-3);
}

TEST(PassingRest, IsNotNamedWhereTheRestStaysThere) {
  // Both go to the other side together: the largest error is that of all the rest of the motion.
  EXPECT_EQ(passages_in(rests_under("10*sin(2*pi*t + 1)", "10*sin(2*pi*t + 1)")), "");
  EXPECT_EQ(passages_in(rests_under("-20", "10 + sin(2*pi*t)")), "");
}

TEST(PassingRest, RisesAboveBothSidesOrNotAtAll) {
  EXPECT_EQ(rise_above(1.0, 0.5, 1.0), 0.0);
  EXPECT_EQ(rise_above(1.0, 0.99, 0.2), 0.0);
  EXPECT_DOUBLE_EQ(rise_above(3.0, 1.0, 2.0), 0.5);
}

TEST(PassingRest, IsOnTheOtherSideWhereItWentOverTheMiddle) {
  const auto at = [](double x, double y, double z) {
    RestingPlay rest;
    rest.motion.e = Vec3(x, y, z);
    rest.radial_reach = {1e-4, 1e-4};
    rest.axial_reach = 1e-4;
    return rest;
  };
  EXPECT_TRUE(changes_sides(at(1e-4, 0.0, 0.0), at(-1e-4, 0.0, 0.0)));
  EXPECT_TRUE(changes_sides(at(1e-4, 1e-4, 0.0), at(1e-4, -1e-4, 0.0)));
  EXPECT_FALSE(changes_sides(at(1e-4, 0.0, 0.0), at(0.8e-4, 0.0, 0.6e-4)));
  EXPECT_FALSE(changes_sides(at(1e-4, 1e-12, 0.0), at(1e-4, -1e-12, 0.0)));  // rounding
}

}  // namespace passing_rest_test
}  // namespace boresight
