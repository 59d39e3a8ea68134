// Whether gaps that redundant joints tie together leave room for what standing errors shift the joints' offsets by. Journals go where the
// mechanism, its drives held, lets them: with R the rows that the plays release and N a basis of the motions that all other rows allow, their
// offsets are shift + R N u. There is room where some u leaves no contact pressed; else the u of least pressure is sought,
//
//     min over u of sum_k max(0, p_k(shift + R N u))^2,     p_k the depths of the contacts,
//
// by Gauss and Newton's steps, damped (Levenberg 1944, Quarterly of Applied Mathematics 2, 164-168). The p_k are convex, up to the square of a
// tilt, so that there is one minimum, and room for a share of the shift wherever there is room for a larger one.
#pragma once

#include <vector>

#include "boresight/mechanism/constraint_system.hpp"
#include "boresight/mechanism/offset_layout.hpp"
#include "boresight/play/joint_play.hpp"

namespace boresight {

class TiedRoom {
 public:
  // asked: the clearances whose contacts count. All of these outlive it.
  TiedRoom(const Mechanism& mechanism, const OffsetLayout& layout, const std::vector<JointPlay>& plays,
           std::vector<bool> asked);

  // The pose of the bodies.
  void take(const std::vector<BodyMotion>& bodies);
  // Whether nothing is pressed with the offsets as they are shifted, no journal having moved: of any pose.
  bool fits_unmoved(const VecX& shift) const;
  // The joints' offsets, as OffsetLayout has them, where they are pressed least.
  VecX least_pressed(const VecX& shift) const;
  // Of one of them there [m]; not positive where it is free.
  double depth(int clearance, const VecX& offsets) const;
  // The largest force of its contacts there [N].
  double force(int clearance, const VecX& offsets) const;
  // The largest share of the shift, up to 1, for which there is room.
  double share_with_room(const VecX& shift) const;

  // What is pressed in by no more than this is rounding [m].
  static constexpr double kRounding = 1e-9;

 private:
  bool has_room(const VecX& shift) const;
  VecX depths(const VecX& offsets) const;  // of all places of all that are asked
  PlayMotion<double> motion_of(int clearance, const VecX& offsets) const;

  const Mechanism& mechanism_;
  const OffsetLayout& layout_;
  const std::vector<JointPlay>& plays_;
  std::vector<bool> asked_;
  std::vector<JointCoordinates> joint_coordinates_;  // per clearance, of the pose last taken
  MatX moved_;  // offsets per motion: R N, with motions of one metre or of as much as that turns
};

}  // namespace boresight
