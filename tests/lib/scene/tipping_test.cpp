// Journals that loads tip over, though they push them nowhere: a top-heavy column in its guide, a slider under a rod, by closed form; in all
// drawings and on all rungs alike.
#include "boresight/scene/tipping.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "boresight/formulations/ideal_simulation.hpp"
#include "boresight/io/mechanism_file.hpp"
#include "boresight/ladder/ladder.hpp"
#include "boresight/scene/clearance_scene.hpp"

namespace boresight {
namespace tipping_test {

// A column of 4 kg, 0.3 m above the middle of its round guide, on its axis; the guide 0.2 m long with 50 um of play.
constexpr const char* kColumn = R"toml(format = 1
name = "col_up"
gravity = ["-9.81 m/s^2", "0 m/s^2", "0 m/s^2"]
[[body]]
name = "car"
mass = "4 kg"
center_of_mass = ["0.3 m", "0 m", "0 m"]
inertia = ["0.02 kg m^2", "0.03 kg m^2", "0.03 kg m^2", "0 kg m^2", "0 kg m^2", "0 kg m^2"]
boresight = [1, 0, 0]
[[joint]]
name = "sl"
type = "prismatic"
connects = ["ground", "car"]
point = ["0 m", "0 m", "0 m"]
axis = [1, 0, 0]
driven = true
[motion]
duration = "1 s"
drives = { sl = "0" }
[[clearance]]
joint = "sl"
journal = "car"
radial = "5e-05 m"
journal_radius = "20 mm"
sleeve_length = "0.2 m"
axes = "free"

  [clearance.contact]
  law = "flores"
  restitution = 0.5
  young = ["207 GPa", "207 GPa"]
  poisson = [0.3, 0.3]
)toml";

// A slider in a rectangular guide with 10 um of play to its sides, 60 mm long, under the rod of a crank that stands upright, pressed by 1 kN.
constexpr const char* kSlider = R"toml(format = 1
name = "sc_a5"
gravity = ["0 m/s^2", "0 m/s^2", "0 m/s^2"]
[[body]]
name = "crank"
mass = "0.5 kg"
center_of_mass = ["0 m", "0 m", "0.025 m"]
inertia = ["0.001 kg m^2", "0.001 kg m^2", "0.001 kg m^2", "0 kg m^2", "0 kg m^2", "0 kg m^2"]
[[body]]
name = "rod"
mass = "0.2 kg"
center_of_mass = ["0.0968245836552 m", "0 m", "0.025 m"]
inertia = ["0.0007 kg m^2", "0.0007 kg m^2", "0.0007 kg m^2", "0 kg m^2", "0 kg m^2", "0 kg m^2"]
[[body]]
name = "sli"
mass = "1 kg"
center_of_mass = ["0.19364916731 m", "0 m", "0 m"]
inertia = ["0.002 kg m^2", "0.002 kg m^2", "0.002 kg m^2", "0 kg m^2", "0 kg m^2", "0 kg m^2"]
boresight = [1, 0, 0]
[[joint]]
name = "mot"
type = "revolute"
connects = ["ground", "crank"]
point = ["0 m", "0 m", "0 m"]
axis = [0, 1, 0]
driven = true
[[joint]]
name = "cp"
type = "spherical"
connects = ["crank", "rod"]
point = ["0 m", "0 m", "0.05 m"]
[[joint]]
name = "wp"
type = "cylindrical"
connects = ["rod", "sli"]
point = ["0.19364916731 m", "0 m", "0 m"]
axis = [0, 1, 0]
[[joint]]
name = "way"
type = "prismatic"
connects = ["ground", "sli"]
point = ["0.19364916731 m", "0 m", "0 m"]
axis = [1, 0, 0]
[motion]
duration = "0.5 s"
drives = { mot = "0" }
[[clearance]]
joint = "way"
guide = "rectangular"
journal = "sli"
width_gap = "1e-05 m"
height_gap = "3e-05 m"
width = "40 mm"
height = "30 mm"
length = "0.06 m"
width_direction = [0, 1, 0]
axes = "free"

