// What the program says of standing errors: their parts in a motion, those that strain, those that use up a play, and what --set changes.
#include <gmock/gmock.h>

#include <cmath>
#include <fstream>
#include <sstream>

#include "program.hpp"

namespace boresight::app {
namespace errors_program_test {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

// A mirror on a shaft in two bearings, whose second seat is off. `play`: of that bearing, or of both.
std::string shaft(const std::string& play, const std::string& off, bool both = false) {
  const std::string bearing = "type = \"revolute\"\nconnects = [\"ground\", \"mirror\"]\naxis = [0, 1, 0]\n";
  std::string text =
      "format = 1\nname = \"shaft\"\ngravity = [\"0 m/s^2\", \"0 m/s^2\", \"-9.81 m/s^2\"]\n"
      "[[body]]\nname = \"mirror\"\nmass = \"1 kg\"\ncenter_of_mass = [\"10 mm\", \"0 mm\", \"0 mm\"]\n"
      "inertia = [\"0.01 kg m^2\", \"0.01 kg m^2\", \"0.01 kg m^2\"]\nboresight = [0, 0, 1]\n"
      "[[joint]]\nname = \"left\"\npoint = [\"0 mm\", \"-100 mm\", \"0 mm\"]\n" +
      bearing +
      "driven = true\n[[error]]\nname = \"seat\"\njoint = \"right\"\nbody = \"ground\"\ntranslation = [1, 0, 0]\nvalue "
      "= \"" +
      off + "\"\n[[joint]]\nname = \"right\"\npoint = [\"0 mm\", \"100 mm\", \"0 mm\"]\n" + bearing;
  text += "[motion]\nduration = \"50 ms\"\ndrives = { left = \"0.5*sin(6*t)\" }\n";
  for (const char* joint : {"right", "left"}) {
    if (play.empty() || (joint == std::string("left") && !both)) continue;
    text +=
        "[[clearance]]\njoint = \"" + std::string(joint) + "\"\njournal = \"mirror\"\nradial = \"" + play +
        "\"\naxial = \"0.1 mm\"\njournal_radius = \"10 mm\"\ncap_radius = \"16 mm\"\nsleeve_length = \"20 mm\"\naxes = "
        "\"parallel\"\n[clearance.contact]\nlaw = \"flores\"\nrestitution = 0.9\nyoung = [\"72 GPa\", \"72 "
        "GPa\"]\npoisson = [0.33, 0.33]\ndensity = \"2700 kg/m^3\"\nminimum_impact_speed = \"1 "
        "mm/s\"\n[clearance.friction]\nlaw = \"none\"\n";
  }
  return text;
}

class ErrorsProgram : public Program {
 protected:
  void SetUp() override {
    Program::SetUp();
    const auto put = [&](const char* name, const std::string& content) { std::ofstream(folder_ / name) << content; };
    put("strained.toml", shaft("", "0.05 mm"));
    put("roomy.toml", shaft("0.1 mm", "0.05 mm"));
    put("tight.toml", shaft("0.1 mm", "0.13 mm"));
    put("jammed.toml", shaft("0.1 mm", "1 mm", true));
  }
  // Rows of a CSV of numbers, and where a column is.
  struct Columns {
    std::vector<std::string> names;
    std::vector<std::vector<double>> rows;
    double at(std::size_t row, const std::string& name) const {
      for (std::size_t k = 0; k < names.size(); ++k)
        if (names[k] == name) return rows.at(row).at(k);
      ADD_FAILURE() << "no column " << name;
      return std::nan("");
    }
  };
  Columns columns(const std::string& file) const {
    Columns out;
    std::istringstream in(text(file));
    for (std::string line, cell; std::getline(in, line);) {
      std::istringstream cells(line);
      if (!out.names.empty()) out.rows.emplace_back();
      while (std::getline(cells, cell, ',')) {
        if (out.rows.empty())
          out.names.push_back(cell);
        else
          out.rows.back().push_back(std::stod(cell));
      }
    }
    return out;
  }
  const std::string tolerances_ = BORESIGHT_EXAMPLES "/3-rrcpr/tolerances.toml";
};

TEST_F(ErrorsProgram, ARunWritesTheirPartsWhichAddUpToItsErrorWithTheRest) {
  const Ended ended =
      call({"run", tolerances_, "--rung", "quasistatic", "--set", "motion.duration=50ms", "--set",
            "error.A3.zero=0.1mrad", "--set", "error.rod1.warming=5K", "--step-error", "off", "--out", "out"});
  ASSERT_EQ(ended.status, 0) << ended.err;
  EXPECT_THAT(ended.out, AllOf(HasSubstr("error.A3.zero of 0.1 mrad"), HasSubstr("error.rod1.warming of 5 K")));
  EXPECT_THAT(files("out"),
              ElementsAre("events.csv", "parts.csv", "report.html", "report.json", "summary.json", "timeseries.csv"));
  const Columns parts = columns("out/parts.csv"), whole = columns("out/timeseries.csv");
  ASSERT_EQ(parts.rows.size(), whole.rows.size());
  for (std::size_t k = 0; k < parts.rows.size(); ++k) {
    EXPECT_EQ(parts.at(k, "t"), whole.at(k, "t"));
    for (const char* axis : {"dx", "dy", "dz", "rx", "ry", "rz"}) {
      double sum = 0.0;
      for (const char* part : {"error.A3.zero.", "error.rod1.warming.", "rest."})
        sum += parts.at(k, std::string(part) + axis);
      EXPECT_NEAR(sum, whole.at(k, axis), 1e-15);
    }
    EXPECT_GT(std::abs(parts.at(k, "error.A3.zero.ry")), 1e-6);
    EXPECT_NEAR(parts.at(k, "error.rod1.warming.ry"), 0.0, 1e-12);
  }
  const auto summary = json("out/summary.json");
  EXPECT_EQ(summary["parts"]["errors"].size(), 2u);
  EXPECT_EQ(summary["parts"]["errors"]["error.rod1.warming"]["value"], 5.0);
  EXPECT_THAT(text("out/report.html"), HasSubstr("Parts of the standing errors"));
}

TEST_F(ErrorsProgram, ARunWithoutAnyLeavesNoParts) {
  ASSERT_EQ(
      call({"run", tolerances_, "--rung", "quasistatic", "--set", "motion.duration=50ms", "--quiet", "--out", "out"})
          .status,
      0);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "out/parts.csv"));
  EXPECT_FALSE(json("out/summary.json").contains("parts"));
}

