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

template <int W, typename Target, int distance = W / 2>
inline void turn_over(Lanes<W, Target>* block) {
  if constexpr (W > 1 && distance > 0) {
    typename Register<W>::Integers lower{}, upper{};
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
    turn_over<W, Target, distance / 2>(block);
  }
}

// scenes: per lane. out: `width` numbers, a multiple of W. A lane without a scene is left as it was given by the lane before it.
template <int W, typename Target>
void scene_rows(const LaneScene* const* scenes, const Lanes<W, Target>& t, int width, Lanes<W, Target>* out) {
  using Vector = typename Register<W>::Doubles;
  const double* cell[W];
  double share[W];
  for (int l = 0; l < W; ++l) {
    const LaneScene& scene = *scenes[l];
    const double x = t.lane(l) / scene.spacing;
    const int k = std::clamp(static_cast<int>(x), 0, scene.cells - 1);
    share[l] = x - k;
    cell[l] = scene.coefficients + static_cast<std::size_t>(k) * 4 * width;
  }
  const auto load = [](const double* from) {
    Vector v;
    __builtin_memcpy(&v, from, sizeof v);
    return v;
  };
  for (int first = 0; first < width; first += W) {
    for (int l = 0; l < W; ++l) {
      const double *c0 = cell[l] + first, *c1 = c0 + width, *c2 = c1 + width, *c3 = c2 + width;
      out[first + l].v = load(c0) + share[l] * (load(c1) + share[l] * (load(c2) + share[l] * load(c3)));
    }
    turn_over<W, Target>(out + first);
  }
}

}  // namespace boresight
