// The forces on the perturbation rung's coordinates and their exact derivatives, one sample a lane, for mechanisms of any number
// of joints:
//
//   M zddot = g,    g = r + f_contact - C zdot - K z
//
// The equations are those of offset_dynamics.hpp before the mass is divided through. A contact sees few numbers of the motion:
// a joint's offsets, their rates, its spins. The derivatives of its loads by these (a 4 x 7 or 6 x 13 block of Dual numbers) are
// kept, and led to the coordinates where they are asked for; so nothing here grows faster than n^2 a joint.
#pragma once

#include "boresight/lanes/lane_layouts.hpp"
#include "boresight/lanes/lane_play.hpp"
#include "boresight/lanes/lane_window.hpp"

namespace boresight {

template <typename T>
class LaneForces : public LanePlay<T, AnyLayout> {
  using Base = LanePlay<T, AnyLayout>;
  using Joint = SceneLayout::Joint;

 public:
  using Base::acting;
  using Base::at;
  using Base::impact_speed;

  LaneForces(const SceneLayout& layout, const JointPlay* first_sample)
      : Base(layout, first_sample),
        loads_(layout.joints.size()),
        motions_(layout.joints.size()),
        wrenches_(layout.joints.size()) {
    std::size_t most = 1;
    for (const Joint& joint : layout.joints) most += 3 + joint.spins;
    along_.assign(most * layout.n, T(0.0));
    gain_of_.resize(most);
    pair_.assign(2 * most, T(0.0));
  }

  int count() const { return at.n; }

  // g at (z, v) with the scene of `row`.
  BORESIGHT_FLATTEN void force(const T* row, const T* z, const T* v, T* g) {
    between_contacts(row, z, v, g);
    // One loop after the other: a contact's chain of roots and quotients is waited for beside its neighbours', not beside sums.
    const std::size_t joints = at.joints.size();
    for (std::size_t c = 0; c < joints; ++c) motions_[c] = play_motion(at, at.joints[c], row, z, v);
    for (std::size_t c = 0; c < joints; ++c) Base::load_of(c, motions_[c], wrenches_[c]);
    for (std::size_t c = 0; c < joints; ++c) add_generalised_force(at, at.joints[c], row, motions_[c], wrenches_[c], g);
  }

  // g, its derivatives, which are kept, and its rate of change with the scene alone, at the rates `change`.
  BORESIGHT_FLATTEN void linearise(const T* row, const T* change, const T* z, const T* v, T* g, T* g_t) {
    between_contacts(row, z, v, g);
    for (int i = 0; i < at.n; ++i) g_t[i] = change[at.Ar + i];
    for (std::size_t c = 0; c < at.joints.size(); ++c) {
      if (at.joints[c].tilts)
        keep_joint<true>(c, row, change, z, v, g, g_t);
      else
        keep_joint<false>(c, row, change, z, v, g, g_t);
    }
  }

  // W = M sigma - dg/dv - inverse dg/dz at the last linearise(), n x n, row by row. sigma: per coordinate, M's columns are multiplied by it.
  BORESIGHT_FLATTEN void system(const T* row, const T* sigma, const T& inverse, T* W) {
    const int n = at.n;
    for (int k = 0; k < n * n; ++k) W[k] = T(0.0);
    dense_ = 0;
    for (std::size_t c = 0; c < at.joints.size(); ++c)
      if (loads_[c].any) add_joint(c, row, inverse, W);
    // What is dense, in one pass: two rows at a time share what they read.
    for (int i = 0; i < n; i += 2) {
      const int other = i + 1 < n ? i + 1 : i;
      T *x = W + i * n, *y = W + other * n;
      const T *C_x = row + at.AC + i * n, *C_y = row + at.AC + other * n;
      for (int d = 0; d < dense_; ++d) pair_[2 * d] = -gain_of_[d][i], pair_[2 * d + 1] = -gain_of_[d][other];
      const auto columns = [&](auto width, int j) {
        constexpr int kWidth = decltype(width)::value;
        T a[kWidth], b[kWidth];
        each_index<kWidth>(kWidth, [&](auto r) {
          a[r] = x[j + r] + fused(sigma[j + r], row[at.inverse_mass(i, j + r)], C_x[j + r]);
          b[r] = y[j + r] + fused(sigma[j + r], row[at.inverse_mass(other, j + r)], C_y[j + r]);
        });
        for (int d = 0; d < dense_; ++d) {
          const T *along = &along_[d * n + j], gain = pair_[2 * d], other_gain = pair_[2 * d + 1];
          each_index<kWidth>(kWidth, [&](auto r) {
            a[r] = fused(gain, along[r], a[r]);
            b[r] = fused(other_gain, along[r], b[r]);
          });
        }
        each_index<kWidth>(kWidth, [&](auto r) {
          x[j + r] = a[r];
          if (other != i) y[j + r] = b[r];
        });
      };
      int j = 0;
      for (; j + 4 <= n; j += 4) columns(std::integral_constant<int, 4>(), j);
      for (; j < n; ++j) columns(std::integral_constant<int, 1>(), j);
    }
    if (at.stiff)
      for (int k = 0; k < n * n; ++k) W[k] = fused(inverse, row[at.AK + k], W[k]);
  }