TEST_F(ErrorsProgram, WherePartsAreNotKnownARunSaysSoAndGoesOn) {
  std::ifstream pendulum(BORESIGHT_EXAMPLES "/pendulum/pendulum.toml");
  std::ofstream(folder_ / "free.toml") << pendulum.rdbuf()
                                       << "\n[[error]]\nname = \"seat\"\njoint = \"O\"\nbody = \"ground\"\n"
                                          "translation = [0, 1, 0]\nvalue = \"0.1 mm\"\n";
  const Ended ended = call({"run", "free.toml", "--set", "motion.duration=50ms", "--out", "out"});
  ASSERT_EQ(ended.status, 0) << ended.err;
  EXPECT_THAT(ended.out, HasSubstr("the parts of the errors are not known: freedoms are left that nothing drives"));
  EXPECT_THAT(json("out/summary.json")["parts"]["refused"].get<std::string>(), HasSubstr("nothing drives"));
}

TEST_F(ErrorsProgram, CheckNamesTheErrorThatStrainsAndItsJoint) {
  const Ended ended = call({"check", "strained.toml", "--out", "out"});
  EXPECT_EQ(ended.status, 1);
  EXPECT_THAT(ended.out, AllOf(HasSubstr("problem: "), HasSubstr("seat"), HasSubstr("right"), HasSubstr("strain")));
  EXPECT_THAT(json("out/summary.json")["standing_errors"]["seat"]["strain"].get<std::string>(), HasSubstr("right"));
}

TEST_F(ErrorsProgram, ASeatFurtherOffThanTheHeldPlayIsSaid) {
  EXPECT_THAT(call({"check", "tight.toml", "--out", "a"}).out,
              AllOf(HasSubstr("problem: the standing errors ask for 30 µm more room than the clearance of \"right\"")));
  EXPECT_THAT(call({"check", "roomy.toml", "--out", "b"}).out, Not(HasSubstr("more room")));
  EXPECT_THAT(call({"run", "tight.toml", "--out", "c"}).out, HasSubstr("warning: the standing errors ask for 30 µm"));
  EXPECT_THAT(call({"run", "roomy.toml", "--out", "d"}).out, Not(HasSubstr("more room")));
}

// Two plays of 0.1 mm whose seats are 1 mm apart: contacts would give way under tons.
TEST_F(ErrorsProgram, SeatsFurtherApartThanTwoPlaysReachTogetherAreAProblem) {
  const Ended ended = call({"check", "jammed.toml", "--out", "a"});
  EXPECT_EQ(ended.status, 1) << ended.out << ended.err;
  EXPECT_THAT(ended.out, AllOf(HasSubstr("problem: the standing errors ask for 5 times the room"), HasSubstr("µm into"),
                               HasSubstr(" kN"), Not(HasSubstr("nothing stands in the way"))));
}

