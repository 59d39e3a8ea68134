// The bristles of LuGre friction within a rung's state: two numbers per contact place of each joint that sticks, after the
// rung's own state. Nothing where no joint sticks.
#pragma once

#include <vector>

#include "boresight/play/joint_play.hpp"

namespace boresight {

class BristleState {
 public:
  BristleState() = default;
  explicit BristleState(const std::vector<JointPlay>& joints) {
    for (std::size_t c = 0; c < joints.size(); ++c)
      if (joints[c].sticks)
        for (const ContactPlace place : joints[c].places()) slots_.push_back({c, static_cast<int>(place)});
  }

  Eigen::Index size() const { return 2 * static_cast<Eigen::Index>(slots_.size()); }
  bool empty() const { return slots_.empty(); }

  // From the state into the contacts' memory, for one stage of a step of length h [s].
  void hand_over(const Eigen::Ref<const VecX>& z, double h, std::vector<ContactMemory>& memory) const {
    for (std::size_t k = 0; k < slots_.size(); ++k) {
      ContactMemory& m = memory[slots_[k].clearance];
      m.bristle[slots_[k].place] = z.segment<2>(2 * static_cast<Eigen::Index>(k));
      // Inside the stability of RK4 (2.785 / h), with room.
      m.largest_bristle_rate = 2.0 / h;
    }
  }

  // rate_of(clearance): its Bristles<double>, how fast they bend.
  template <typename RateOf>
  void rates(const RateOf& rate_of, Eigen::Ref<VecX> z_dot) const {
    for (std::size_t k = 0; k < slots_.size(); ++k)
      z_dot.segment<2>(2 * static_cast<Eigen::Index>(k)) = rate_of(slots_[k].clearance)[slots_[k].place];
  }

  // At an accepted time: the bristles of contacts that have parted spring back.
  void release(const std::vector<ContactMemory>& memory, Eigen::Ref<VecX> z) const {
    for (std::size_t k = 0; k < slots_.size(); ++k)
      if (!memory[slots_[k].clearance].touching[slots_[k].place])
        z.segment<2>(2 * static_cast<Eigen::Index>(k)).setZero();
  }

 private:
  struct Slot {
    std::size_t clearance;
    int place;
  };
  std::vector<Slot> slots_;
};

}  // namespace boresight
