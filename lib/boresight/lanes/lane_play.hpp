// The joints' play in lanes: laws with another sample's numbers in every lane, which of them act in the step at hand, the impact
// speeds that they remember, and their motions with derivatives.
#pragma once

#include "boresight/lanes/lane_batch.hpp"
#include "boresight/lanes/lane_laws.hpp"
#include "boresight/math/dual.hpp"
#include "boresight/math/each_index.hpp"
#include "boresight/math/lanes.hpp"
#include "boresight/scene/offset_dynamics.hpp"

// What a kernel calls becomes part of it; but under the sanitisers, whose checks make functions of this size too large to compile.
#ifdef __SANITIZE_ADDRESS__
#define BORESIGHT_FLATTEN
#else
#define BORESIGHT_FLATTEN [[gnu::flatten]]
#endif

namespace boresight {

// Layout: one of lane_layouts.hpp.
template <typename T, typename Layout>
class LanePlay {
 public:
  LanePlay(const SceneLayout& layout, const JointPlay* first_sample) : at(layout) {
    for (std::size_t c = 0; c < at.joints.size(); ++c) laws.push_back(in_all_lanes<T>(journal_of(first_sample[c])));
    acting = laws;
    impact_speed.resize(at.joints.size());
    for (auto& speeds : impact_speed) speeds.fill(T(1e-3));
  }

  // Gaps and their rates, of every place of every joint.
  void contacts(const T* row, const T* z, const T* v, std::array<ContactState<T>, kContactPlaces>* out) const {
    for (std::size_t c = 0; c < at.joints.size(); ++c) {
      const PlayMotion<T> motion = play_motion(at, at.joints[c], row, z, v);
      if constexpr (Layout::kParallel)
        laws[c].parallel_penetrations(motion, out[c]);
      else
        laws[c].penetrations(motion, out[c]);
    }
  }

  const Layout at;
  std::vector<JournalInSleeveT<T>> laws;
  std::vector<JournalInSleeveT<T>>
      acting;  // in the step at hand: what is open at its start is out of reach (LaneContacts)
  std::vector<std::array<T, kContactPlaces>> impact_speed;

 protected:
  // M: T, or a Dual over it.
  template <typename M>
  void load_of(std::size_t c, const PlayMotion<M>& motion, PlayLoad<M>& load) const {
    if constexpr (Layout::kParallel)
      acting[c].parallel_wrench(motion, impact_speed[c], SlidingFriction<T>{acting[c].friction}, load);
    else
      acting[c].wrench(motion, impact_speed[c], load);
  }

  // How many numbers a joint's motion has, in the order of their derivatives: offsets, their rates, spins.
  static constexpr int offsets_of(bool tilts) { return tilts ? 5 : 3; }
  static constexpr int spins_of(bool tilts) { return tilts ? 3 : 1; }
  static constexpr int numbers_of(bool tilts) { return 2 * offsets_of(tilts) + spins_of(tilts); }

  template <bool tilts>
  static PlayMotion<Dual<T, numbers_of(tilts)>> varied(const PlayMotion<T>& m) {
    using D = Dual<T, numbers_of(tilts)>;
    constexpr int offsets = offsets_of(tilts);
    PlayMotion<D> motion;
    each_index<3>(3, [&](auto k) {
      motion.e[k] = D(m.e[k], k);
      motion.e_dot[k] = D(m.e_dot[k], offsets + k);
      motion.w[k] = D(0.0);
    });
    if constexpr (tilts)
      each_index<2>(2, [&](auto k) {
        motion.slope[k] = D(m.slope[k], 3 + k);
        motion.slope_rate[k] = D(m.slope_rate[k], offsets + 3 + k);
      });
    each_index<spins_of(tilts)>(spins_of(tilts),
                                [&](auto k) { motion.w[tilts ? k : 1] = D(m.w[tilts ? k : 1], 2 * offsets + k); });
    return motion;
  }
};

}  // namespace boresight
