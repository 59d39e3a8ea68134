// One body on one joint with play, for every kind of play there is: files that tests run through all of them.
#pragma once

#include <cstdio>
#include <string>
#include <vector>

#include "boresight/contact/normal_law.hpp"
#include "boresight/io/mechanism_file.hpp"

namespace boresight::scenes {

struct PlayKind {
  const char *name, *type;
  bool driven;  // else its weight moves it
  // Keys of its [[clearance]], each gap written GAP; length: what it needs to tilt, and for laws of cylinders.
  const char *sizes, *length;
  bool tilts = true;  // may be parallel or free
};
inline void PrintTo(const PlayKind& kind, std::ostream* out) { *out << kind.name; }

inline const std::vector<PlayKind>& play_kinds() {
  static const char* kJournal = "radial = \"GAP\"\njournal_radius = \"8 mm\"\n";
  static const char* kLength = "sleeve_length = \"30 mm\"\n";
  static const std::vector<PlayKind> kinds = {
      {"revolute", "revolute", true,
       "radial = \"GAP\"\naxial = \"GAP\"\njournal_radius = \"8 mm\"\ncap_radius = \"12 mm\"\n", kLength},
      {"bearing_pair", "revolute", true,
       "bearing = \"pair\"\nspan = \"80 mm\"\nradial = \"GAP\"\naxial = \"GAP\"\njournal_radius = \"8 mm\"\n"
       "cap_radius = \"12 mm\"\n",
       kLength},
      {"cylindrical", "cylindrical", false, kJournal, kLength},
      {"prismatic_round", "prismatic", true, kJournal, kLength},
      {"prismatic_rectangular", "prismatic", true,
       "guide = \"rectangular\"\nwidth = \"40 mm\"\nheight = \"25 mm\"\nlength = \"50 mm\"\nwidth_gap = \"GAP\"\n"
       "height_gap = \"GAP\"\nwidth_direction = [0, 1, 0]\n",
       ""},
      {"spherical", "spherical", false, kJournal, "", false},
      {"universal", "universal", false,
       "radial = \"GAP\"\naxial = \"GAP\"\njournal_radius = \"8 mm\"\ncap_radius = \"12 mm\"\ncross_mass = \"0.5 kg\"\n"
       "cross_radius = \"30 mm\"\n",
       kLength},
      {"planar", "planar", false, "axial = \"GAP\"\npad_radius = \"30 mm\"\n", ""},
      {"planar_rectangular", "planar", false,
       "axial = \"GAP\"\nwidth = \"50 mm\"\nlength = \"70 mm\"\nwidth_direction = [0.8, 0.6, 0]\n", ""}};
  return kinds;
}

struct PlayScene {
  double gap = 0.05e-3;  // [m]
  bool tilts = false;
  std::string law = "flores";
  double restitution = 0.6, friction = 0.1, stiffness_scale = 1.0;
  const char* center_of_mass = "[\"2 mm\", \"5 mm\", \"-20 mm\"]";  // from the joint's point
  bool driven = true;                                               // where its kind is
  bool centred = false;                                             // else at rest
  double duration = 0.1;                                            // [s]
};

inline std::string number_text(double value, const char* unit) {
  char text[40];
  std::snprintf(text, sizeof text, "%.17g%s", value, unit);
  return text;
}

// Its weight is along -z, across the joint's axis or along a planar joint's normal.
inline std::string play_file(const PlayKind& kind, const PlayScene& s) {
  const std::string type = kind.type;
  const bool driven = kind.driven && s.driven;
  std::string sizes = kind.sizes;
  const std::string gap = number_text(s.gap, " m");
  for (std::size_t at = sizes.find("GAP"); at != std::string::npos; at = sizes.find("GAP", at))
    sizes.replace(at, 3, gap);
  std::string text =
      "format = 1\nname = \"play\"\ngravity = [\"0 m/s^2\", \"0 m/s^2\", \"-9.81 m/s^2\"]\n[[body]]\nname = \"arm\"\n"
      "mass = \"2 kg\"\ncenter_of_mass = " +
      std::string(s.center_of_mass) +
      "\ninertia = [\"0.004 kg m^2\", \"0.005 kg m^2\", \"0.003 kg m^2\"]\nboresight = [1, 0, 0]\n"
      "[[joint]]\nname = \"J\"\ntype = \"" +
      type + "\"\nconnects = [\"ground\", \"arm\"]\npoint = [\"0 mm\", \"0 mm\", \"0 mm\"]\n";
  if (type != "spherical") text += type == "planar" ? "axis = [0, 0, 1]\n" : "axis = [1, 0, 0]\n";
  if (type == "universal") text += "second_axis = [0, 1, 0]\n";
  if (driven) text += "driven = true\n";
  text += "[motion]\nduration = \"" + number_text(s.duration, " s") + "\"\n";
  if (driven)
    text += type == "revolute" ? "drives = { J = \"0.3*sin(30*t)\" }\n" : "drives = { J = \"0.02*sin(30*t)\" }\n";
  if (s.centred) text += "[initial]\njournals = \"centred\"\n";
  text += "[[clearance]]\njoint = \"J\"\n";
  if (type != "universal") text += "journal = \"arm\"\n";
  text += sizes + kind.length;
  if (kind.tilts) text += s.tilts ? "axes = \"free\"\n" : "axes = \"parallel\"\n";
  text += "[clearance.contact]\nlaw = \"" + s.law + "\"\nrestitution = " + number_text(s.restitution, "") +
          "\nstiffness_scale = " + number_text(s.stiffness_scale, "") + "\n";
  if (normal_law(s.law).geometry == ContactGeometry::linear)
    text += "stiffness = \"1e7 N/m\"\ndamping = \"200 N s/m\"\n";
  return text + "[clearance.friction]\n" +
         (s.friction > 0.0 ? "coefficient = " + number_text(s.friction, "") : std::string("law = \"none\"")) + "\n";
}

inline MechanismDescription play_mechanism(const PlayKind& kind, const PlayScene& s) {
  return read_mechanism_text(play_file(kind, s), "play.toml");
}

}  // namespace boresight::scenes