  [clearance.contact]
  law = "flores"
  restitution = 0.5
  young = ["207 GPa", "207 GPa"]
  poisson = [0.3, 0.3]
[[load]]
joint = "way"
force = "-1000"
)toml";

// The column in a rectangular guide, with 50 and 20 um to its sides.
constexpr const char* kRectangularColumn = R"toml(format = 1
name = "col_re"
gravity = ["-9.81 m/s^2", "0 m/s^2", "0 m/s^2"]
[[body]]
name = "car"
mass = "4 kg"
center_of_mass = ["0.3 m", "0 m", "0 m"]
inertia = ["0.02 kg m^2", "0.03 kg m^2", "0.03 kg m^2", "0 kg m^2", "0 kg m^2", "0 kg m^2"]
boresight = [1, 0, 0]
[[joint]]
name = "sl"
type = "prismatic"
connects = ["ground", "car"]
point = ["0 m", "0 m", "0 m"]
axis = [1, 0, 0]
driven = true
[motion]
duration = "1 s"
drives = { sl = "0" }
[[clearance]]
joint = "sl"
guide = "rectangular"
journal = "car"
width_gap = "2e-05 m"
height_gap = "5e-05 m"
width = "0.06 m"
height = "0.04 m"
length = "0.2 m"
width_direction = [0, 1, 0]
axes = "free"

  [clearance.contact]
  law = "flores"
  restitution = 0.5
  young = ["207 GPa", "207 GPa"]
  poisson = [0.3, 0.3]
)toml";

// A slider whose mass overhangs and whose drive pushes it first and holds it back later.
constexpr const char* kPushedAndPulled = R"toml(format = 1
name = "sl_mv"
gravity = ["0 m/s^2", "0 m/s^2", "-9.81 m/s^2"]
[[body]]
name = "car"
mass = "4 kg"
center_of_mass = ["0.3 m", "0 m", "0.05 m"]
inertia = ["0.02 kg m^2", "0.03 kg m^2", "0.03 kg m^2", "0 kg m^2", "0 kg m^2", "0 kg m^2"]
boresight = [1, 0, 0]
[[joint]]
name = "sl"
type = "prismatic"
connects = ["ground", "car"]
point = ["0 m", "0 m", "0 m"]
axis = [1, 0, 0]
driven = true
[motion]
duration = "1 s"
drives = { sl = "0.25-0.25*cos(pi*t)" }
[[clearance]]
joint = "sl"
guide = "rectangular"
journal = "car"
width_gap = "2e-05 m"
height_gap = "5e-05 m"
width = "0.06 m"
height = "0.04 m"
length = "0.2 m"
width_direction = [0, 1, 0]
axes = "free"

  [clearance.contact]
  law = "flores"
  restitution = 0.5
  young = ["207 GPa", "207 GPa"]
  poisson = [0.3, 0.3]
)toml";

using MechanismPtr = std::shared_ptr<const Mechanism>;

std::string replaced(std::string text, const std::string& what, const std::string& by) {
  const std::size_t at = text.find(what);
  if (at == std::string::npos) throw std::logic_error("the scene has no " + what);
  return text.replace(at, what.size(), by);
}

// The same with its axes renamed: x is drawn along y, y along z, z along x.
std::string turned(const std::string& text) {
  std::string out;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t open = text.find('[', at);
    const std::size_t close = open == std::string::npos ? open : text.find(']', open);
    if (close == std::string::npos) return out + text.substr(at);
    const std::string inside = text.substr(open + 1, close - open - 1);
    std::vector<std::string> parts;
    for (std::size_t from = 0;;) {
      const std::size_t comma = inside.find(',', from);
      parts.push_back(inside.substr(from, comma - from));
      if (comma == std::string::npos) break;
      from = comma + 1;
    }
    const bool vector = inside.find_first_of("0123456789") != std::string::npos;
    const bool diagonal = parts.size() == 6;
    if (vector && (parts.size() == 3 || diagonal)) std::rotate(parts.begin(), parts.begin() + 2, parts.begin() + 3);
    out += text.substr(at, open - at) + "[";
    for (std::size_t k = 0; k < parts.size(); ++k) out += (k == 0 ? "" : ",") + parts[k];
    out += "]";
    at = close + 1;
  }
  return out;
}

