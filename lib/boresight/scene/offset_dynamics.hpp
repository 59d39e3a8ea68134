// The right-hand side of the perturbation rung: zddot = A (r + f_contact) - A C zdot - A K z, one template for every scalar.
//
// T is the scalar of the coordinates and of the numbers that a sample varies; S that of the scene's functions of time: plain
// doubles where all samples share them, lanes where each sample is at its own time. State: z (n), then zdot (n).
#pragma once

#include "boresight/math/scalar.hpp"
#include "boresight/play/play_motion.hpp"
#include "boresight/scene/scene_layout.hpp"

namespace boresight {

// How a journal moves, from the coordinates and the scene (one row of its table) at that time.
template <typename Layout, typename Joint, typename T, typename S>
PlayMotion<T> play_motion(const Layout& at, const Joint& joint, const S* scene, const T* z, const T* rate) {
  std::array<T, kMostOffsets> offset, offset_rate;
  for (int k = 0; k < joint.offsets; ++k) {
    const int source = joint.source[k];
    if (source >= 0) {
      offset[k] = z[source];
      offset_rate[k] = rate[source];
    } else if (source == DeviationCoordinates::kDependent) {
      const S *B = scene + joint.dependent + k * at.n, *B_rate = B + joint.offsets * at.n;
      offset[k] = T(scene[joint.shift + k]);
      offset_rate[k] = T(scene[joint.shift + joint.offsets + k]);
      for (int j = 0; j < at.n; ++j) {
        offset[k] += T(B[j]) * z[j];
        offset_rate[k] += T(B[j]) * rate[j] + T(B_rate[j]) * z[j];
      }
    } else {
      const int slide = slide_number(k);
      const S *gain = scene + joint.slide_gain + slide * at.n, *drift = scene + joint.slide_drift + slide * at.n;
      offset[k] = T(scene[joint.slide + 2 * slide]);
      offset_rate[k] = T(scene[joint.slide + 2 * slide + 1]);
      for (int j = 0; j < at.n; ++j) {
        offset[k] += T(gain[j]) * z[j];
        offset_rate[k] += T(gain[j]) * rate[j];
      }
      if (joint.gains_move)
        for (int j = 0; j < at.n; ++j) offset_rate[k] += T(drift[j]) * z[j];
    }
  }
  PlayMotion<T> m;
  for (int i = 0; i < 3; ++i) {
    m.e[i] = offset[i];
    m.e_dot[i] = offset_rate[i];
  }
  if (joint.tilts)
    for (int i = 0; i < 2; ++i) {
      m.slope[i] = offset[3 + i];
      m.slope_rate[i] = offset_rate[3 + i];
    }
  if (joint.rolls) m.roll = offset[5];
  if (joint.twists) {
    // Of what the coordinates add, the first order: a turn about the axis as its rate is a spin about it.
    const int about_axis = joint.spins == 3 ? 1 : 0;
    const T by = sum_of_products(at.n, scene + joint.spin_gain + about_axis * at.n, z);
    m.twist[0] = T(scene[joint.twist]) - T(scene[joint.twist + 1]) * by;
    m.twist[1] = T(scene[joint.twist + 1]) + T(scene[joint.twist]) * by;
  }
  m.w[0] = m.w[2] = T(0.0);
  for (int i = 0; i < joint.spins; ++i) {
    T spin = sum_of_products(at.n, scene + joint.spin_gain + i * at.n, rate, T(scene[joint.spin + i]));
    if (joint.gains_move) spin = sum_of_products(at.n, scene + joint.spin_drift + i * at.n, z, spin);
    m.w[joint.spins == 3 ? i : 1] = spin;
  }
  return m;
}

// Of a wrench's moment about the insert's centre, what works on the relative spin: the i-th component in the seat's axes ...
template <typename T>
T moment_about_insert(const PlayMotion<T>& m, const PlayLoad<T>& wrench, int i) {
  const int j = (i + 1) % 3, k = (i + 2) % 3;
  return wrench.moment[i] - (m.e[j] * wrench.force[k] - m.e[k] * wrench.force[j]);
}
// ... and of a tilted insert, in the place of that along the seat's axis, what turns it about its own: what couples_of() finds on the roll, to
// first order in the slopes. Couples on slopes alone leave a journal's turn alone, although their moment has a part along the seat's axis.
template <typename T>
T moment_along_insert(const PlayMotion<T>& m, const PlayLoad<T>& wrench) {
  return moment_about_insert(m, wrench, 1) + m.slope[0] * moment_about_insert(m, wrench, 0) +
         m.slope[1] * moment_about_insert(m, wrench, 2);
}

// Adds a joint's wrench to the generalised force (n numbers).
template <typename Layout, typename Joint, typename T, typename S>
void add_generalised_force(const Layout& at, const Joint& joint, const S* scene, const PlayMotion<T>& motion,
                           const PlayLoad<T>& wrench, T* force) {
  for (int k = 0; k < 3; ++k) {
    const int source = joint.source[k];
    if (source >= 0) {
      force[source] += wrench.force[k];
    } else {
      const S* gain = scene + (source == DeviationCoordinates::kDependent ? joint.dependent + k * at.n
                                                                          : joint.slide_gain + slide_number(k) * at.n);
      for (int j = 0; j < at.n; ++j) force[j] += T(gain[j]) * wrench.force[k];
    }
  }
  // The moment about the journal's centre works on the relative spin.
  for (int i = 0; i < joint.spins; ++i) {
    const S* gain = scene + joint.spin_gain + i * at.n;
    const int axis = joint.spins == 3 ? i : 1;
    const T m =
        joint.tilts && axis == 1 ? moment_along_insert(motion, wrench) : moment_about_insert(motion, wrench, axis);
    for (int j = 0; j < at.n; ++j) force[j] = fused(T(gain[j]), m, force[j]);
  }
}

// zddot from the generalised contact force.
template <typename Layout, typename T, typename S>
void coordinate_acceleration(const Layout& at, const S* scene, const T* z, const T* rate, const T* force,
                             T* acceleration) {
  for (int i = 0; i < at.n; ++i) {
    T sum(scene[at.Ar + i]);
    const S* AC = scene + at.AC + i * at.n;
    for (int j = 0; j < at.n; ++j)
      sum = fused(T(scene[at.inverse_mass(i, j)]), force[j], fused(T(-AC[j]), rate[j], sum));
    if (at.stiff) {
      const S* AK = scene + at.AK + i * at.n;
      for (int j = 0; j < at.n; ++j) sum = fused(T(-AK[j]), z[j], sum);
    }
    acceleration[i] = sum;
  }
}

}  // namespace boresight
