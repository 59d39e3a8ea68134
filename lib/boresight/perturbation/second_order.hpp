// What the perturbation rung leaves out, looked at where its deviation is largest: the same deviation made
// exactly, by closing the joints of the multibody formulation around it. Relative to what the rung itself has
// there, it comes to three shares:
//   pose       |x_exact(z) - E z| / |E z|        the pose is not linear in the offsets
//   contacts   |E dz| / |E z|                    nor are the offsets that others decide (redundant joints): where such a journal is
//                                                farther in or out than B z says, its contact takes the others along by dz, B dz =
//                                                -(xi_exact - B z)
//   forces     |dr| / |r|                        what pushes the journals changes with the offsets themselves and with the square of their
//                                                rates: dr is what remains of the forces at z and z_dot when M_r, C, K and r have had
//                                                their part
// The forces that act on the offsets are those of the ideal joints. Where redundant joints can share them in many ways, they are shared as
// contacts shared theirs on the average meanwhile: which of two bearings takes the thrust decides how it turns a shaft that tilts.
// The first two shift every index by as much, maximum or mean square; the last turns, deepens and delays where journals go. It is
// taken for each journal across and along its axis apart, weighted by its part of the displacement: along
// its axis a journal may be pushed by a force so small that little changes it much. Where a motion starts with its journals at rest,
// no less is stated than
//   rest       |x_rest,exact - E z_rest| / |E z|  the balance on the mechanism's own geometry lies elsewhere
//
//   LargestDeviations largest(duration);
//   largest.add(t, size, z, z_dot);             // along the motion
//   second_order(mechanism, prepared, parameters, largest, result.index, result.start, false).whole;
#pragma once

#include <algorithm>
#include <utility>
#include <vector>

#include "boresight/scene/scene_rung.hpp"

namespace boresight {

// The largest deviation of each part of a motion: what is next to nothing where the loads are large may not be where they are small.
class LargestDeviations {
 public:
  // Enough for a share, and to follow what changes with a motion's speed.
  static constexpr int kFew = 48, kMany = 384;
  explicit LargestDeviations(double duration, int parts = kFew) : duration_(duration), parts_(parts) {}

  struct Deviation {
    double t = 0.0, size = 0.0;
    VecX z, z_dot;
    double part_time = 0.0;  // of the part that was looked at [s]
    VecX load_time;          // what contacts load the offsets with, over that time [N s, N m s]; empty: not known
  };
  // size: of the deviation, against the mechanism's. load: of contacts on all offsets, in the order of OffsetLayout, since the instant
  // before; empty where nobody knows.
  void add(double t, double size, const Eigen::Ref<const VecX>& z, const Eigen::Ref<const VecX>& z_dot,
           const VecX& load = VecX()) {
    const int last = static_cast<int>(parts_.size()) - 1;
    Deviation& largest = parts_[std::clamp(static_cast<int>((last + 1) * t / duration_), 0, last)];
    const double since = t - std::exchange(t_, t);
    if (since > 0.0 && load.size() > 0) {
      if (largest.load_time.size() == 0) largest.load_time = VecX::Zero(load.size());
      largest.load_time += since * load;
      largest.part_time += since;
    }
    if (!(size > largest.size)) return;
    largest.t = t;
    largest.size = size;
    largest.z = z;
    largest.z_dot = z_dot;
  }
  const std::vector<Deviation>& parts() const { return parts_; }
  void forget() {
    parts_.assign(parts_.size(), {});
    t_ = 0.0;
  }

 private:
  double duration_, t_ = 0.0;
  std::vector<Deviation> parts_;
};

// What the linear rung misses at one instant of what acts.
struct Missed {
  double t = 0.0;     // [s]
  VecX acceleration;  // of the coordinates where nothing touches: beyond that of the linear forces and the reduced mass
  MatX inverse_mass;  // by what forces on the coordinates accelerate them more there
  VecX offset;        // of the offsets that others decide, in the order of joints: beyond B z
};

struct SecondOrder {
  PerQuantity pose = {};  // by pose, contacts and rest, relative to the rung's own indices
  PerQuantity whole =
      {};             // by all of it; 1 where a deviation cannot be made exactly (a singular pose within its reach)
  bool free = false;  // whether there is a freedom that nothing drives
  std::vector<Missed> missed;  // in the order of time, where it is wanted
  VecX start;  // likewise: of the coordinates and their rates as journals rest, beyond the linear balance
};

// index: of the motion from start [s] on.
SecondOrder second_order(const Mechanism& mechanism, const PreparedScene& prepared, const Parameters& parameters,
                         const LargestDeviations& largest, const PointingIndices& index, double start,
                         bool want_missed);

}  // namespace boresight
