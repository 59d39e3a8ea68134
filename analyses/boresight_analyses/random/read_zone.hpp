// The tolerance zones of a drawing (ISO 1101:2017) as they stand in a `distribution`:
//
//   { cylinder = { diameter = "0.05 mm" } }                        two translations: a point of the disc of that diameter
//   { cylinder = { diameter = "0.02 mm", length = "30 mm" } }      two rotations
//   { planes = { width = "0.05 mm" } }                             one translation, within half the width to either side
//   { planes = { width = "0.02 mm", length = "30 mm" } }           one rotation
//
// With a length the zone is one of orientation (perpendicularity, parallelism, angularity): an axis of this length lies within
// the cylinder, wherever in it. Its ends are then at most the diameter d apart across the cylinder's axis, so it leans by at
// most d / length, to any side: the tilt vector, which the two rotations make, lies in a disc of *radius* d / length. (The angle
// is atan(d / length); what is left out is (d / length)^2 / 3 of it.) Between two planes the same holds of one rotation.
//
// Zones lie around the values that the mechanism file gives; how probable what is in them, zone_law.hpp.
#pragma once

#include <string>
#include <vector>

#include "boresight/io/cursor.hpp"
#include "boresight/keys/units.hpp"
#include "boresight/mechanism/description.hpp"
#include "boresight_analyses/random/distribution.hpp"
#include "boresight_analyses/random/zone_law.hpp"

namespace boresight {

// The `zone` of a distribution.
ZoneLaw read_zone_law(Cursor& distribution);

// How far a parameter of this unit may be off to either side, from the table of a cylinder (across: "diameter") or of planes
// ("width"). Throws InputError.
double read_zone_reach(Cursor& zone, const std::string& across, const SiUnit& unit);

// Two errors of one kind of a joint's frame in one body are the coordinates of a point: only along perpendicular directions is it in the
// disc. `paths`: what a cylinder draws together, as `key` names them. Throws InputError.
void require_perpendicular(Cursor& entry, const std::string& key, const MechanismDescription& mechanism,
                           const std::vector<std::string>& paths);

// Of planes, around `centre`.
DistributionPtr make_between_planes(double centre, double reach, ZoneLaw law);

}  // namespace boresight
