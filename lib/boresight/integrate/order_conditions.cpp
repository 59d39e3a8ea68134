#include "boresight/integrate/order_conditions.hpp"

#include <cmath>
#include <functional>

#include "boresight/math/dense_solves.hpp"

namespace boresight {
namespace {

RootedTree joined(const std::vector<RootedTree>& trees, const std::vector<int>& branches) {
  RootedTree tree{branches, 1, 1.0, "["};
  for (int k : branches) {
    tree.nodes += trees[k].nodes;
    tree.density *= trees[k].density;
    tree.picture += trees[k].picture;
  }
  tree.density *= tree.nodes;
  tree.picture += "]";
  return tree;
}

// Phi of every tree, one column each.
MatX elementary_weights(const MethodCoefficients& method, const std::vector<RootedTree>& trees) {
  const MatX both = method.alpha + method.gamma;
  MatX phi = MatX::Ones(method.alpha.rows(), static_cast<Eigen::Index>(trees.size()));
  for (std::size_t t = 0; t < trees.size(); ++t)
    for (int branch : trees[t].branches) {
      const MatX& matrix = trees[t].branches.size() == 1 ? both : method.alpha;
      phi.col(static_cast<Eigen::Index>(t)).array() *= (matrix * phi.col(branch)).array();
    }
  return phi;
}

VecX vector_of(const std::vector<double>& values) {
  return Eigen::Map<const VecX>(values.data(), static_cast<Eigen::Index>(values.size()));
}

MatX triangle(const std::vector<double>& entries, int stages) {
  MatX matrix = MatX::Zero(stages, stages);
  for (int i = 1; i < stages; ++i)
    for (int j = 0; j < i; ++j) matrix(i, j) = RosenbrockTable::entry(entries, i, j);
  return matrix;
}

// Gamma of the textbook's form, u = Gamma k: its inverse is I/gamma - C.
MatX rosenbrock_gamma(const RosenbrockTable& table) {
  return solve_square(MatX(MatX::Identity(table.stages, table.stages) / table.gamma - triangle(table.c, table.stages)),
                      MatX(MatX::Identity(table.stages, table.stages)));
}

}  // namespace

std::vector<RootedTree> rooted_trees(int nodes) {
  std::vector<RootedTree> trees{{{}, 1, 1.0, "."}};
  for (int size = 2; size <= nodes; ++size) {
    const int smaller = static_cast<int>(trees.size());
    std::vector<int> branches;
    // Branches are chosen in no decreasing order, so that each multiset comes once.
    const std::function<void(int, int)> choose = [&](int from, int left) {
      if (left == 0) trees.push_back(joined(trees, branches));
      for (int k = from; k < smaller && trees[k].nodes <= left; ++k) {
        branches.push_back(k);
        choose(k, left - trees[k].nodes);
        branches.pop_back();
      }
    };
    choose(0, size - 1);
  }
  return trees;
}

MethodCoefficients coefficients(const ExplicitTable& table) {
  return {triangle(table.a, table.stages), MatX::Zero(table.stages, table.stages), vector_of(table.b),
          vector_of(table.b_embedded)};
}

MethodCoefficients coefficients(const RosenbrockTable& table) {
  const MatX gamma = rosenbrock_gamma(table);
  const VecX m = vector_of(table.m);
  return {triangle(table.a, table.stages) * gamma, gamma, gamma.transpose() * m,
          gamma.transpose() * (m - vector_of(table.e))};
}

DenseWeights dense_weights(const ExplicitTable& table, double theta) {
  DenseWeights dense{coefficients(table), {}};
  MethodCoefficients& method = dense.method;
  int stages = table.stages;
  if (!table.first_same_as_last()) {
    method.alpha.conservativeResizeLike(MatX::Zero(stages + 1, stages + 1));
    method.alpha.row(stages).head(stages) = method.b;
    method.gamma = MatX::Zero(stages + 1, stages + 1);
    method.b.conservativeResizeLike(VecX::Zero(stages + 1));
    ++stages;
  }
  const VecX first = VecX::Unit(stages, 0), last = VecX::Unit(stages, stages - 1);
  const double rest = 1.0 - theta;
  dense.b = theta * method.b + theta * rest * (rest * (first - method.b) + theta * (method.b - last));
  if (!table.d.empty()) dense.b += theta * theta * rest * rest * vector_of(table.d);
  return dense;
}

DenseWeights dense_weights(const RosenbrockTable& table, double theta) {
  VecX inner = vector_of(table.p);
  if (!table.q.empty()) inner += theta * vector_of(table.q);
  return {coefficients(table),
          rosenbrock_gamma(table).transpose() * (theta * (vector_of(table.m) + (1.0 - theta) * inner))};
}

std::vector<OrderResidual> order_residuals(const MethodCoefficients& method, const VecX& b, int order, double theta) {
  const std::vector<RootedTree> trees = rooted_trees(order);
  const VecX sums = elementary_weights(method, trees).transpose() * b;
  std::vector<OrderResidual> residuals;
  for (std::size_t t = 0; t < trees.size(); ++t)
    residuals.push_back(
        {trees[t], sums[static_cast<Eigen::Index>(t)] - std::pow(theta, trees[t].nodes) / trees[t].density});
  return residuals;
}

int attained_order(const MethodCoefficients& method, const VecX& b, int highest, double tolerance, double theta) {
  int order = highest;
  for (const OrderResidual& r : order_residuals(method, b, highest, theta))
    if (!(std::abs(r.residual) < tolerance)) order = std::min(order, r.tree.nodes - 1);
  return order;
}

std::complex<double> stability_function(const MethodCoefficients& method, std::complex<double> z) {
  // (I - z A) k = 1 by its real and imaginary parts, one below the other.
  const Eigen::Index s = method.b.size();
  const MatX A = method.alpha + method.gamma;
  MatX parts(2 * s, 2 * s);
  parts << MatX::Identity(s, s) - z.real() * A, z.imag() * A, -z.imag() * A, MatX::Identity(s, s) - z.real() * A;
  VecX ones = VecX::Zero(2 * s);
  ones.head(s).setOnes();
  const VecX stages = solve_square(parts, ones);
  return 1.0 + z * std::complex<double>(method.b.dot(stages.head(s)), method.b.dot(stages.tail(s)));
}

double stability_limit(const MethodCoefficients& method, std::complex<double> direction, double farthest) {
  // Rounding aside: on the imaginary axis |R| stays within 1e-16 of 1 near the origin.
  const auto stable = [&](double x) { return std::abs(stability_function(method, x * direction)) <= 1.0 + 1e-13; };
  const double stride = 1e-3;
  double low = 0.0;
  while (low < farthest && stable(low + stride)) low += stride;
  if (low >= farthest) return farthest;
  double high = low + stride;
  while (high - low > 1e-13) (stable(0.5 * (low + high)) ? low : high) = 0.5 * (low + high);
  return low;
}

}  // namespace boresight
