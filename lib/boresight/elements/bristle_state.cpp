#include "boresight/elements/bristle_state.hpp"

#include <limits>

namespace boresight {

BristleState::BristleState(const std::vector<JointPlay>& joints, std::vector<ContactMemory>& memory,
                           std::function<const Bristles<double>&(int)> rate_of)
    : memory_(memory), rate_of_(std::move(rate_of)) {
  for (std::size_t c = 0; c < joints.size(); ++c)
    if (joints[c].sticks)
      for (const ContactPlace place : joints[c].places())
        slots_.push_back({static_cast<int>(c), static_cast<int>(place),
                          joints[c].lugre.stiction / joints[c].lugre.bristle_stiffness});
}

void BristleState::take(const Eigen::Ref<const VecX>& x, double h) {
  Eigen::Index k = 0;
  for (const Slot& slot : slots_) {
    ContactMemory& memory = memory_[static_cast<std::size_t>(slot.clearance)];
    memory.bristle[slot.place] = x.segment<2>(k);
    // Inside the stability of RK4 (2.785 / h), with room.
    memory.largest_bristle_rate = h > 0.0 ? 2.0 / h : std::numeric_limits<double>::infinity();
    k += 2;
  }
}

void BristleState::rates(Eigen::Ref<VecX> x_dot) const {
  Eigen::Index k = 0;
  for (const Slot& slot : slots_) {
    x_dot.segment<2>(k) = rate_of_(slot.clearance)[slot.place];
    k += 2;
  }
}

void BristleState::accept(Eigen::Ref<VecX> x) {
  Eigen::Index k = 0;
  for (const Slot& slot : slots_) {
    if (!memory_[static_cast<std::size_t>(slot.clearance)].touching[slot.place]) x.segment<2>(k).setZero();
    k += 2;
  }
}

void BristleState::tolerances(double share, Eigen::Ref<VecX> error) const {
  Eigen::Index k = 0;
  for (const Slot& slot : slots_) {
    error.segment<2>(k).setConstant(share * slot.break_away);
    k += 2;
  }
}

}  // namespace boresight
