// A mechanism file: a slider of 2 kg at rest in a rectangular guide, with play of 0.03 and 0.02 mm, its mass beside its middle.
#pragma once

#include <string>

namespace boresight::scenes {

// width, length: of the slider, with their units.
inline std::string slider_in_guide(const std::string& width, const std::string& length) {
  return R"toml(format = 1
name = "slider in its guide"
gravity = ["0 m/s^2", "0 m/s^2", "-9.81 m/s^2"]
[[body]]
name = "slider"
mass = "2 kg"
center_of_mass = ["10 mm", "0 mm", "0 mm"]
inertia = ["0.002 kg m^2", "0.002 kg m^2", "0.002 kg m^2"]
boresight = [1, 0, 0]
[[joint]]
name = "G"
type = "prismatic"
connects = ["ground", "slider"]
point = ["0 mm", "0 mm", "0 mm"]
axis = [1, 0, 0]
driven = true
[motion]
duration = "50 ms"
drives = { G = "0*t" }
[[clearance]]
joint = "G"
journal = "slider"
guide = "rectangular"
width_gap = "0.03 mm"
height_gap = "0.02 mm"
height = "20 mm"
width_direction = [0, 1, 0]
axes = "free"
width = ")toml" +
         width + "\"\nlength = \"" + length + R"toml("
  [clearance.contact]
  law = "flores"
  restitution = 0.6
  young = ["207 GPa", "72 GPa"]
  poisson = [0.3, 0.33]
)toml";
}

}  // namespace boresight::scenes
