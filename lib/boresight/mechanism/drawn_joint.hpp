// A bearing pair as the one joint that it is drawn as.
#pragma once

#include "boresight/mechanism/description.hpp"

namespace boresight {

// A bearing pair is drawn as one joint, between its bearings: NAME, which keeps the drive, and NAME.floating, the one that slides.
// The floating bearing of a pair that `joint` is the fixed one of; -1: `joint` is no such.
int floating_bearing(const MechanismDescription& mechanism, int joint);
// Whether `joint` itself is the floating bearing of a pair.
bool is_floating_bearing(const MechanismDescription& mechanism, int joint);
// Where `joint` was drawn: its point, or the middle of the pair that it is the fixed bearing of.
Vec3 drawn_point(const MechanismDescription& mechanism, int joint);

}  // namespace boresight
