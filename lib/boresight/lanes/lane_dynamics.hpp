// The perturbation rung's right-hand side and its exact derivatives, one sample a lane. The equations are those of
// offset_dynamics.hpp; the derivatives of the contact laws come from Dual numbers over the handful of numbers that a journal's
// motion has, and are led back to the coordinates by the chain rule.
//
// Across a step the scene's numbers are straight lines, row + share * change.
#pragma once

#include "boresight/lanes/lane_batch.hpp"
#include "boresight/lanes/lane_laws.hpp"
#include "boresight/lanes/lane_layouts.hpp"
#include "boresight/lanes/lane_numbers.hpp"
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
class LaneDynamics {
 public:
  static constexpr int N = Layout::kCount;

  LaneDynamics(const SceneLayout& layout, const JointPlay* first_sample) : at(layout) {
    for (std::size_t c = 0; c < at.joints.size(); ++c) laws.push_back(in_all_lanes<T>(journal_of(first_sample[c])));
    acting = laws;
    impact_speed.resize(at.joints.size());
    for (auto& speeds : impact_speed) speeds.fill(T(1e-3));
  }

  int count() const { return N > 0 ? N : at.n; }

  BORESIGHT_FLATTEN void acceleration(const T* row, const T* z, const T* v, T* a) {
    LaneVector<T, N> force;
    for (int i = 0; i < count(); ++i) force[i] = T(0.0);
    for (std::size_t c = 0; c < at.joints.size(); ++c) {
      const PlayMotion<T> motion = play_motion(at, at.joints[c], row, z, v);
      PlayLoad<T> load;
      load_of(c, motion, load);
      add_generalised_force(at, at.joints[c], row, motion, load, force.data());
    }
    coordinate_acceleration(at, row, z, v, force.data(), a);
  }

