// A mechanism file without a fault, faults made in it, and the line that each gives.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "boresight/io/mechanism_file.hpp"
#include "boresight/mechanism/error.hpp"

namespace boresight {

// A pendulum that carries a driven slider; the numbers on the right are the lines.
inline const std::string kGood = R"toml(format = 1
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

inline std::string with(const std::string& from, const std::string& to) {
  std::string text = kGood;
  const std::size_t place = text.find(from);
  EXPECT_NE(place, std::string::npos) << from;
  return place == std::string::npos ? text : text.replace(place, from.size(), to);
}

inline std::string error_of(const std::string& text, const std::vector<Setting>& settings = {}) {
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

inline void check(std::initializer_list<Case> cases) {
  for (const Case& c : cases) EXPECT_EQ(error_of(with(c.from, c.to)), c.expected) << c.from << " -> " << c.to;
}

}  // namespace boresight
