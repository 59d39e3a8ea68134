// The ideal mechanism, at home, as a file that other programs show and move: no play, no errors, no loads, no motion.
#pragma once

#include <string>
#include <vector>

#include "boresight/mechanism/mechanism.hpp"

namespace boresight::app {

struct Written {
  std::string text;
  std::vector<std::string> left_out;  // one line each
};

// SDF 1.9. Cylindrical and planar joints become two or three, with links of hardly any mass between them.
Written sdf_of(const Mechanism& mechanism);
// MJCF: a tree, closed by equalities.
Written mjcf_of(const Mechanism& mechanism);

// What neither format holds, or a file for viewing need not.
std::vector<std::string> not_written(const Mechanism& mechanism, bool with_springs);
// Mass of links that stand for nothing, of the lightest body's.
inline constexpr double kBetweenMass = 1e-6;
double between_mass(const Mechanism& mechanism);

}  // namespace boresight::app
