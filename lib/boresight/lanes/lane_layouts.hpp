// SceneLayout as the lanes see it: with all of it known when compiling, so that loops unroll and numbers stay in registers, or
// for any mechanism. Both have the same shape as SceneLayout; offset_dynamics.hpp takes either.
#pragma once

#include <array>

#include "boresight/scene/scene_layout.hpp"

namespace boresight {

struct AnyLayout : SceneLayout {
  static constexpr bool kParallel = false;  // whether it is known that no journal tilts
  explicit AnyLayout(const SceneLayout& layout) : SceneLayout(layout) {}
};

// One revolute whose journal keeps parallel, its three offsets the only coordinates, and no springs.
struct SingleRevoluteLayout {
  static constexpr int kCount = 3;
  static constexpr bool kParallel = true;
  struct Joint {
    static constexpr bool tilts = false, rolls = false, twists = false, slides = false, gains_move = false;
    static constexpr int offsets = 3, spins = 1, spin = 18, spin_gain = 19, spin_drift = 22, slide = 22,
                         slide_gain = 22, slide_drift = 22, twist = 22, dependent = 22, shift = 22;
    static constexpr std::array<int, 3> source = {0, 1, 2};
  };
  static constexpr int n = 3;
  static constexpr bool stiff = false;
  static constexpr int A = 0, Ar = 6, AC = 9, AK = 18, width = 22;
  static constexpr std::array<Joint, 1> joints = {};

  static constexpr int inverse_mass(int i, int j) { return A + upper_triangle(n, i, j); }

  explicit SingleRevoluteLayout(const SceneLayout&) {}
  static bool describes(const SceneLayout& at) {
    if (at.n != n || at.joints.size() != 1) return false;
    const SceneLayout::Joint& j = at.joints.front();
    return !at.stiff && !j.tilts && !j.twists && !j.slides && !j.has_dependent && !j.gains_move && j.source[0] == 0 &&
           j.source[1] == 1 && j.source[2] == 2 && at.A == A && at.Ar == Ar && at.AC == AC && j.spin == Joint::spin &&
           j.spin_gain == Joint::spin_gain && at.width == width;
  }
};

}  // namespace boresight
