// The perturbation rung's right-hand side and its exact derivatives, one sample a lane. The equations are those of
// offset_dynamics.hpp; the derivatives of the contact laws come from Dual numbers over the handful of numbers that a journal's
// motion has, and are led back to the coordinates by the chain rule.
//
// Across a step the scene's numbers are straight lines, row + share * change.
#pragma once

#include "boresight/lanes/lane_batch.hpp"
#include "boresight/lanes/lane_laws.hpp"
#include "boresight/lanes/lane_numbers.hpp"
#include "boresight/math/dual.hpp"
#include "boresight/math/lanes.hpp"
#include "boresight/rungs/offset_dynamics.hpp"

namespace boresight {

// N: number of coordinates, 0 if known only when running.
template <typename T, int N>
class LaneDynamics {
 public:
  LaneDynamics(const SceneLayout& layout, const JournalInSleeve* first_sample) : at(layout) {
    for (std::size_t c = 0; c < at.joints.size(); ++c) laws.push_back(in_all_lanes<T>(first_sample[c]));
    impact_speed.resize(at.joints.size());
    for (auto& speeds : impact_speed) speeds.fill(T(1e-3));
    shape(force_, count());
    shape(force_change_, count());
    shape(gradient_z_, count() * count());
    shape(gradient_v_, count() * count());
  }

  int count() const { return N > 0 ? N : at.n; }

  [[gnu::flatten]] void acceleration(const T* row, const T* z, const T* v, T* a) {
    const int n = count();
    for (int i = 0; i < n; ++i) force_[i] = T(0.0);
    for (std::size_t c = 0; c < laws.size(); ++c) {
      const JournalMotion<T> motion = journal_motion(at, at.joints[c], row, z, v);
      JournalLoad<T> wrench;
      laws[c].wrench(motion, impact_speed[c], wrench);
      add_generalised_force(at, at.joints[c], row, motion, wrench, force_.data());
    }
    coordinate_acceleration(at, row, z, v, force_.data(), a);
  }

  // a, its derivatives by z and v (n x n, row by row), and by time at the rate `change` of the row.
  void linearise(const T* row, const T* change, const T* z, const T* v, T* a, T* a_z, T* a_v, T* a_t) {
    const int n = count();
    for (int i = 0; i < n; ++i) force_[i] = force_change_[i] = T(0.0);
    for (int i = 0; i < n * n; ++i) gradient_z_[i] = gradient_v_[i] = T(0.0);
    for (std::size_t c = 0; c < laws.size(); ++c) {
      if (at.joints[c].tilts)
        add_joint<13>(c, row, change, z, v);
      else
        add_joint<7>(c, row, change, z, v);
    }
    coordinate_acceleration(at, row, z, v, force_.data(), a);
    coordinate_acceleration(at, change, z, v, force_.data(), a_t);
    for (int i = 0; i < n; ++i) {
      for (int k = 0; k < n; ++k) a_t[i] += row[at.A + i * n + k] * force_change_[k];
      for (int j = 0; j < n; ++j) {
        T by_z(0.0), by_v = -row[at.AC + i * n + j];
        if (at.stiff) by_z = -row[at.AK + i * n + j];
        for (int k = 0; k < n; ++k) {
          by_z += row[at.A + i * n + k] * gradient_z_[k * n + j];
          by_v += row[at.A + i * n + k] * gradient_v_[k * n + j];
        }
        a_z[i * n + j] = by_z;
        a_v[i * n + j] = by_v;
      }
    }
  }

  // Gaps and their rates, of every place of every joint.
  void contacts(const T* row, const T* z, const T* v, std::array<ContactState<T>, kContactPlaces>* out) const {
    for (std::size_t c = 0; c < laws.size(); ++c) laws[c].gaps(journal_motion(at, at.joints[c], row, z, v), out[c]);
  }

  const SceneLayout& at;
  std::vector<JournalInSleeveT<T>> laws;
  std::vector<std::array<T, kContactPlaces>> impact_speed;

