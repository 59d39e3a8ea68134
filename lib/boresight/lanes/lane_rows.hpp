// One row of the scene's numbers for every lane at the lane's own time, from the lanes' own tables.
//
// Each lane's cubics lie side by side and are evaluated along the row; blocks of W rows are then turned over, so that each
// number has its lanes in one register: about 1 load, 3 multiply-adds and 3 shuffles a number and lane.
// Turning over: Eklundh (1972), A fast computer method for matrix transposing, IEEE Transactions on Computers 21, 801-803.
#pragma once

#include <algorithm>

#include "boresight/lanes/lane_batch.hpp"
#include "boresight/math/lanes.hpp"

namespace boresight {

template <int W, typename Target, typename Real, int distance = W / 2>
inline void transpose_lanes(Lanes<W, Target, Real>* block) {
  if constexpr (W > 1 && distance > 0) {
    typename Register<W, Real>::Integers lower{}, upper{};
    for (int p = 0; p < W; ++p) {
      lower[p] = (p & distance) == 0 ? p : W + p - distance;
      upper[p] = (p & distance) == 0 ? p + distance : W + p;
    }
    for (int i = 0; i < W; ++i) {
      if (i & distance) continue;
      const auto a = block[i].v, b = block[i + distance].v;
      block[i].v = __builtin_shuffle(a, b, lower);
      block[i + distance].v = __builtin_shuffle(a, b, upper);
    }
    transpose_lanes<W, Target, Real, distance / 2>(block);
  }
}

// scenes, t: per lane. out: `width` numbers, a multiple of W. A lane without a scene is left as it was given by the lane before
// it.
template <int W, typename Target, typename Real>
void scene_rows(const LaneScene* const* scenes, const double* t, int width, Lanes<W, Target, Real>* out) {
  using T = Lanes<W, Target, Real>;
  const Real* cell[W];
  Real share[W];
  for (int l = 0; l < W; ++l) {
    const LaneScene& scene = *scenes[l];
    const double x = t[l] * scene.per_spacing;
    const int k = std::clamp(static_cast<int>(x), 0, scene.cells - 1);
    share[l] = static_cast<Real>(x - k);
    cell[l] = scene.coefficients<Real>() + static_cast<std::size_t>(k) * 4 * width;
  }
  const auto load = [](const Real* from) {
    T numbers;
    __builtin_memcpy(&numbers.v, from, sizeof numbers.v);
    return numbers;
  };
  for (int first = 0; first < width; first += W) {
    for (int l = 0; l < W; ++l) {
      const Real *c0 = cell[l] + first, *c1 = c0 + width, *c2 = c1 + width, *c3 = c2 + width;
      const T s(share[l]);
      out[first + l] = fused(s, fused(s, fused(s, load(c3), load(c2)), load(c1)), load(c0));
    }
    transpose_lanes(out + first);
  }
}

}  // namespace boresight
