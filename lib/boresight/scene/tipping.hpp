// Whether loads tip journals over that they push nowhere.
//
// A top-heavy column on the axis of its guide has no load on its tilt; but the least tilt makes one, which grows with it, until the column
// leans on the guide's ends. A slider between its guides does so under a rod that presses along them. Drawn exactly, such a mechanism stands
// on a saddle of its energy: in the middle of its play everything balances, and nothing stays there. Which side it leans to nothing decides.
//
// With journals where the linear balance has them, N the directions along which contacts hold nothing and K the loads' own (geometric) stiffness,
// a load on z of -K z, that is so where N^T K N has a negative eigenvalue.
//
// Along ways of N of which K makes nothing either, whichever sign, nothing decides where a journal lies: the ring of an azimuth bearing whose
// loads all point down its axis. It starts in the middle then, as well as anywhere.
#pragma once

#include <string>
#include <vector>

#include "boresight/scene/resting_start.hpp"

namespace boresight {

// Along which the contacts of a balance at z hold nothing: orthonormal columns, in clearances (RestingBalance::unit()).
MatX ways_not_held(const RestingBalance& balance, const VecX& z);

struct Tipping {
  std::vector<int> clearances;  // whose journals tip over; none where all stay
  VecX way;                     // of the coordinates, a clearance long: along which the energy falls most
  double fall = 0.0;            // -way^T K way [N m]: a load that pushes more along the way decides instead
  std::vector<int> undecided;   // clearances that take part where neither contact nor load holds anything
};
// balance: without the loads' stiffness. acting: what weighs and resists on each
// coordinate without regard to sign [N, N m]; what rounding leaves of K is small against it.
Tipping tipped_by_loads(const RestingBalance& balance, const SceneLayout& layout, const MatX& K, const VecX& acting);

// The same for people; empty where none is.
std::string tipping_sentence(const Mechanism& mechanism, const SceneLayout& layout);
// Of where journals start that nothing holds; empty where something does, and where the file has journals start in the middle.
std::string undecided_sentence(const Mechanism& mechanism, const SceneLayout& layout);

}  // namespace boresight
