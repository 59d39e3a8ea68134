// Where the journals rest at an instant if redundant joints tie their offsets together (two bearings of one shaft, closed loops of joints
// with play): all of them at once, at the least of the contacts' elastic energy less the work of the loads r(t) that the ideal joints carry,
//
//     V(z) = sum_c U_c(S_c z + s_c) + z . K z / 2 - r(t) . z
//
// over the coordinates z of the deviation: the balance of resting_start.hpp, instant by instant, each from the one before. S: offsets per
// coordinate; s: what standing errors shift them by; K: the springs. Contacts are without friction.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "boresight/scene/resting_start.hpp"
#include "boresight/statics/reaction_table.hpp"

namespace boresight {

class TiedRest {
 public:
  TiedRest(const PreparedScene& prepared, const StandingDisplacement& standing, const Parameters& parameters,
           const ReactionTable& reactions);
  TiedRest(const TiedRest&) = delete;
  TiedRest& operator=(const TiedRest&) = delete;

  struct Rest {
    VecX z;
    std::vector<RestingPlay> joint;
  };
  // before: a moment before; null at the start. Throws ComputationError, naming the time, where there is no balance.
  Rest at(const ReactionTable::Instant& now, const Rest* before);
  // The joints' offsets at the instant last asked for.
  const RestingBalance& balance() const { return balance_; }

 private:
  void take(double t, const VecX& reaction);
  RestingPlay resting(std::size_t joint, const VecX& z) const;

  const ReactionTable& reactions_;
  SceneLayout layout_;
  std::shared_ptr<const SceneTables> tables_;
  TimeTable springs_;  // n x n, or no functions
  RestingBalance balance_;
  std::string inserts_;
  std::vector<double> row_;
  MatX stiffness_;
  double largest_ = 0.0;  // load of the motion, as RestingBalance::size has it [N m]
};

}  // namespace boresight