// An arm of 1 m on an axis that is off by 0.7 rad about the arm's own direction across: its end is off by 2 sin(0.35) m, as an open
// chain takes any error up. Over an hour, whose histories are as wide as they must be.
TEST_F(ErrorsProgram, AnOpenChainTakesUpLargeErrorsForHours) {
  std::ofstream(folder_ / "arm.toml") << R"toml(format = 1
name = "arm"
gravity = ["0 m/s^2", "0 m/s^2", "-9.81 m/s^2"]
body = [{ name = "arm", mass = "1 kg", center_of_mass = ["1 m", "0 m", "0 m"], inertia = ["0.1 kg m^2", "0.1 kg m^2", "0.1 kg m^2"], boresight = [1, 0, 0] }]
joint = [{ name = "J", type = "revolute", connects = ["ground", "arm"], point = ["0 m", "0 m", "0 m"], axis = [0, 0, 1], driven = true }]
error = [{ name = "off", joint = "J", body = "ground", rotation = [0, 1, 0], value = "0.7 rad" }]
[motion]
duration = "3600 s"
drives = { J = "0" }
)toml";
  const Ended ended = call({"run", "arm.toml", "--rung", "multibody", "--out", "arm"});
  ASSERT_EQ(ended.status, 0) << ended.err;
  EXPECT_NEAR(json("arm/summary.json")["index"]["position_error"]["max"].get<double>(), 2.0 * std::sin(0.35), 1e-9);
}

TEST_F(ErrorsProgram, SettingADimensionSaysThatTheDrawingChangesAndSettingAnErrorDoesNot) {
  const std::string says = "changes the drawing, ideal and built alike";
  EXPECT_THAT(
      call({"check", "roomy.toml", "--set", "joint.right.point=[\"0 mm\", \"110 mm\", \"0 mm\"]", "--out", "a"}).out,
      AllOf(HasSubstr("joint.right.point " + says), HasSubstr("boresight help error")));
  EXPECT_THAT(call({"check", "roomy.toml", "--set", "body.mirror.center_of_mass.x=12mm", "--out", "b"}).out,
              HasSubstr("body.mirror.center_of_mass.x " + says));
  EXPECT_THAT(call({"check", "roomy.toml", "--set", "error.seat=0.02mm", "--out", "c"}).out, Not(HasSubstr(says)));
  EXPECT_THAT(call({"check", "roomy.toml", "--set", "body.mirror.mass=2kg", "--out", "d"}).out, Not(HasSubstr(says)));
}

// A share of what the drive does, though it is computed in radians.
TEST_F(ErrorsProgram, AScaleIsSaidInPartsPerMillion) {
  const std::string joint = "[[joint]]\nname = \"right\"";
  std::string scaled = shaft("", "0 mm");
  scaled.insert(scaled.find(joint),
                "[[error]]\nname = \"left.scale\"\ndrive = \"left\"\nlaw = \"q\"\nvalue = \"50 ppm\"\n");
  std::ofstream(folder_ / "scaled.toml") << scaled;
  EXPECT_THAT(call({"check", "scaled.toml", "--out", "check"}).out, HasSubstr("error.left.scale of 50 ppm: boresight"));
  EXPECT_THAT(call({"run", "scaled.toml", "--out", "run"}).out, HasSubstr("error.left.scale of 50 ppm: "));
  const nlohmann::json paths = nlohmann::json::parse(call({"paths", "scaled.toml", "--json"}).out);
  for (const nlohmann::json& number : paths["numbers"])
    if (number["path"] == "error.left.scale") {
      EXPECT_EQ(number["unit"], "1");
      EXPECT_EQ(number["written"], "50 ppm");
    }
}

// A fifth of a milliarcsecond is no rounding where instruments are built for it.
TEST_F(ErrorsProgram, ANanoradianIsDrawnAndSaid) {
  ASSERT_EQ(call({"run", "strained.toml", "--set", "error.seat=0mm", "--out", "none"}).status, 0);
  EXPECT_THAT(text("none/report.html"), HasSubstr("Boresight error: zero to rounding, not drawn."));
  const std::string joint = "[[joint]]\nname = \"right\"";
  std::string fine = shaft("", "0 mm");
  fine.insert(fine.find(joint),
              "[[error]]\nname = \"left.zero\"\ndrive = \"left\"\nlaw = \"1\"\nvalue = \"1e-9 rad\"\n");
  std::ofstream(folder_ / "fine.toml") << fine;
  const Ended ended = call({"run", "fine.toml", "--out", "fine"});
  ASSERT_EQ(ended.status, 0) << ended.err;
  EXPECT_THAT(ended.out, HasSubstr("1 nrad"));
  EXPECT_THAT(text("fine/report.html"), Not(HasSubstr("Boresight error: zero to rounding")));
}

}  // namespace errors_program_test
}  // namespace boresight::app
