// The ISO 286 system of limits and fits, as far as fits with clearance need it.
//
// Tolerance classes of ISO 286-1:2010 for nominal sizes up to 500 mm: grades IT1 to IT13 (Table 1); fundamental
// deviations c, d, e, f, g, h, js of shafts (Tables 4 and 5) and C, D, E, F, G, H, JS of holes, whose lower deviation
// is the shaft's upper one with the other sign (general rule). Not covered: a, b, cd, ef, fg, j, k to zc and their
// holes; sizes above 500 mm. The tables are the standard's rounded values, not its formulas.
#pragma once

#include <string>

namespace boresight {

// Deviations from the nominal size: the size lies between nominal + lower and nominal + upper.
struct ToleranceZone {
  std::string name;                 // "H7"
  double lower = 0.0, upper = 0.0;  // [m]
};

struct Fit {
  std::string name;      // "20 H7/g6"
  double nominal = 0.0;  // [m]
  ToleranceZone hole, shaft;
  double least_clearance() const { return hole.lower - shaft.upper; }    // diametral [m]; negative: interference
  double largest_clearance() const { return hole.upper - shaft.lower; }  // diametral [m]
};

// "NOMINAL HOLE/SHAFT", the nominal size in mm. Throws ValueFault: found, expected, and the nearest that there is.
Fit parse_fit(const std::string& text);

}  // namespace boresight
