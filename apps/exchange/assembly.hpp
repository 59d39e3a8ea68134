// Bodies and joints from the parts of a Drawing: parts that are fixed to each other are one body, and what stands still is the ground.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "exchange/drawing.hpp"

namespace boresight::app {

// What the user decides about an import.
struct ImportChoices {
  std::string ground;                         // a part that stands still; "": as the file says
  std::string boresight_part;                 // "": the part furthest from the ground
  Vec3 boresight_axis = Vec3::UnitX();        // in that part's frame
  std::map<std::string, std::string> drives;  // joint -> its course; empty: the joints that the file drives stand still
  bool drives_given = false;                  // then those alone are driven
  std::string duration = "1 s";
};

struct Assembly {
  MechanismDescription mechanism;             // bodies, joints, springs, gravity, boresight; no motion
  std::map<std::string, std::string> drives;  // of the driven joints, by name
  std::vector<Remark> assumed, left_out;
};

// Throws InputError: a part or joint that is not there, nothing that moves, a joint that cannot be driven.
Assembly assembled(Drawing drawing, const ImportChoices& choices);

}  // namespace boresight::app