MechanismPtr scene(const std::string& text) {
  return std::make_shared<const Mechanism>(read_mechanism_text(text, "tipping.toml"));
}

bool tips(const Mechanism& mechanism) {
  return ClearanceScene::at_start(mechanism, ideal_motion(mechanism, mechanism.parameters()), mechanism.parameters())
      .layout.tips;
}

PointingIndices index_of(const std::string& rung, const MechanismPtr& mechanism) {
  RunOptions options;
  options.sample_spacing = 0.0;
  options.model_look = ModelLook::none;
  return make_rung(rung, mechanism)->run(mechanism->parameters(), options).index;
}

TEST(Tipping, ATopHeavyColumnLeansOnItsGuide) {
  for (const std::string& text : {std::string(kColumn), turned(kColumn), turned(turned(kColumn))}) {
    const MechanismPtr mechanism = scene(text);
    EXPECT_TRUE(tips(*mechanism));
    for (const char* rung : {"quasistatic", "perturbation", "multibody"}) {
      const PointingIndices index = index_of(rung, mechanism);
      // 2 c / L, and what that is 0.3 m above.
      EXPECT_NEAR(index.boresight_error.max, 0.5e-3, 1e-7) << rung;
      EXPECT_NEAR(index.position_error.max, 0.15e-3, 5e-8) << rung;
      EXPECT_NEAR(index.boresight_error.rms, 0.5e-3, 1e-7) << rung;
    }
  }
}

// In both of its directions as far as the guide lets it.
TEST(Tipping, AColumnInARectangularGuideLeansIntoItsCorner) {
  for (const std::string& text : {std::string(kRectangularColumn), turned(kRectangularColumn)}) {
    const MechanismPtr mechanism = scene(text);
    for (const char* rung : {"quasistatic", "perturbation", "multibody"})
      EXPECT_NEAR(index_of(rung, mechanism).boresight_error.max / std::hypot(0.5e-3, 0.2e-3), 1.0, 2e-3) << rung;
  }
}

TEST(Tipping, IsNotOfAPushThatTurnsIntoAPull) { EXPECT_FALSE(tips(*scene(kPushedAndPulled))); }

TEST(Tipping, AHangingColumnStaysUpright) {
  const MechanismPtr mechanism = scene(replaced(kColumn, "-9.81 m/s^2", "9.81 m/s^2"));
  EXPECT_FALSE(tips(*mechanism));
  for (const char* rung : {"quasistatic", "perturbation", "multibody"})
    EXPECT_LT(index_of(rung, mechanism).boresight_error.max, 1e-12) << rung;
}

TEST(Tipping, IsSaidWithTheJointsName) {
  const MechanismPtr mechanism = scene(kColumn);
  for (const char* rung : {"quasistatic", "perturbation", "multibody"}) {
    const RunResult result = make_rung(rung, mechanism)->run(mechanism->parameters(), {});
    bool said = false;
    for (const std::string& warning : result.warnings)
      said = said || (warning.find("tip over") != std::string::npos && warning.find("\"sl\"") != std::string::npos);
    EXPECT_TRUE(said) << rung;
  }
}

std::vector<int> undecided(const Mechanism& mechanism) {
  return ClearanceScene::at_start(mechanism, ideal_motion(mechanism, mechanism.parameters()), mechanism.parameters())
      .layout.undecided;
}

bool says(const std::vector<std::string>& warnings, const char* what, const char* whose) {
  return std::any_of(warnings.begin(), warnings.end(), [&](const std::string& one) {
    return one.find(what) != std::string::npos && one.find(whose) != std::string::npos;
  });
}

