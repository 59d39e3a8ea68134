// The perturbation rung's right-hand side and its exact derivatives, one sample a lane, where all of the layout is known when
// compiling: loops unroll and numbers stay in registers. The equations are those of offset_dynamics.hpp; the derivatives of the
// contact laws come from Dual numbers over the seven numbers that a parallel journal's motion has, and are led back to the
// coordinates by the chain rule. Any other mechanism: lane_forces.hpp.
//
// Across a step the scene's numbers are straight lines, row + share * change.
#pragma once

#include "boresight/lanes/lane_layouts.hpp"
#include "boresight/lanes/lane_numbers.hpp"
#include "boresight/lanes/lane_play.hpp"

namespace boresight {

// Layout: of journals that keep parallel and whose offsets are all coordinates.
template <typename T, typename Layout>
class LaneDynamics : public LanePlay<T, Layout> {
  using Base = LanePlay<T, Layout>;
  using Base::load_of;

 public:
  static constexpr int N = Layout::kCount;
  using Base::at;
  using Base::Base;

  BORESIGHT_FLATTEN void acceleration(const T* row, const T* z, const T* v, T* a) {
    LaneVector<T, N> force;
    for (int i = 0; i < N; ++i) force[i] = T(0.0);
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
    Load of;
    for (int i = 0; i < N; ++i) of.force[i] = of.change[i] = T(0.0);
    for (int i = 0; i < N * N; ++i) of.by_z[i] = of.by_v[i] = T(0.0);
    for (std::size_t c = 0; c < at.joints.size(); ++c) add_joint(c, row, change, z, v, of);
    coordinate_acceleration(at, row, z, v, of.force.data(), a);
    coordinate_acceleration(at, change, z, v, of.force.data(), a_t);
    each_index<N>(N, [&](auto i) {
      each_index<N>(N, [&](auto k) { a_t[i] = fused(row[at.inverse_mass(i, k)], of.change[k], a_t[i]); });
      each_index<N>(N, [&](auto j) {
        T by_z(0.0), by_v = -row[at.AC + i * N + j];
        each_index<N>(N, [&](auto k) {
          by_z = fused(row[at.inverse_mass(i, k)], of.by_z[k * N + j], by_z);
          by_v = fused(row[at.inverse_mass(i, k)], of.by_v[k * N + j], by_v);
        });
        a_z[i * N + j] = by_z;
        a_v[i * N + j] = by_v;
      });
    });
  }

 private:
  static constexpr int kOffsets = Base::offsets_of(false), kSpin = 2 * kOffsets;

  // The generalised force, its derivatives by z and v, and its rate of change with the scene alone.
  struct Load {
    LaneVector<T, N> force, change;
    LaneMatrix<T, N> by_z, by_v;
  };

  BORESIGHT_FLATTEN void add_joint(std::size_t c, const T* row, const T* change, const T* z, const T* v,
                                   Load& of) const {
    using D = Dual<T, Base::numbers_of(false)>;
    const auto& joint = at.joints[c];
    const PlayMotion<D> motion = Base::template varied<false>(play_motion(at, joint, row, z, v));
    PlayLoad<D> wrench;
    load_of(c, motion, wrench);
    // With z and v held the scene changes the spin alone.
    T spin_change = change[joint.spin];
    each_index<N>(N, [&](auto i) { spin_change = fused(change[joint.spin_gain + i], v[i], spin_change); });

    const auto into_force = [&](int j, const D& part) {
      of.force[j] += part.a;
      add_gradient(joint, row, part, &of.by_z[j * N], &of.by_v[j * N]);
    };
    each_index<3>(3, [&](auto k) {
      into_force(joint.source[k], wrench.force[k]);
      of.change[joint.source[k]] += wrench.force[k].v[kSpin] * spin_change;
    });
    const D moment = moment_about_insert(motion, wrench, 1);
    const T rate = moment.v[kSpin] * spin_change;
    each_index<N>(N, [&](auto j) {
      const int gain = joint.spin_gain + j;
      into_force(j, row[gain] * moment);
      of.change[j] = fused(row[gain], rate, fused(change[gain], moment.a, of.change[j]));
    });
  }

  // Of a generalised force, to which `part` is added.
  template <typename Joint, typename D>
  void add_gradient(const Joint& joint, const T* row, const D& part, T* by_z, T* by_v) const {
    each_index<kOffsets>(kOffsets, [&](auto k) {
      by_z[joint.source[k]] += part.v[k];
      by_v[joint.source[k]] += part.v[kOffsets + k];
    });
    each_index<N>(N, [&](auto i) { by_v[i] = fused(part.v[kSpin], row[joint.spin_gain + i], by_v[i]); });
  }
};

}  // namespace boresight
