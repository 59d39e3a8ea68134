#include "boresight/math/block_cholesky.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace boresight {
namespace {

// Eliminates the block with fewest neighbours first; returns the order.
std::vector<int> minimum_degree_order(std::vector<std::set<int>> neighbours) {
  const int n = static_cast<int>(neighbours.size());
  std::vector<bool> done(n, false);
  std::vector<int> order;
  for (int step = 0; step < n; ++step) {
    int best = -1;
    for (int i = 0; i < n; ++i)
      if (!done[i] && (best < 0 || neighbours[i].size() < neighbours[best].size())) best = i;
    done[best] = true;
    order.push_back(best);
    for (int a : neighbours[best]) {
      neighbours[a].erase(best);
      for (int b : neighbours[best])
        if (a != b) neighbours[a].insert(b);
    }
  }
  return order;
}

// L of a symmetric 6 x 6 block, in place (lower triangle); the strict upper triangle is cleared.
// Returns the smallest ratio of a pivot to the diagonal entry it began as; stops at a pivot that is not positive.
double factor_block(Mat6& a, const Vec6& began) {
  double smallest = 1.0;
  for (int k = 0; k < 6; ++k) {
    double pivot = a(k, k);
    for (int j = 0; j < k; ++j) pivot -= a(k, j) * a(k, j);
    const double ratio = began[k] > 0.0 ? pivot / began[k] : 0.0;
    if (!(ratio > 0.0)) return 0.0;
    smallest = std::min(smallest, ratio);
    const double root = std::sqrt(pivot);
    const double inverse = 1.0 / root;
    a(k, k) = root;
    for (int i = k + 1; i < 6; ++i) {
      double sum = a(i, k);
      for (int j = 0; j < k; ++j) sum -= a(i, j) * a(k, j);
      a(i, k) = sum * inverse;
    }
    for (int j = k + 1; j < 6; ++j) a(k, j) = 0.0;
  }
  return smallest;
}

// b <- b L^-T
void solve_right_transposed(const Mat6& lower, Mat6& b) {
  for (int k = 0; k < 6; ++k) {
    for (int j = 0; j < k; ++j) b.col(k) -= lower(k, j) * b.col(j);
    b.col(k) *= 1.0 / lower(k, k);
  }
}

}  // namespace

BlockCholesky::BlockCholesky(const std::vector<Pair>& pairs, int size) : size_(size) {
  std::vector<std::set<int>> neighbours(size);
  for (auto [i, j] : pairs) {
    neighbours[i].insert(j);
    neighbours[j].insert(i);
  }
  original_ = minimum_degree_order(neighbours);
  place_.resize(size);
  for (int k = 0; k < size; ++k) place_[original_[k]] = k;
  diagonal_.assign(size, Mat6::Zero());
  columns_.resize(size);
  work_.resize(size);

  // Symbolic factorisation in elimination order.
  std::vector<std::set<int>> below(size);
  for (auto [i, j] : pairs) below[std::min(place_[i], place_[j])].insert(std::max(place_[i], place_[j]));
  std::map<Pair, int> where;
  for (int k = 0; k < size; ++k) {
    for (int row : below[k]) {
      where[{row, k}] = static_cast<int>(lower_.size());
      columns_[k].rows.push_back(row);
      columns_[k].blocks.push_back(static_cast<int>(lower_.size()));
      lower_.push_back(Mat6::Zero());
    }
    if (!below[k].empty()) {
      const int parent = *below[k].begin();
      for (int row : below[k])
        if (row != parent) below[parent].insert(row);
    }
  }
  for (int k = 0; k < size; ++k) {
    Column& column = columns_[k];
    for (std::size_t a = 0; a < column.rows.size(); ++a) {
      column.diagonal_updates.push_back({column.rows[a], column.blocks[a]});
      for (std::size_t b = 0; b < a; ++b)
        column.updates.push_back({where.at({column.rows[a], column.rows[b]}), column.blocks[a], column.blocks[b]});
    }
  }
  for (auto [i, j] : pairs) {
    const int row = std::max(place_[i], place_[j]), col = std::min(place_[i], place_[j]);
    entry_.push_back({where.at({row, col}), place_[i] < place_[j]});
  }
}

void BlockCholesky::set_zero() {
  for (Mat6& block : diagonal_) block.setZero();
  for (Mat6& block : lower_) block.setZero();
}

void BlockCholesky::add_off_diagonal(int k, const Mat6& block) {
  if (entry_[k].second)
    lower_[entry_[k].first] += block.transpose();
  else
    lower_[entry_[k].first] += block;
}

bool BlockCholesky::factor(double tolerance) {
  smallest_ratio_ = 1.0;
  weakest_ = -1;
  for (int k = 0; k < size_; ++k) work_[k] = diagonal_[k].diagonal();
  for (int k = 0; k < size_; ++k) {
    const double ratio = factor_block(diagonal_[k], work_[k]);
    if (ratio < smallest_ratio_) {
      smallest_ratio_ = ratio;
      weakest_ = original_[k];
    }
    if (ratio <= 0.0) return false;
    const Column& column = columns_[k];
    for (int block : column.blocks) solve_right_transposed(diagonal_[k], lower_[block]);
    for (auto [row, block] : column.diagonal_updates)
      diagonal_[row].noalias() -= lower_[block] * lower_[block].transpose();
    for (const Update& u : column.updates) lower_[u.target].noalias() -= lower_[u.left] * lower_[u.right].transpose();
  }
  return smallest_ratio_ > tolerance;
}

void BlockCholesky::solve(std::vector<Vec6>& x) const {
  for (int k = 0; k < size_; ++k) work_[k] = x[original_[k]];
  for (int k = 0; k < size_; ++k) {
    diagonal_[k].triangularView<Eigen::Lower>().solveInPlace(work_[k]);
    const Column& column = columns_[k];
    for (std::size_t a = 0; a < column.rows.size(); ++a)
      work_[column.rows[a]].noalias() -= lower_[column.blocks[a]] * work_[k];
  }
  for (int k = size_ - 1; k >= 0; --k) {
    const Column& column = columns_[k];
    for (std::size_t a = 0; a < column.rows.size(); ++a)
      work_[k].noalias() -= lower_[column.blocks[a]].transpose() * work_[column.rows[a]];
    diagonal_[k].transpose().triangularView<Eigen::Upper>().solveInPlace(work_[k]);
  }
  for (int k = 0; k < size_; ++k) x[original_[k]] = work_[k];
}

}  // namespace boresight
