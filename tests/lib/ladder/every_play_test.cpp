// Every kind of joint that can have play, with every contact law and both kinds of axes, on every rung: a motion without a number that is none,
// or a refusal that says why. One table, made from the program's own lists.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "boresight/contact/normal_law.hpp"
#include "boresight/io/mechanism_file.hpp"
#include "boresight/ladder/ladder.hpp"
#include "boresight/mechanism/error.hpp"

namespace boresight {
namespace every_play_test {

struct Kind {
  const char *name, *type;
  bool driven;
  const char *sizes, *length;  // length: what it needs to tilt, and for laws of cylinders
};
const Kind kKinds[] = {
    {"revolute", "revolute", true,
     "radial = \"0.05 mm\"\naxial = \"0.05 mm\"\njournal_radius = \"8 mm\"\ncap_radius = \"12 mm\"\n",
     "sleeve_length = \"30 mm\"\n"},
    {"cylindrical", "cylindrical", false, "radial = \"0.05 mm\"\njournal_radius = \"8 mm\"\n",
     "sleeve_length = \"30 mm\"\n"},
    {"prismatic_round", "prismatic", true, "radial = \"0.05 mm\"\njournal_radius = \"8 mm\"\n",
     "sleeve_length = \"30 mm\"\n"},
    {"prismatic_rectangular", "prismatic", true,
     "guide = \"rectangular\"\nwidth = \"40 mm\"\nheight = \"25 mm\"\nlength = \"50 mm\"\nwidth_gap = \"0.05 mm\"\n"
     "height_gap = \"0.03 mm\"\nwidth_direction = [0, 0, 1]\n",
     ""},
    {"spherical", "spherical", false, "radial = \"0.05 mm\"\njournal_radius = \"8 mm\"\n", ""},
    {"planar", "planar", false, "axial = \"0.05 mm\"\npad_radius = \"30 mm\"\n", ""}};

struct Case {
  const Kind* kind;
  const NormalLawEntry* law;
  bool tilts;
};

std::vector<Case> every_case() {
  std::vector<Case> all;
  for (const Kind& kind : kKinds)
    for (const NormalLawEntry& law : normal_laws())
      for (const bool tilts : {false, true}) all.push_back({&kind, &law, tilts});
  return all;
}

// A body on its joint, its weight beside it; what moves it is its drive, or else its weight.
std::string scene(const Case& c) {
  const std::string type = c.kind->type;
  std::string text =
      "format = 1\nname = \"play\"\ngravity = [\"0 m/s^2\", \"0 m/s^2\", \"-9.81 m/s^2\"]\n[[body]]\nname = \"arm\"\n"
      "mass = \"2 kg\"\ncenter_of_mass = [\"2 mm\", \"5 mm\", \"-20 mm\"]\n"
      "inertia = [\"0.004 kg m^2\", \"0.005 kg m^2\", \"0.003 kg m^2\"]\nboresight = [1, 0, 0]\n"
      "[[joint]]\nname = \"J\"\ntype = \"" +
      type + "\"\nconnects = [\"ground\", \"arm\"]\npoint = [\"0 mm\", \"0 mm\", \"0 mm\"]\n";
  if (type != "spherical") text += type == "planar" ? "axis = [0, 0, 1]\n" : "axis = [1, 0, 0]\n";
  if (c.kind->driven) text += "driven = true\n";
  text += "[motion]\nduration = \"0.1 s\"\n";
  if (c.kind->driven)
    text += type == "revolute" ? "drives = { J = \"0.3*sin(30*t)\" }\n" : "drives = { J = \"0.02*sin(30*t)\" }\n";
  text += "[[clearance]]\njoint = \"J\"\njournal = \"arm\"\n" + std::string(c.kind->sizes) + c.kind->length;
  if (c.tilts) text += "axes = \"free\"\n";
  text += "[clearance.contact]\nlaw = \"" + std::string(c.law->name) + "\"\nrestitution = 0.6\n";
  if (c.law->geometry == ContactGeometry::linear) text += "stiffness = \"1e7 N/m\"\ndamping = \"200 N s/m\"\n";
  return text + "[clearance.friction]\ncoefficient = 0.1\n";
}

std::string name_of(const testing::TestParamInfo<Case>& info) {
  std::string name =
      std::string(info.param.kind->name) + "_" + info.param.law->name + (info.param.tilts ? "_free" : "_parallel");
  std::replace_if(
      name.begin(), name.end(), [](char letter) { return std::isalnum(static_cast<unsigned char>(letter)) == 0; }, '_');
  return name;
}

class EveryPlay : public testing::TestWithParam<Case> {};

TEST_P(EveryPlay, IsFollowedOrRefusedWithAReasonOnEveryRung) {
  std::shared_ptr<const Mechanism> mechanism;
  try {
    mechanism = std::make_shared<const Mechanism>(read_mechanism_text(scene(GetParam()), "play.toml"));
  } catch (const InputError& refusal) {
    // By line and key.
    EXPECT_EQ(std::string(refusal.what()).rfind("play.toml:", 0), 0u) << refusal.what();
    EXPECT_NE(std::string(refusal.what()).find("expected"), std::string::npos) << refusal.what();
    return;
  }
  int followed = 0;
  for (const char* rung : {"envelope", "quasistatic", "perturbation", "multibody"})
    for (const char* formulation : {"tree", "paper"}) {
      RunOptions options;
      if (rung == std::string("multibody"))
        options.formulation = formulation;
      else if (formulation == std::string("paper"))
        continue;
      try {
        const RunResult run = make_rung(rung, mechanism)->run(mechanism->parameters(), options);
        ++followed;
        for (const double number :
             {run.index.position_error.max, run.index.position_error.rms, run.index.orientation_error.max,
              run.contact.at(0).max_force, run.contact.at(0).max_penetration})
          EXPECT_TRUE(std::isfinite(number)) << rung << formulation;
        EXPECT_GT(run.index.position_error.max, 0.0) << rung << formulation;
      } catch (const ComputationError& refusal) {
        EXPECT_GT(std::string(refusal.what()).size(), 40u) << rung << formulation;
        EXPECT_TRUE(rung == std::string("envelope") || rung == std::string("quasistatic"))
            << rung << ": " << refusal.what();
      }
    }
  EXPECT_GE(followed, 3);  // dynamics of every kind
}

INSTANTIATE_TEST_SUITE_P(Ladder, EveryPlay, testing::ValuesIn(every_case()), name_of);

}  // namespace every_play_test
}  // namespace boresight
