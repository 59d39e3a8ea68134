// What a sample costs before its motion is followed, where what scatters changes the scene: counted, as its evaluations are (counted_cost.hpp).
// A sample of other masses, gravity or springs has tables of its own, and the journals that these may tip are looked for; one whose masses lie
// elsewhere, or whose ideal motion is simulated, has a whole scene of its own. Sums and products, with b bodies, j joints and n coordinates of
// the play, the largest terms:
//
//   a knot of the scene   j (10000 + 1700 n) + b n (100 + 20 n)   where the joints' rows tell all motion: four factorisations of J W J^T by
//                                                                  blocks, 1500 a joint, and 4 + 2 n solves with a refinement each, 720
//                         4 (6 b)^3 + 8 n (6 b)^2                  else: three dense factorisations, solves, rows
//   a row of the tables   b (6 n^2 + 12 n) + 3 n^3, 20 to make a cubic of each number, 1000 for some ten small matrices on the heap
//   a look for tipping    a knot, and the rank of the joints' rows: 4/3 (6 b)^3; by singular values 20 (6 b)^3
//   a simulated knot      twice seven evaluations of multibody
//
// A core of 2023 does about one of them a nanosecond: matrices as small as these wait for what they are looked up and kept in as long as they are
// added up. It holds to about a factor of two, as the other counts do.
#pragma once

#include <string>
#include <vector>

#include "boresight/mechanism/mechanism.hpp"

namespace boresight {

// Of a sample on a rung, the mean over these [s]; 0 where they all share one scene. on_lanes: of the perturbation rung.
double counted_scene_cost(const std::string& rung, bool on_lanes, const Mechanism& mechanism,
                          const std::vector<Parameters>& samples);

}  // namespace boresight
