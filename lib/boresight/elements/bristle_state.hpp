// The bristles of LuGre friction: two numbers per contact place of each joint that sticks. None where no joint sticks.
#pragma once

#include <functional>

#include "boresight/elements/element_state.hpp"
#include "boresight/play/joint_play.hpp"

namespace boresight {

class BristleState final : public ElementState {
 public:
  // memory: of the contacts, the caller's, where a right-hand side finds the bristles; per joint. rate_of: how fast those of a joint
  // bend, after its wrench was computed.
  BristleState(const std::vector<JointPlay>& joints, std::vector<ContactMemory>& memory,
               std::function<const Bristles<double>&(int)> rate_of);

  Eigen::Index size() const override { return 2 * static_cast<Eigen::Index>(slots_.size()); }
  void take(const Eigen::Ref<const VecX>& x, double h) override;
  void rates(Eigen::Ref<VecX> x_dot) const override;
  void accept(Eigen::Ref<VecX> x) override;
  // Of the deflection at which they break away.
  void tolerances(double share, Eigen::Ref<VecX> error) const override;

 private:
  struct Slot {
    int clearance, place;
    double break_away;  // mu_s / s0 [m]
  };
  std::vector<Slot> slots_;
  std::vector<ContactMemory>& memory_;
  std::function<const Bristles<double>&(int)> rate_of_;
};

}  // namespace boresight
