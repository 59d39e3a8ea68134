#include "boresight/mechanism/rank_analysis.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <numeric>
#include <vector>

#include "boresight/math/singular_values.hpp"
#include "boresight/mechanism/spanning_tree.hpp"

namespace boresight {
namespace {

std::string direction(Vec3 v) {
  v.normalize();
  // The sign of a direction means nothing here: let its largest component be positive.
  Eigen::Index k;
  v.cwiseAbs().maxCoeff(&k);
  if (v[k] < 0.0) v = -v;
  char text[80];
  const auto clean = [](double x) { return std::abs(x) < 5e-4 ? 0.0 : x; };
  std::snprintf(text, sizeof text, "(%.3g, %.3g, %.3g)", clean(v.x()), clean(v.y()), clean(v.z()));
  return text;
}

// For each body the first one of its group: bodies that no row couples, directly or by others, are in different groups.
std::vector<int> coupled_groups(const MatX& J) {
  std::vector<int> first(J.cols() / 6);
  std::iota(first.begin(), first.end(), 0);
  const auto root = [&](int b) {
    while (first[b] != b) b = first[b] = first[first[b]];
    return b;
  };
  for (int row = 0; row < J.rows(); ++row) {
    int one = -1;
    for (int b = 0; b < static_cast<int>(first.size()); ++b) {
      if (J.block(row, 6 * b, 1, 6).isZero(0.0)) continue;
      if (one >= 0) first[std::max(root(one), root(b))] = std::min(root(one), root(b));
      one = b;
    }
  }
  for (int b = 0; b < static_cast<int>(first.size()); ++b) first[b] = root(b);
  return first;
}

// The blocks of J that belong to its groups, or to those of them that hold one of these bodies, without rows and columns of zeros only.
std::vector<MatX> blocks_by_group(const MatX& J, const std::vector<int>* with_one_of = nullptr) {
  const std::vector<int> first = coupled_groups(J);
  std::vector<MatX> blocks;
  for (int g = 0; g < static_cast<int>(first.size()); ++g) {
    if (with_one_of &&
        std::none_of(with_one_of->begin(), with_one_of->end(), [&](int body) { return first[body] == g; }))
      continue;
    std::vector<Eigen::Index> rows, columns;
    for (int b = g; b < static_cast<int>(first.size()); ++b)
      for (int i = 0; first[b] == g && i < 6; ++i) columns.push_back(6 * b + i);
    if (columns.empty()) continue;
    for (Eigen::Index row = 0; row < J.rows(); ++row)
      if (!J(row, columns).isZero(0.0)) rows.push_back(row);
    if (!rows.empty()) blocks.push_back(J(rows, columns));
  }
  return blocks;
}

VecX singular_values_of(const std::vector<MatX>& blocks, Eigen::Index least = 0) {
  std::vector<double> all;
  for (const MatX& block : blocks) {
    const VecX sigma = singular_values(block);
    all.insert(all.end(), sigma.begin(), sigma.end());
  }
  all.resize(std::max(least, static_cast<Eigen::Index>(all.size())), 0.0);
  std::sort(all.begin(), all.end(), std::greater<>());
  return Eigen::Map<const VecX>(all.data(), static_cast<Eigen::Index>(all.size()));
}

// The singular values of J, falling: those of its groups' blocks together, each for the cube of its own size alone.
VecX singular_values_by_group(const MatX& J) {
  return singular_values_of(blocks_by_group(J), std::min(J.rows(), J.cols()));
}

// The right singular vector of the smallest singular value. Of many columns by inverse iteration: it finds the one vector for a third of the
// cube of their number, where a decomposition takes minutes for a thousand.
VecX least_resisted(const MatX& J) {
  constexpr Eigen::Index kSmall = 120;
  if (J.cols() <= kSmall) return singular_decomposition(J).V.col(J.cols() - 1);
  constexpr int kIterations = 8;
  constexpr double kShift = 1e-14;  // of the largest: rounding of J^T J, which may be singular
  MatX A = J.transpose() * J;
  A.diagonal().array() += kShift * A.diagonal().maxCoeff();
  const Eigen::LDLT<MatX> factors(A);
  VecX x(J.cols());
  for (Eigen::Index k = 0; k < x.size(); ++k)
    x[k] = std::sin(1.0 + static_cast<double>(k));  // along nothing in particular
  for (int k = 0; k < kIterations; ++k) x = factors.solve(x).normalized();
  return x;
}

int rank_of(const VecX& sigma) {
  int rank = 0;
  for (const double s : sigma) rank += s > kRankTolerance * sigma[0];
  return rank;
}

}  // namespace

MatX stacked_rows(const JointConstraint& constraint, const std::vector<BodyMotion>& bodies) {
  JointRows rows;
  constraint.evaluate(bodies, {}, rows);
  const Eigen::Index n = constraint.count();
  MatX J = MatX::Zero(n, 6 * static_cast<Eigen::Index>(bodies.size()));
  if (const int b = constraint.reference_body(); b != kGround) J.middleCols<6>(6 * b) += rows.reference.topRows(n);
  if (const int b = constraint.other_body(); b != kGround) J.middleCols<6>(6 * b) += rows.other.topRows(n);
  return J;
}

MatX scaled_rows(MatX J, double length) {
  for (int row = 0; row < J.rows(); ++row) {
    bool distance = false;
    for (int b = 0; b < J.cols() / 6; ++b) distance |= J.block(row, 6 * b, 1, 3).cwiseAbs().maxCoeff() > 0.0;
    if (distance) J.row(row) /= length;
  }
  for (int b = 0; b < J.cols() / 6; ++b) J.middleCols(6 * b, 3) *= length;
  return J;
}

RankAnalysis analyse_rank(const Mechanism& mechanism, const ConstraintSystem& evaluated, bool with_motion) {
  const double length = mechanism.characteristic_length();
  const MatX J = scaled_rows(evaluated.dense_jacobian(), length);
  RankAnalysis result;
  result.rows = static_cast<int>(J.rows());
  result.columns = static_cast<int>(J.cols());
  if (J.rows() == 0) return result;
  const VecX sigma = singular_values_by_group(J);
  result.largest = sigma[0];
  result.rank = rank_of(sigma);
  result.weakest = J.rows() >= J.cols() ? sigma[J.cols() - 1] : 0.0;
  if (with_motion) {
    result.least_resisted = least_resisted(J);
    for (int b = 0; b < evaluated.bodies(); ++b) result.least_resisted.segment<3>(6 * b) *= length;
  }
  return result;
}

VecX singular_values_of_loops(const Mechanism& mechanism, const ConstraintSystem& evaluated) {
  const SpanningTree tree(mechanism, false);
  std::vector<int> closing;
  for (const int joint : tree.cut_joints())
    for (const JointDescription& d = mechanism.description().joints[joint]; const int body : {d.first, d.second})
      if (body != kGround) closing.push_back(body);
  if (closing.empty()) return {};
  const MatX J = scaled_rows(evaluated.dense_jacobian(), mechanism.characteristic_length());
  return singular_values_of(blocks_by_group(J, &closing));
}

int constraint_rank(const Mechanism& mechanism, const ConstraintSystem& evaluated) {
  const MatX J = scaled_rows(evaluated.dense_jacobian(), mechanism.characteristic_length());
  if (J.rows() == 0) return 0;
  const std::vector<MatX> blocks = blocks_by_group(J);
  // The largest singular value lies between the longest column and the Frobenius norm of the largest block.
  double at_least = 0.0, at_most = 0.0;
  for (const MatX& block : blocks) {
    at_least = std::max(at_least, block.colwise().norm().maxCoeff());
    at_most = std::max(at_most, block.norm());
  }
  int rank = 0;
  for (const MatX& block : blocks) {
    const RankBounds bounds = rank_bounds(block, kRankTolerance * at_most);
    rank += bounds.rank;
    if (bounds.kept <= kRankTolerance * at_most || bounds.dropped > kRankTolerance * at_least)
      return rank_of(singular_values_by_group(J));
  }
  return rank;
}

std::string describe_motion(const Mechanism& mechanism, const VecX& motion, int body) {
  const Vec3 v = motion.segment<3>(6 * body), w = motion.segment<3>(6 * body + 3);
  const double moves = v.norm() / mechanism.characteristic_length(), turns = w.norm();
  const double whole = std::hypot(moves, turns);
  if (whole < 1e-9) return "stands still";
  std::string text;
  if (turns > 0.05 * whole) text = "turns about " + direction(w);
  if (moves > 0.05 * whole) text += (text.empty() ? "moves along " : " and moves along ") + direction(v);
  return text;
}

}  // namespace boresight
