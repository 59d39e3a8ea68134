// Factorisation H = L^T L of a joint-space mass matrix, L lower triangular.
//
// H_ij is nonzero only if one of the speeds i, j lies on the other's path to the ground: branches do not meet. Taken from
// the last speed to the first, the factorisation keeps exactly this pattern, so three legs cost three small factorisations.
// (The usual L L^T would fill the matrix.)
// Source: Featherstone (2008), Rigid Body Dynamics Algorithms, section 6.5, tables 6.3 and 6.4.
#pragma once

#include <cmath>
#include <vector>

#include "boresight/math/types.hpp"

namespace boresight {

class BranchCholesky {
 public:
  // parent: SpanningTree::speed_parent().
  explicit BranchCholesky(const std::vector<int>& parent)
      : parent_(parent),
        size_(static_cast<int>(parent.size())),
        entry_(parent.size() * parent.size(), 0.0),
        inverse_(parent.size(), 0.0) {}

  int size() const { return size_; }
  // Entry (i, j) of H, j being i or on its path to the ground. Fill all of them before factor().
  double& entry(int i, int j) { return entry_[static_cast<std::size_t>(i) * size_ + j]; }

  // H is positive definite where all masses are positive, whatever the pose.
  void factor() {
    for (int k = size_ - 1; k >= 0; --k) {
      double* row = &entry(k, 0);
      inverse_[k] = 1.0 / std::sqrt(row[k]);
      for (int i = parent_[k]; i >= 0; i = parent_[i]) row[i] *= inverse_[k];
      for (int i = parent_[k]; i >= 0; i = parent_[i])
        for (int j = i; j >= 0; j = parent_[j]) entry(i, j) -= row[i] * row[j];
    }
  }

  // x <- L^-T x, for x that is nonzero on some paths to the ground only: `speeds` lists these, largest first.
  // T: double, or a fixed-size vector to solve for several right-hand sides at once.
  template <typename T>
  void solve_transposed(const std::vector<int>& speeds, T* x) const {
    for (int k : speeds) solve_transposed_at(k, x);
  }
  template <typename T>
  void solve_transposed(T* x) const {
    for (int k = size_ - 1; k >= 0; --k) solve_transposed_at(k, x);
  }

  // x <- L^-1 x
  void solve(double* x) const {
    for (int k = 0; k < size_; ++k) {
      const double* row = &entry_[static_cast<std::size_t>(k) * size_];
      double sum = x[k];
      for (int j = parent_[k]; j >= 0; j = parent_[j]) sum -= row[j] * x[j];
      x[k] = sum * inverse_[k];
    }
  }

 private:
  template <typename T>
  void solve_transposed_at(int k, T* x) const {
    const double* row = &entry_[static_cast<std::size_t>(k) * size_];
    x[k] *= inverse_[k];
    for (int j = parent_[k]; j >= 0; j = parent_[j]) x[j] -= row[j] * x[k];
  }

  const std::vector<int>& parent_;
  int size_;
  std::vector<double> entry_;    // L below the diagonal, row by row
  std::vector<double> inverse_;  // of L's diagonal
};

}  // namespace boresight
