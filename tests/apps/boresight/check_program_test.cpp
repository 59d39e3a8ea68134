// What `check` says of contacts and of the steps that a motion needs, and what a run says where its step is too long.
#include <gmock/gmock.h>

#include <fstream>

#include "program.hpp"

namespace boresight::app {
namespace check_program_test {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

class CheckProgram : public Program {
 protected:
  const std::string journal_ = R"(radial = "0.04 mm"
axial = "0.05 mm"
journal_radius = "10 mm"
cap_radius = "14 mm"
sleeve_length = "20 mm"
[clearance.contact]
law = "kelvin-voigt"
stiffness = "4e7 N/m"
damping = "2000 N s/m"
)";
};

// All of the load points along the axis: its end face carries it, and the journal's law, softer forty times, nothing.
TEST_F(CheckProgram, FindsTheDepthOfALoadAlongTheAxisInTheEndFace) {
  write("turntable.toml", R"toml(format = 1
name = "turntable"
gravity = ["0 m/s^2", "0 m/s^2", "-9.81 m/s^2"]
[[body]]
name = "table"
mass = "100 kg"
center_of_mass = ["0 m", "0 m", "0.1 m"]
inertia = ["2 kg m^2", "2 kg m^2", "3 kg m^2"]
boresight = [1, 0, 0]
[[joint]]
name = "az"
type = "revolute"
connects = ["ground", "table"]
point = ["0 m", "0 m", "0 m"]
axis = [0, 0, 1]
driven = true
[motion]
duration = "1 s"
drives = { az = "0.5*sin(2*pi*t)" }
[[clearance]]
joint = "az"
journal = "table"
)toml" + journal_);
  ASSERT_EQ(call({"check", "turntable.toml", "--out", "out"}).status, 0);
  const nlohmann::json contact = json("out/summary.json")["contacts"]["az"];
  const double load = 100.0 * 9.81, stiffness = contact["axial_stiffness"];
  EXPECT_NEAR(contact["typical_load"].get<double>(), load, 1e-6 * load);
  EXPECT_NEAR(contact["typical_penetration"].get<double>(), load / stiffness, 1e-6 * load / stiffness);
}

// 589 N on the end face, which takes nothing from the law that the file names, and 1 N on the bore, which does.
TEST_F(CheckProgram, AndRunHoldALawAgainstTheLoadOnTheBore) {
  const auto rotor = [](const std::string& law) {
    return R"toml(format = 1
name = "rotor"
gravity = ["0 m/s^2", "0 m/s^2", "-9.81 m/s^2"]
[[body]]
name = "rotor"
mass = "60 kg"
center_of_mass = ["0 m", "0 m", "0.1 m"]
inertia = ["0.5 kg m^2", "0.5 kg m^2", "0.4 kg m^2"]
boresight = [1, 0, 0]
[[joint]]
name = "A"
type = "revolute"
connects = ["ground", "rotor"]
point = ["0 m", "0 m", "0 m"]
axis = [0, 0, 1]
driven = true
[motion]
duration = "0.1 s"
drives = { A = "0.3*t^3" }
[[clearance]]
joint = "A"
journal = "rotor"
radial = "0.01 mm"
axial = "0.02 mm"
journal_radius = "6 mm"
cap_radius = "12 mm"
sleeve_length = "20 mm"
[clearance.contact]
restitution = 0.9
young = ["72 GPa", "72 GPa"]
poisson = [0.33, 0.33]
law = ")toml" +
           law + R"toml("
[clearance.friction]
law = "none"
[[load]]
body = "rotor"
point = ["0 m", "0 m", "0.1 m"]
force = ["1", "0", "0"]
)toml";
  };
  for (const auto& [law, fits] : {std::pair<const char*, bool>{"flores", true}, {"liu", false}}) {
    write("rotor.toml", rotor(law));
    const std::string check = call({"check", "rotor.toml", "--out", std::string("check-") + law}).out;
    EXPECT_EQ(check.find("used outside of its range") == std::string::npos, fits) << check;
    for (const char* rung : {"quasistatic", "perturbation", "multibody"}) {
      const std::string folder = std::string(rung) + "-" + law;
      const Ended run = call({"run", "rotor.toml", "--rung", rung, "--step-error", "off", "--out", folder});
      ASSERT_EQ(run.status, 0) << run.err;
      EXPECT_EQ(run.out.find("used outside of its range") == std::string::npos, fits) << rung << ": " << run.out;
    }
  }
}

// A spring of 1e8 N/m on 0.1 kg: 31,600 rad/s, of which RK4 follows steps of 88 us.
TEST_F(CheckProgram, NamesSpringsThatAskForShorterStepsThanContactsDo) {
  write("stiff.toml", R"toml(format = 1
name = "stiff"
gravity = ["0 m/s^2", "0 m/s^2", "-9.81 m/s^2"]
[[body]]
name = "arm"
mass = "2 kg"
center_of_mass = ["0.2 m", "0 m", "0 m"]
inertia = ["0.02 kg m^2", "0.03 kg m^2", "0.03 kg m^2"]
boresight = [1, 0, 0]
[[body]]
name = "tip"
mass = "0.1 kg"
center_of_mass = ["0.5 m", "0 m", "0 m"]
inertia = ["1e-4 kg m^2", "1e-4 kg m^2", "1e-4 kg m^2"]
[[joint]]
name = "h"
type = "revolute"
connects = ["ground", "arm"]
point = ["0 m", "0 m", "0 m"]
axis = [0, 1, 0]
driven = true
[[joint]]
name = "t"
type = "prismatic"
connects = ["arm", "tip"]
point = ["0.4 m", "0 m", "0 m"]
axis = [0, 0, 1]
[[spring]]
connects = ["arm", "tip"]
points = [["0.5 m", "0 m", "-0.1 m"], ["0.5 m", "0 m", "0 m"]]
stiffness = "1e8 N/m"
free_length = "0.1 m"
[motion]
duration = "0.05 s"
drives = { h = "0.3*sin(20*t)" }
[[clearance]]
joint = "h"
journal = "arm"
)toml" + journal_);
  const Ended check = call({"check", "stiff.toml", "--out", "out"});
  EXPECT_EQ(check.status, 0) << check.err;
  EXPECT_THAT(check.out, HasSubstr("springs and dampers vibrate faster than any contact"));
  EXPECT_THAT(text("out/report.html"), HasSubstr("set by springs and dampers"));
  for (const char* rung : {"multibody", "perturbation"}) {
    const Ended run =
        call({"run", "stiff.toml", "--rung", rung, "--step", "0.12 ms", "--step-error", "off", "--out", rung});
    EXPECT_EQ(run.status, 3) << rung;
    EXPECT_TRUE(is_one_line(run.err)) << run.err;
    EXPECT_THAT(run.err, AllOf(HasSubstr("springs and dampers alone leave RK4 stable up to a step of "),
                               Not(HasSubstr("not finite"))));
  }
}

}  // namespace check_program_test
}  // namespace boresight::app