  // out += (dg/dz) x, at the last linearise().
  BORESIGHT_FLATTEN void add_stiffness_times(const T* row, const T* x, T* out) const {
    const int n = at.n;
    if (at.stiff) subtract_product(n, n, row + at.AK, n, x, out);
    for (std::size_t c = 0; c < at.joints.size(); ++c) {
      const JointLoads& loads = loads_[c];
      if (!loads.any) continue;
      const Joint& joint = at.joints[c];
      const int offsets = joint.offsets, count = 3 + joint.spins;
      T number[kMostNumbers];
      for (int k = 0; k < 2 * offsets + joint.spins; ++k) number[k] = T(0.0);
      for (int k = 0; k < offsets; ++k) {
        const int source = joint.source[k];
        if (source >= 0) {
          number[k] = x[source];
        } else if (source == DeviationCoordinates::kDependent) {
          const T *B = row + joint.dependent + k * n, *B_rate = B + offsets * n;
          number[k] = sum_of_products(n, B, x);
          number[offsets + k] = sum_of_products(n, B_rate, x);
        } else {
          number[k] = sum_of_products(n, row + joint.slide_gain, x);
          if (joint.gains_move) number[offsets + k] = sum_of_products(n, row + joint.slide_drift, x);
        }
      }
      for (int s = 0; joint.gains_move && s < joint.spins; ++s)
        number[2 * offsets + s] = sum_of_products(n, row + joint.spin_drift + s * n, x);
      const int seen = joint.gains_move || joint.has_dependent ? 2 * offsets + joint.spins : offsets;
      for (int l = 0; l < count; ++l) {
        T load(0.0);
        for (int k = 0; k < seen; ++k) load = fused(loads.by[l][k], number[k], load);
        add_load(joint, row, l, load, out);
      }
    }
  }

  // out = M x.
  BORESIGHT_FLATTEN void mass_times(const T* row, const T* x, T* out) const {
    const int n = at.n;
    for (int i = 0; i < n; ++i) out[i] = T(0.0);
    const T* m = row + at.A;
    for (int i = 0; i < n; ++i) {
      const T own = x[i];
      T sum[4] = {out[i] + m[0] * own, T(0.0), T(0.0), T(0.0)};
      const int length = n - i;
      int j = 1;
      for (; j + 4 <= length; j += 4)
        for (int r = 0; r < 4; ++r) {
          sum[r] = fused(m[j + r], x[i + j + r], sum[r]);
          out[i + j + r] = fused(m[j + r], own, out[i + j + r]);
        }
      for (; j < length; ++j) {
        sum[0] = fused(m[j], x[i + j], sum[0]);
        out[i + j] = fused(m[j], own, out[i + j]);
      }
      out[i] = (sum[0] + sum[1]) + (sum[2] + sum[3]);
      m += length;
    }
  }

 private:
  static constexpr int kMostLoads = 6, kMostNumbers = 13;
  // Forces along the three offsets and moments of the spins; their derivatives by offsets, rates and spins.
  struct JointLoads {
    bool any = false;  // of a lane
    T by[kMostLoads][kMostNumbers];
  };

  // r - C v - K z.
  void between_contacts(const T* row, const T* z, const T* v, T* g) const {
    const int n = at.n;
    for (int i = 0; i < n; ++i) g[i] = row[at.Ar + i];
    subtract_product(n, n, row + at.AC, n, v, g);
    if (at.stiff) subtract_product(n, n, row + at.AK, n, z, g);
  }

  // The l-th load of a joint onto the coordinates.
  void add_load(const Joint& joint, const T* row, int l, const T& load, T* out) const {
    const int n = at.n;
    const T* gain = row + joint.spin_gain + (l - 3) * n;
    if (l < 3) {
      const int source = joint.source[l];
      if (source >= 0) {
        out[source] += load;
        return;
      }
      gain = row + (source == DeviationCoordinates::kDependent ? joint.dependent + l * n : joint.slide_gain);
    }
    for (int j = 0; j < n; ++j) out[j] = fused(gain[j], load, out[j]);
  }

