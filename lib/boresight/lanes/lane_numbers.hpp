// Arrays of lanes over the coordinates, of a size known when compiling, and products with matrices of any size.
#pragma once

#include <array>
#include <cstddef>

#include "boresight/math/scalar.hpp"

namespace boresight {

// Not zero from the start.
template <typename T, int N>
using LaneVector = std::array<T, N>;
template <typename T, int N>
using LaneMatrix = std::array<T, N * N>;  // row by row

// out -= matrix x, for `rows` rows of `columns` numbers, `stride` apart; four rows at a time, whose sums wait for nothing but
// themselves. out may lie beside x, not upon it.
template <typename T>
void subtract_product(int rows, int columns, const T* matrix, std::ptrdiff_t stride, const T* x, T* out) {
  int i = 0;
  for (; i + 4 <= rows; i += 4) {
    const T *a = matrix + i * stride, *b = a + stride, *c = b + stride, *d = c + stride;
    T s0 = out[i], s1 = out[i + 1], s2 = out[i + 2], s3 = out[i + 3];
    for (int j = 0; j < columns; ++j) {
      const T minus = -x[j];
      s0 = fused(a[j], minus, s0);
      s1 = fused(b[j], minus, s1);
      s2 = fused(c[j], minus, s2);
      s3 = fused(d[j], minus, s3);
    }
    out[i] = s0, out[i + 1] = s1, out[i + 2] = s2, out[i + 3] = s3;
  }
  for (; i < rows; ++i) out[i] -= sum_of_products(columns, matrix + i * stride, x);
}

}  // namespace boresight
