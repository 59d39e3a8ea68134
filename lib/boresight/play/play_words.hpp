// What the parts of joints with play are called, in words for people: the insert and its seat, of which every kind has its own.
#pragma once

#include <string>
#include <vector>

namespace boresight {

struct JointPlay;
struct MechanismDescription;

// Of one kind.
struct PlayWords {
  const char *insert, *seat;  // "journal", "sleeve"
};

// Of all joints with play together: where there are several kinds "journal or ball", "journals and balls".
struct PartsInPlay {
  std::string insert, seat, inserts, seats;
};
PartsInPlay parts_in_play(const std::vector<JointPlay>& joints);
PartsInPlay parts_in_play(const MechanismDescription& mechanism);

}  // namespace boresight
