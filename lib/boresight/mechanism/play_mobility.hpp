// Which plays can move, and which only together: the offsets of the clearance joints in the freedoms that the mechanism has
// once it is opened at them, its drives held.
//
// Where several joints hold the same two parts (the two bearings of a shaft), play in one of them is held by the other. With
// N a basis of the motions that all rows in force allow and R_c the rows that joint c's play releases, the play moves in
// rank(R_c N) ways; plays of several joints hang together where the rank of all their R_c N is less than the sum.
#pragma once

#include <string>
#include <vector>

#include "boresight/mechanism/body_motion.hpp"
#include "boresight/mechanism/mechanism.hpp"

namespace boresight {

struct PlayMobility {
  struct Joint {
    int offsets = 0;  // that its play releases
    int movable = 0;  // of them, counted by rank
    std::vector<int>
        held_by;  // joints of which each, without its rows, would let more of it move; empty if none alone does
  };
  std::vector<Joint> joint;                // per clearance
  std::vector<std::vector<int>> together;  // clearances whose plays hang on each other, group by group
  std::vector<int> independent;            // per group: offsets that move on their own

  bool held(int clearance) const { return joint[clearance].movable < joint[clearance].offsets; }
  bool any_held() const;
};

// bodies: a pose of the ideal motion, of no symmetry.
PlayMobility analyse_play(const Mechanism& mechanism, const std::vector<BodyMotion>& bodies);

// Sentences on plays that cannot move at all; those that move in part or together.
std::vector<std::string> held_plays(const Mechanism& mechanism, const PlayMobility& play);
std::vector<std::string> bound_plays(const Mechanism& mechanism, const PlayMobility& play);

}  // namespace boresight
