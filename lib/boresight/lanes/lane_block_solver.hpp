// Decomposition of small dense matrices, one a lane, without pivots: four columns at a time, so that what lies below and to the
// right of them is read and written once for four products.
#pragma once

#include <vector>

#include "boresight/lanes/lane_numbers.hpp"

namespace boresight {

template <typename T>
class LaneBlockSolver {
 public:
  explicit LaneBlockSolver(int n) : n_(n), lu_(static_cast<std::size_t>(n) * n, T(0.0)) {}

  // The matrix, n x n, row by row; decompose() leaves its factors there.
  T* matrix() { return lu_.data(); }

  void decompose() {
    const int n = n_;
    for (int first = 0; first < n; first += kBlock) {
      const int last = first + kBlock < n ? first + kBlock : n;
      // The block's own columns, in all rows.
      for (int k = first; k < last; ++k) {
        T* pivot_row = row(k);
        pivot_row[k] = T(1.0) / pivot_row[k];
        const T inverse = pivot_row[k];
        for (int i = k + 1; i < n; ++i) {
          T* below = row(i);
          const T factor = below[k] * inverse;
          below[k] = factor;
          for (int j = k + 1; j < last; ++j) below[j] = fused(-factor, pivot_row[j], below[j]);
        }
      }
      if (last == n) return;
      // The block's own rows, to the right.
      for (int k = first + 1; k < last; ++k)
        for (int p = first; p < k; ++p) {
          const T factor = -row(k)[p];
          const T* above = row(p);
          for (int j = last; j < n; ++j) row(k)[j] = fused(factor, above[j], row(k)[j]);
        }
      // The rest.
      const T *a = row(first), *b = row(first + 1), *c = row(first + 2), *d = row(first + 3);
      int i = last;
      for (; i + 2 <= n; i += 2) {
        T *x = row(i), *y = row(i + 1);
        const T x0 = -x[first], x1 = -x[first + 1], x2 = -x[first + 2], x3 = -x[first + 3];
        const T y0 = -y[first], y1 = -y[first + 1], y2 = -y[first + 2], y3 = -y[first + 3];
        for (int j = last; j < n; ++j) {
          x[j] = fused(x3, d[j], fused(x2, c[j], fused(x1, b[j], fused(x0, a[j], x[j]))));
          y[j] = fused(y3, d[j], fused(y2, c[j], fused(y1, b[j], fused(y0, a[j], y[j]))));
        }
      }
      for (; i < n; ++i) {
        T* x = row(i);
        const T x0 = -x[first], x1 = -x[first + 1], x2 = -x[first + 2], x3 = -x[first + 3];
        for (int j = last; j < n; ++j) x[j] = fused(x3, d[j], fused(x2, c[j], fused(x1, b[j], fused(x0, a[j], x[j]))));
      }
    }
  }

  void substitute(T* x) const {
    const int n = n_, whole = n - n % kBlock;
    for (int first = 0; first < n; first += kBlock) {
      const int last = first + kBlock < n ? first + kBlock : n;
      subtract_product(last - first, first, row(first), n, x, x + first);
      for (int i = first + 1; i < last; ++i)
        for (int j = first; j < i; ++j) x[i] = fused(-row(i)[j], x[j], x[i]);
    }
    for (int first = whole < n ? whole : whole - kBlock; first >= 0; first -= kBlock) {
      const int last = first + kBlock < n ? first + kBlock : n;
      subtract_product(last - first, n - last, row(first) + last, n, x + last, x + first);
      for (int i = last - 1; i >= first; --i) {
        for (int j = i + 1; j < last; ++j) x[i] = fused(-row(i)[j], x[j], x[i]);
        x[i] = x[i] * row(i)[i];
      }
    }
  }

 private:
  static constexpr int kBlock = 4;
  const T* row(int i) const { return lu_.data() + static_cast<std::size_t>(i) * n_; }
  T* row(int i) { return lu_.data() + static_cast<std::size_t>(i) * n_; }

  int n_;
  std::vector<T> lu_;
};

}  // namespace boresight