 private:
  // K numbers of a joint's motion: offsets, their rates, spins.
  template <int K>
  [[gnu::flatten]] void add_joint(std::size_t c, const T* row, const T* change, const T* z, const T* v) {
    using D = Dual<T, K>;
    constexpr bool tilts = K == 13;
    constexpr int offsets = tilts ? 5 : 3, spins = tilts ? 3 : 1;
    const SceneLayout::Joint& joint = at.joints[c];
    const int n = count();
    const JournalMotion<T> m = journal_motion(at, joint, row, z, v);

    JournalMotion<D> motion;
    for (int k = 0; k < 3; ++k) {
      motion.e[k] = D(m.e[k], k);
      motion.e_dot[k] = D(m.e_dot[k], offsets + k);
      motion.w[k] = D(0.0);
    }
    if constexpr (tilts)
      for (int k = 0; k < 2; ++k) {
        motion.slope[k] = D(m.slope[k], 3 + k);
        motion.slope_rate[k] = D(m.slope_rate[k], offsets + 3 + k);
      }
    for (int k = 0; k < spins; ++k) motion.w[tilts ? k : 1] = D(m.w[tilts ? k : 1], 2 * offsets + k);
    JournalLoad<D> wrench;
    laws[c].wrench(motion, impact_speed[c], wrench);

    // The wrench as the coordinates see it: its force, and its moment about the journal's centre.
    const auto moment = [&](int i) {
      const int j = (i + 1) % 3, k = (i + 2) % 3;
      return wrench.moment[i] - (motion.e[j] * wrench.force[k] - motion.e[k] * wrench.force[j]);
    };
    const auto into_force = [&](int j, const D& part) {
      force_[j] += part.a;
      add_gradient<offsets, spins>(joint, row, j, part);
    };
    for (int k = 0; k < 3; ++k) {
      const int source = joint.source[k];
      if (source >= 0) {
        into_force(source, wrench.force[k]);
        force_change_[source] += rate_of<offsets, spins>(joint, change, z, v, wrench.force[k]);
      } else {
        const int first = source == DeviationCoordinates::kDependent ? joint.dependent + k * n : joint.slide_gain;
        for (int j = 0; j < n; ++j) {
          into_force(j, row[first + j] * wrench.force[k]);
          force_change_[j] += row[first + j] * rate_of<offsets, spins>(joint, change, z, v, wrench.force[k]) +
                              change[first + j] * wrench.force[k].a;
        }
      }
    }
    for (int i = 0; i < spins; ++i) {
      const D part = moment(tilts ? i : 1);
      const T rate = rate_of<offsets, spins>(joint, change, z, v, part);
      for (int j = 0; j < n; ++j) {
        const int gain = joint.spin_gain + i * n + j;
        into_force(j, row[gain] * part);
        force_change_[j] += row[gain] * rate + change[gain] * part.a;
      }
    }
  }

  // Of the j-th generalised force, to which `part` is added.
  template <int offsets, int spins, typename D>
  void add_gradient(const SceneLayout::Joint& joint, const T* row, int j, const D& part) {
    const int n = count();
    T *by_z = &gradient_z_[j * n], *by_v = &gradient_v_[j * n];
    for (int k = 0; k < offsets; ++k) {
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
      }
    }
    for (int s = 0; s < spins; ++s) {
      const T& d = part.v[2 * offsets + s];
      for (int i = 0; i < n; ++i) by_v[i] += d * row[joint.spin_gain + s * n + i];
    }
  }

  // Rate of change of `part` with the scene alone: z and v held.
  template <int offsets, int spins, typename D>
  T rate_of(const SceneLayout::Joint& joint, const T* change, const T* z, const T* v, const D& part) const {
    const int n = count();
    T rate(0.0);
    for (int k = 0; k < offsets; ++k) {
      const int source = joint.source[k];
      if (source >= 0) continue;
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
      }
      rate += part.v[k] * by_offset + part.v[offsets + k] * by_rate;
    }
    for (int s = 0; s < spins; ++s) {
      T spin = change[joint.spin + s];
      for (int i = 0; i < n; ++i) spin += change[joint.spin_gain + s * n + i] * v[i];
      rate += part.v[2 * offsets + s] * spin;
    }
    return rate;
  }

  LaneNumbers<T, N> force_, force_change_;
  LaneNumbers<T, N * N> gradient_z_, gradient_v_;
};

}  // namespace boresight