// A hanging column is pushed upright, but to no side of its guide: whatever is as heavy to the left as to the right lies anywhere in between.
TEST(Tipping, SaysWhichJournalsNothingHoldsSomewhereInTheirPlay) {
  const MechanismPtr hanging = scene(replaced(kColumn, "-9.81 m/s^2", "9.81 m/s^2"));
  EXPECT_EQ(undecided(*hanging), std::vector<int>{0});
  for (const char* rung : {"quasistatic", "perturbation", "multibody"})
    EXPECT_TRUE(says(make_rung(rung, hanging)->run(hanging->parameters(), {}).warnings, "nothing pushes", "\"sl\""))
        << rung;
  EXPECT_FALSE(
      says(make_rung("envelope", hanging)->run(hanging->parameters(), {}).warnings, "nothing pushes", "\"sl\""));
  const MechanismPtr centred =
      scene(replaced(kColumn, "-9.81 m/s^2", "9.81 m/s^2") + "[initial]\njournals = \"centred\"\n");
  for (const char* rung : {"quasistatic", "perturbation", "multibody"})
    EXPECT_FALSE(says(make_rung(rung, centred)->run(centred->parameters(), {}).warnings, "nothing pushes", "\"sl\""))
        << rung;
}

TEST(Tipping, NothingIsUndecidedWhereLoadsPushEveryJournal) {
  for (const char* example : {"3-rrcpr/3-rrcpr.toml", "3-rrcpr/twelve-joints.toml", "four-bar/four-bar.toml",
                              "crank-slider/crank-slider.toml", "hexapod/play.toml"}) {
    const MechanismPtr mechanism =
        std::make_shared<const Mechanism>(read_mechanism(std::string(BORESIGHT_EXAMPLES) + "/" + example, {}));
    EXPECT_TRUE(undecided(*mechanism).empty()) << example;
  }
}

// The rod's force F makes the energy F (h psi^2 / 2 - y psi) of the slider's yaw and its shift to a side, h the rod along the guide, whose
// least within |y| + psi L / 2 <= w lies at psi = w / (h + L); drawn by F instead, the slider turns all the way, 2 w / L.
TEST(Tipping, ASliderTurnsUnderItsRod) {
  constexpr double w = 10e-6, L = 0.06, h = 0.19364916731;
  for (const bool pressed : {true, false}) {
    const std::string drawn = pressed ? std::string(kSlider) : replaced(kSlider, "\"-1000\"", "\"1000\"");
    for (const std::string& text : {drawn, turned(drawn)}) {
      const MechanismPtr mechanism = scene(text);
      for (const char* rung : {"quasistatic", "perturbation", "multibody"}) {
        const double yaw = pressed ? w / (h + L) : 2.0 * w / L;
        EXPECT_NEAR(index_of(rung, mechanism).boresight_error.max / yaw, 1.0, 2e-3) << rung << ' ' << pressed;
      }
    }
  }
}

TEST(Tipping, OfNoMechanismWhoseLoadsPushItsJournals) {
  for (const char* example : {"3-rrcpr/3-rrcpr.toml", "3-rrcpr/twelve-joints.toml", "four-bar/four-bar.toml",
                              "crank-slider/crank-slider.toml", "hexapod/play.toml"}) {
    const MechanismPtr mechanism =
        std::make_shared<const Mechanism>(read_mechanism(std::string(BORESIGHT_EXAMPLES) + "/" + example, {}));
    EXPECT_FALSE(tips(*mechanism)) << example;
  }
}

// A rung is asked for many samples, and keeps a scene for as long as it holds: whichever came before, each answers as if it were alone.
TEST(Tipping, IsKnownOfEachSampleInAnyOrder) {
  const MechanismPtr mechanism = scene(kColumn);
  Parameters tipping = mechanism->parameters(), hanging = tipping;
  hanging.gravity = -tipping.gravity;
  RunOptions options;
  options.sample_spacing = 0.0;
  for (const char* name : {"quasistatic", "perturbation", "multibody"}) {
    const auto rung = make_rung(name, mechanism);
    for (const bool tips : {false, true, true, false, true}) {
      const RunResult result = rung->run(tips ? tipping : hanging, options);
      EXPECT_NEAR(result.index.boresight_error.max, tips ? 0.5e-3 : 0.0, 1e-7) << name;
      EXPECT_EQ(std::any_of(result.warnings.begin(), result.warnings.end(),
                            [](const std::string& w) { return w.find("tip over") != std::string::npos; }),
                tips)
          << name;
    }
  }
}

}  // namespace tipping_test
}  // namespace boresight
