// What each standing error of a mechanism does to where it points: said by `check` before anything is scattered.
#pragma once

#include <string>
#include <vector>

#include "boresight/mechanism/ideal_motion.hpp"
#include "boresight/mechanism/mechanism.hpp"

namespace boresight::app {

struct ErrorEffect {
  std::string name, unit;                  // unit: of its value, "m", "rad", "K" or "1" of a scale
  double value = 0.0;                      // in the file [SI]
  double position = 0.0, boresight = 0.0;  // the largest over the motion, per SI unit of the error [m, rad]
  bool uses_play = false;  // takes up play of joints that hold each other: how these then rest moves more
  std::string strain;      // why the mechanism cannot take it up; "": it can

  bool does_nothing() const { return strain.empty() && !uses_play && position == 0.0 && boresight == 0.0; }
};

// To first order, at instants along the commanded motion; influences below rounding are zero. In the order of the file.
std::vector<ErrorEffect> error_effects(const Mechanism& mechanism, const IdealMotion& commanded);

}  // namespace boresight::app