  // a, its derivatives by z and v (n x n, row by row), and by time at the rate `change` of the row.
  BORESIGHT_FLATTEN void linearise(const T* row, const T* change, const T* z, const T* v, T* a, T* a_z, T* a_v,
                                   T* a_t) {
    const int n = count();
    Load of;
    for (int i = 0; i < n; ++i) of.force[i] = of.change[i] = T(0.0);
    for (int i = 0; i < n * n; ++i) of.by_z[i] = of.by_v[i] = T(0.0);
    for (std::size_t c = 0; c < at.joints.size(); ++c) {
      if constexpr (Layout::kParallel)
        add_joint<7>(c, row, change, z, v, of);
      else if (at.joints[c].tilts)
        add_joint<13>(c, row, change, z, v, of);
      else
        add_joint<7>(c, row, change, z, v, of);
    }
    coordinate_acceleration(at, row, z, v, of.force.data(), a);
    coordinate_acceleration(at, change, z, v, of.force.data(), a_t);
    each_index<N>(n, [&](auto i) {
      each_index<N>(n, [&](auto k) { a_t[i] = fused(row[at.inverse_mass(i, k)], of.change[k], a_t[i]); });
      each_index<N>(n, [&](auto j) {
        T by_z(0.0), by_v = -row[at.AC + i * n + j];
        if (at.stiff) by_z = -row[at.AK + i * n + j];
        each_index<N>(n, [&](auto k) {
          by_z = fused(row[at.inverse_mass(i, k)], of.by_z[k * n + j], by_z);
          by_v = fused(row[at.inverse_mass(i, k)], of.by_v[k * n + j], by_v);
        });
        a_z[i * n + j] = by_z;
        a_v[i * n + j] = by_v;
      });
    });
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

 private:
  // The generalised force, its derivatives by z and v, and its rate of change with the scene alone.
  struct Load {
    LaneVector<T, N> force, change;
    LaneMatrix<T, N> by_z, by_v;
  };

  template <typename M>
  void load_of(std::size_t c, const PlayMotion<M>& motion, PlayLoad<M>& load) const {
    if constexpr (Layout::kParallel)
      acting[c].parallel_wrench(motion, impact_speed[c], SlidingFriction<T>{acting[c].friction}, load);
    else
      acting[c].wrench(motion, impact_speed[c], load);
  }

  // K numbers of a joint's motion: offsets, their rates, spins.
  template <int K>
  BORESIGHT_FLATTEN void add_joint(std::size_t c, const T* row, const T* change, const T* z, const T* v,
                                   Load& of) const {
    using D = Dual<T, K>;
    constexpr bool tilts = K == 13;
    constexpr int offsets = tilts ? 5 : 3, spins = tilts ? 3 : 1;
    const auto& joint = at.joints[c];
    const int n = count();
    const PlayMotion<T> m = play_motion(at, joint, row, z, v);

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
    each_index<spins>(spins, [&](auto k) { motion.w[tilts ? k : 1] = D(m.w[tilts ? k : 1], 2 * offsets + k); });
    PlayLoad<D> wrench;
    load_of(c, motion, wrench);

    // The wrench as the coordinates see it: its force, and its moment about the journal's centre.
    const auto moment = [&](int i) {
      const int j = (i + 1) % 3, k = (i + 2) % 3;
      return wrench.moment[i] - (motion.e[j] * wrench.force[k] - motion.e[k] * wrench.force[j]);
    };
    const auto into_force = [&](int j, const D& part) {
      of.force[j] += part.a;
      add_gradient<offsets, spins>(joint, row, part, &of.by_z[j * n], &of.by_v[j * n]);
    };
    each_index<3>(3, [&](auto k) {
      const int source = joint.source[k];
      if (source >= 0) {
        into_force(source, wrench.force[k]);
        of.change[source] += rate_of<offsets, spins>(joint, change, z, v, wrench.force[k]);
      } else {
        const int first = source == DeviationCoordinates::kDependent ? joint.dependent + k * n : joint.slide_gain;
        for (int j = 0; j < n; ++j) {
          into_force(j, row[first + j] * wrench.force[k]);
          of.change[j] += row[first + j] * rate_of<offsets, spins>(joint, change, z, v, wrench.force[k]) +
                          change[first + j] * wrench.force[k].a;
        }
      }
    });
    each_index<spins>(spins, [&](auto i) {
      const D part = moment(tilts ? i : 1);
      const T rate = rate_of<offsets, spins>(joint, change, z, v, part);
      each_index<N>(n, [&](auto j) {
        const int gain = joint.spin_gain + i * n + j;
        into_force(j, row[gain] * part);
        of.change[j] = fused(row[gain], rate, fused(change[gain], part.a, of.change[j]));
      });
    });
  }

  // Of a generalised force, to which `part` is added.
  template <int offsets, int spins, typename Joint, typename D>
  void add_gradient(const Joint& joint, const T* row, const D& part, T* by_z, T* by_v) const {
    const int n = count();
    each_index<offsets>(offsets, [&](auto k) {
      const int source = joint.source[k];
      const T &d = part.v[k], &d_rate = part.v[offsets + k];
      if (source >= 0) {
        by_z[source] += d;
        by_v[source] += d_rate;
      } else if (source == DeviationCoordinates::kDependent) {
        const T *B = row + joint.dependent + k * n, *B_rate = B + joint.offsets * n;
        for (int i = 0; i < n; ++i) {
          by_z[i] += d * B[i] + d_rate * B_rate[i];
          by_v[i] += d_rate * B[i];
        }
      } else {
        for (int i = 0; i < n; ++i) by_v[i] += d_rate * row[joint.slide_gain + i];
        if (joint.gains_move)
          for (int i = 0; i < n; ++i) by_z[i] += d_rate * row[joint.slide_drift + i];
      }
    });
    each_index<spins>(spins, [&](auto s) {
      const T& d = part.v[2 * offsets + s];
      each_index<N>(n, [&](auto i) { by_v[i] = fused(d, row[joint.spin_gain + s * n + i], by_v[i]); });
      if (joint.gains_move)
        for (int i = 0; i < n; ++i) by_z[i] += d * row[joint.spin_drift + s * n + i];
    });
  }

  // Rate of change of `part` with the scene alone: z and v held.
  template <int offsets, int spins, typename Joint, typename D>
  T rate_of(const Joint& joint, const T* change, const T* z, const T* v, const D& part) const {
    const int n = count();
    T rate(0.0);
    each_index<offsets>(offsets, [&](auto k) {
      const int source = joint.source[k];
      if (source >= 0) return;
      T by_offset(0.0), by_rate(0.0);
      if (source == DeviationCoordinates::kDependent) {
        const T *B = change + joint.dependent + k * n, *B_rate = B + joint.offsets * n;
        for (int i = 0; i < n; ++i) {
          by_offset += B[i] * z[i];
          by_rate += B[i] * v[i] + B_rate[i] * z[i];
        }
      } else {
        by_offset = change[joint.slide];
        by_rate = change[joint.slide + 1];
        for (int i = 0; i < n; ++i) by_rate += change[joint.slide_gain + i] * v[i];
        if (joint.gains_move)
          for (int i = 0; i < n; ++i) by_rate += change[joint.slide_drift + i] * z[i];
      }
      rate += part.v[k] * by_offset + part.v[offsets + k] * by_rate;
    });
    each_index<spins>(spins, [&](auto s) {
      T spin = change[joint.spin + s];
      each_index<N>(n, [&](auto i) { spin = fused(change[joint.spin_gain + s * n + i], v[i], spin); });
      if (joint.gains_move)
        for (int i = 0; i < n; ++i) spin += change[joint.spin_drift + s * n + i] * z[i];
      rate += part.v[2 * offsets + s] * spin;
    });
    return rate;
  }
};

}  // namespace boresight
