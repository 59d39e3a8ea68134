// How a size, a place or a direction lies in its tolerance zone, which the standards leave open.
//
//   normal    centred, the zone is six standard deviations wide (a process with C_p = 1), and what lies outside is sorted out
//   uniform   anywhere in the zone with the same probability, the wider assumption
#pragma once

namespace boresight {

enum class ZoneLaw { normal, uniform };

}  // namespace boresight