  template <bool tilts>
  void keep_joint(std::size_t c, const T* row, const T* change, const T* z, const T* v, T* g, T* g_t) {
    constexpr int offsets = Base::offsets_of(tilts), spins = Base::spins_of(tilts), K = Base::numbers_of(tilts),
                  L = 3 + spins;
    using D = Dual<T, K>;
    const Joint& joint = at.joints[c];
    JointLoads& loads = loads_[c];
    const int n = at.n;
    const PlayMotion<D> motion = Base::template varied<tilts>(play_motion(at, joint, row, z, v));
    PlayLoad<D> wrench;
    Base::load_of(c, motion, wrench);

    T value[L];
    auto some = T::Mask::all(false);
    const auto keep = [&](int l, const D& load) {
      value[l] = load.a;
      some = some | (abs(load.a) > T(0.0));
      each_index<K>(K, [&](auto k) {
        loads.by[l][k] = load.v[k];
        some = some | (abs(load.v[k]) > T(0.0));
      });
    };
    for (int l = 0; l < 3; ++l) keep(l, wrench.force[l]);
    for (int s = 0; s < spins; ++s)
      keep(3 + s,
           tilts && s == 1 ? moment_along_insert(motion, wrench) : moment_about_insert(motion, wrench, tilts ? s : 1));
    loads.any = any(some);
    if (!loads.any) return;

    for (int l = 0; l < L; ++l) {
      add_load(joint, row, l, value[l], g);
      add_load(joint, row, l, rate_with_scene<offsets, spins>(joint, change, z, v, loads.by[l]), g_t);
      if (l < 3 && joint.source[l] == DeviationCoordinates::kDependent)
        for (int j = 0; j < n; ++j) g_t[j] = fused(change[joint.dependent + l * n + j], value[l], g_t[j]);
    }
  }

  void add_joint(std::size_t c, const T* row, const T& inverse, T* W) {
    const Joint& joint = at.joints[c];
    const JointLoads& loads = loads_[c];
    const int n = at.n, offsets = joint.offsets, spins = joint.spins;
    for (int l = 0; l < 3 + spins; ++l) {
      // How the load follows the coordinates: n numbers, led back to them by what the load works on.
      T* along = &along_[static_cast<std::size_t>(dense_) * n];
      for (int j = 0; j < n; ++j) along[j] = T(0.0);
      for (int k = 0; k < offsets; ++k) {
        const int source = joint.source[k];
        const T by_rate = loads.by[l][offsets + k], by_both = fused(loads.by[l][k], inverse, by_rate);
        if (source >= 0) {
          along[source] += by_both;
        } else if (source == DeviationCoordinates::kDependent) {
          const T *B = row + joint.dependent + k * n, *B_rate = B + offsets * n;
          const T by_drift = by_rate * inverse;
          for (int j = 0; j < n; ++j) along[j] = fused(by_both, B[j], fused(by_drift, B_rate[j], along[j]));
        } else {
          const T by_drift = by_rate * inverse;
          for (int j = 0; j < n; ++j) along[j] = fused(by_both, row[joint.slide_gain + j], along[j]);
          for (int j = 0; joint.gains_move && j < n; ++j)
            along[j] = fused(by_drift, row[joint.slide_drift + j], along[j]);
        }
      }
      for (int s = 0; s < spins; ++s) {
        const T by_spin = loads.by[l][2 * offsets + s], by_drift = by_spin * inverse;
        for (int j = 0; j < n; ++j) along[j] = fused(by_spin, row[joint.spin_gain + s * n + j], along[j]);
        for (int j = 0; joint.gains_move && j < n; ++j)
          along[j] = fused(by_drift, row[joint.spin_drift + s * n + j], along[j]);
      }
      const T* gain = row + joint.spin_gain + (l - 3) * n;
      if (l < 3) {
        const int source = joint.source[l];
        if (source >= 0) {
          for (int j = 0; j < n; ++j) W[source * n + j] -= along[j];
          continue;
        }
        gain = row + (source == DeviationCoordinates::kDependent ? joint.dependent + l * n : joint.slide_gain);
      }
      gain_of_[dense_++] = gain;
    }
  }

  // Of a load: with the scene alone, z and v held.
  template <int offsets, int spins>
  T rate_with_scene(const Joint& joint, const T* change, const T* z, const T* v, const T* by) const {
    const int n = at.n;
    T rate(0.0);
    for (int k = 0; k < offsets; ++k) {
      const int source = joint.source[k];
      if (source >= 0) continue;
      if (source == DeviationCoordinates::kDependent) {
        const T *B = change + joint.dependent + k * n, *B_rate = B + offsets * n;
        rate = fused(by[k], sum_of_products(n, B, z), rate);
        rate = fused(by[offsets + k], sum_of_products(n, B, v) + sum_of_products(n, B_rate, z), rate);
      } else {
        const T slide = sum_of_products(n, change + joint.slide_gain, z, change[joint.slide]);
        rate = fused(by[k], slide, fused(by[offsets + k], change[joint.slide + 1], rate));
      }
    }
    for (int s = 0; s < spins; ++s) rate = fused(by[2 * offsets + s], change[joint.spin + s], rate);
    return rate;
  }

  std::vector<JointLoads> loads_;  // of the last linearise()
  std::vector<PlayMotion<T>> motions_;
  std::vector<PlayLoad<T>> wrenches_;
  int dense_ = 0;                  // loads that work on all coordinates
  std::vector<const T*> gain_of_;  // how they work on them
  std::vector<T> along_, pair_;    // how they follow them, n numbers each; two rows' gains
};

}  // namespace boresight
