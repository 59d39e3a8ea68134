// How the numbers of a joint's motion follow the coordinates and their rates: what play_motion() (offset_dynamics.hpp) computes, without its
// constants.
#pragma once

#include "boresight/play/play_motion.hpp"
#include "boresight/scene/scene_layout.hpp"

namespace boresight {

// scene: one row of its table. gain: kMotionNumbers x 2n, of the coordinates and then of their rates.
inline void motion_gain(const SceneLayout& at, const SceneLayout::Joint& joint, const double* scene, MatX& gain) {
  const int n = at.n;
  gain.setZero();
  for (int k = 0; k < joint.offsets; ++k) {
    const int source = joint.source[k];
    if (k == 5) {  // a roll, whose rate is none of the numbers
      if (source >= 0)
        gain(13, source) = 1.0;
      else
        for (int j = 0; j < n; ++j) gain(13, j) = scene[joint.dependent + k * n + j];
      continue;
    }
    const int value = k < 3 ? k : 6 + k, rate = k < 3 ? 3 + k : 8 + k;
    if (source >= 0) {
      gain(value, source) = gain(rate, n + source) = 1.0;
    } else if (source == DeviationCoordinates::kDependent) {
      const double *B = scene + joint.dependent + k * n, *B_rate = B + joint.offsets * n;
      for (int j = 0; j < n; ++j) {
        gain(value, j) = gain(rate, n + j) = B[j];
        gain(rate, j) = B_rate[j];
      }
    } else {
      const int slide = slide_number(k) * n;
      for (int j = 0; j < n; ++j) gain(value, j) = gain(rate, n + j) = scene[joint.slide_gain + slide + j];
      for (int j = 0; joint.gains_move && j < n; ++j) gain(rate, j) = scene[joint.slide_drift + slide + j];
    }
  }
  for (int j = 0; joint.twists && j < n; ++j) {
    const double turn = scene[joint.spin_gain + (joint.spins == 3 ? 1 : 0) * n + j];
    gain(14, j) = -scene[joint.twist + 1] * turn;
    gain(15, j) = scene[joint.twist] * turn;
  }
  for (int i = 0; i < joint.spins; ++i)
    for (int j = 0; j < n; ++j) {
      const int spin = 6 + (joint.spins == 3 ? i : 1);
      gain(spin, n + j) = scene[joint.spin_gain + i * n + j];
      if (joint.gains_move) gain(spin, j) = scene[joint.spin_drift + i * n + j];
    }
}

}  // namespace boresight
