// One row of the scene's numbers for every lane at the lane's own time, from the lanes' own tables.
//
// Each lane's cubics lie side by side and are evaluated along the row; blocks of W rows are then turned over, so that each
// number has its lanes in one register: about 1 load, 3 multiply-adds and 3 shuffles a number and lane.
// Turning over: Eklundh (1972), A fast computer method for matrix transposing, IEEE Transactions on Computers 21, 801-803.
#pragma once

#include <algorithm>
#include <cstdint>
#include <type_traits>

#include "boresight/lanes/lane_batch.hpp"
#include "boresight/math/lanes.hpp"

namespace boresight {

// Numbers of a register as the compiler's own vectors have them, for its shuffles.
template <int W, typename Real>
struct Register {
  using Integer = std::conditional_t<sizeof(Real) == 8, std::int64_t, std::int32_t>;
  using Numbers [[gnu::vector_size(W * sizeof(Real))]] = Real;
  using Integers [[gnu::vector_size(W * sizeof(Real))]] = Integer;
};

template <typename T, int distance = T::kWidth / 2>
inline void transpose_lanes(T* block) {
  constexpr int W = T::kWidth;
  if constexpr (W > 1 && distance > 0) {
    using Numbers = typename Register<W, typename T::Number>::Numbers;
    typename Register<W, typename T::Number>::Integers lower{}, upper{};
    for (int p = 0; p < W; ++p) {
      lower[p] = (p & distance) == 0 ? p : W + p - distance;
      upper[p] = (p & distance) == 0 ? p + distance : W + p;
    }
    for (int i = 0; i < W; ++i) {
      if (i & distance) continue;
      const auto a = __builtin_bit_cast(Numbers, block[i]), b = __builtin_bit_cast(Numbers, block[i + distance]);
      block[i] = __builtin_bit_cast(T, __builtin_shuffle(a, b, lower));
      block[i + distance] = __builtin_bit_cast(T, __builtin_shuffle(a, b, upper));
    }
    transpose_lanes<T, distance / 2>(block);
  }
}

// scenes, t: per lane. out: `width` numbers, a multiple of W. A lane without a scene is left as it was given by the lane before
// it.
template <typename T>
void scene_rows(const LaneScene* const* scenes, const double* t, int width, T* out) {
  constexpr int W = T::kWidth;
  using Real = typename T::Number;
  const Real* cell[W];
  Real share[W];
  for (int l = 0; l < W; ++l) {
    const LaneScene& scene = *scenes[l];
    const double x = t[l] * scene.per_spacing;
    const int k = std::clamp(static_cast<int>(x), 0, scene.cells - 1);
    share[l] = static_cast<Real>(x - k);
    cell[l] = scene.coefficients<Real>() + static_cast<std::size_t>(k) * 4 * width;
  }
  for (int first = 0; first < width; first += W) {
    for (int l = 0; l < W; ++l) {
      const Real *c0 = cell[l] + first, *c1 = c0 + width, *c2 = c1 + width, *c3 = c2 + width;
      const T s(share[l]);
      out[first + l] = fused(s, fused(s, fused(s, T::load(c3), T::load(c2)), T::load(c1)), T::load(c0));
    }
    transpose_lanes(out + first);
  }
}

}  // namespace boresight
