// Cholesky factorisation A = L L^T of a symmetric positive definite matrix made of 6 x 6 blocks, most of them zero.
//
// The matrices of this program are J W J^T with one block row per joint: two joints meet in a block only if they share a
// body, so a mechanism of n joints needs O(n) blocks, not n^2. Order (minimum degree) and fill are found once, from the
// graph; factor() and solve() then allocate nothing.
// Source: George, Liu (1981), Computer Solution of Large Sparse Positive Definite Systems, chapters 4 and 5.
//
//   BlockCholesky a({{0, 1}, {1, 2}}, 3);       // blocks (0,1) and (1,2) may be nonzero, as may the diagonal
//   a.set_zero(); a.diagonal(0) = ...; a.add_off_diagonal(0, ...);  // block (row, column) as given in the list
//   if (a.factor()) a.solve(x);
#pragma once

#include <utility>
#include <vector>

#include "boresight/math/types.hpp"

namespace boresight {

class BlockCholesky {
 public:
  using Pair = std::pair<int, int>;  // (row, column) of an off-diagonal block; its transpose is understood

  BlockCholesky() = default;
  BlockCholesky(const std::vector<Pair>& pairs, int size);

  int size() const { return size_; }
  void set_zero();
  Mat6& diagonal(int i) { return diagonal_[place_[i]]; }
  // Adds `block` to the block (pairs[k].first, pairs[k].second).
  void add_off_diagonal(int k, const Mat6& block);

  // false if a pivot falls below `tolerance` times the diagonal entry it began as; weakest() then names its row.
  bool factor(double tolerance = 1e-13);
  // x: one 6-vector per block row; on return A^-1 x.
  void solve(std::vector<Vec6>& x) const;

  // Smallest pivot met by the last factor(), relative to the diagonal entry it began as, and its block row.
  double smallest_pivot_ratio() const { return smallest_ratio_; }
  int weakest() const { return weakest_; }

 private:
  struct Update {
    int target, left,
        right;  // target -= left right^T; indices into lower_ (or diagonal_ for target of a diagonal update)
  };
  struct Column {
    std::vector<int> rows;                              // block rows (in elimination order) below the diagonal
    std::vector<int> blocks;                            // their places in lower_
    std::vector<Update> updates;                        // of blocks in later columns
    std::vector<std::pair<int, int>> diagonal_updates;  // (row in elimination order, block in lower_)
  };

  int size_ = 0;
  std::vector<int> place_, original_;        // elimination position of a block row, and back
  std::vector<Mat6> diagonal_, lower_;       // in elimination order
  std::vector<std::pair<int, bool>> entry_;  // of pairs[k]: its block in lower_, and whether it is stored transposed
  std::vector<Column> columns_;
  mutable std::vector<Vec6> work_;
  double smallest_ratio_ = 1.0;
  int weakest_ = -1;
};

}  // namespace boresight
