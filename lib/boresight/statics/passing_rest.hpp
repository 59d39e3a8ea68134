// Whether a maximum of resting journals is that of a passage. Where a load changes its sign a journal's rest goes from one side of its play to
// the other between two instants, and where two do so one shortly after the other, there are places between that no journal stays at. A
// maximum there is of the static model alone: a real journal takes time to cross.
#pragma once

#include <string>
#include <vector>

#include "boresight/play/resting_play.hpp"
#include "boresight/pointing/indices.hpp"

namespace boresight {

// A maximum by less above what is on both sides is one of the motion [relative].
inline constexpr double kRiseOfPassage = 0.05;

struct Passage {
  double t = 0.0;                            // [s]
  std::vector<PointingQuantity> quantities;  // whose maximum it is
  std::vector<std::string> joints;           // whose rest changes sides
  double rise = 0.0;                         // the largest of these maxima over what is on both sides, relative
};

// Of a maximum and of the values beside it, how far it rises above the larger one, relative; 0 where it is no passage's.
double rise_above(double maximum, double before, double after);

// Across or along the axis it is farther from where it was than it is from the middle; or what tilts or rolls lies the other way.
bool changes_sides(const RestingPlay& before, const RestingPlay& after);

// "the largest position error, at t = 0.5123 s, is that of a passage: ..."
std::string passage_sentence(const Passage& passage);

}  // namespace boresight
