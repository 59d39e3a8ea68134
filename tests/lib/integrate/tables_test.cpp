// Every table is what it says: its orders by the rooted trees, its stability limits by R(z).
#include <gtest/gtest.h>

#include <cmath>

#include "boresight/integrate/order_conditions.hpp"

namespace boresight {
namespace tables_test {

const std::vector<const ExplicitTable*>& explicit_tables() {
  static const std::vector<const ExplicitTable*> tables{&classical_rk4(), &bogacki_shampine32(), &dormand_prince54()};
  return tables;
}
const std::vector<const RosenbrockTable*>& rosenbrock_tables() {
  static const std::vector<const RosenbrockTable*> tables{&rodas3(), &rodas4()};
  return tables;
}
constexpr double kThetas[] = {0.1, 0.37, 0.5, 0.81, 1.0};

TEST(RootedTrees, AreAsManyAsCayleyCounted) {
  const std::vector<RootedTree> trees = rooted_trees(7);
  std::vector<int> count(8, 0);
  for (const RootedTree& tree : trees) ++count[tree.nodes];
  EXPECT_EQ(count, (std::vector<int>{0, 1, 1, 2, 4, 9, 20, 48}));
}

TEST(RootedTrees, HaveTheDensitiesOfTheBushesAndTheTallTrees) {
  for (const RootedTree& tree : rooted_trees(6)) {
    if (static_cast<int>(tree.branches.size()) == tree.nodes - 1) {
      EXPECT_EQ(tree.density, tree.nodes) << tree.picture;
    }
  }
  EXPECT_EQ(rooted_trees(4).back().picture, "[[[.]]]");
  EXPECT_EQ(rooted_trees(4).back().density, 24.0);
}

// Methods from the textbook that are not used here: the checker must find their orders too. Hairer, Norsett,
// Wanner (1993), tables II.7.1 (Gauss, order 4) and II.7.7 (Radau IIA, order 3).
TEST(OrderConditions, FindTheOrdersOfGaussAndRadau) {
  MethodCoefficients gauss;
  gauss.alpha.resize(2, 2);
  const double shift = std::sqrt(3.0) / 6.0;
  gauss.alpha << 0.25, 0.25 - shift, 0.25 + shift, 0.25;
  gauss.gamma = MatX::Zero(2, 2);
  gauss.b = VecX::Constant(2, 0.5);
  EXPECT_EQ(attained_order(gauss, gauss.b, 6), 4);
  MethodCoefficients radau;
  radau.alpha.resize(2, 2);
  radau.alpha << 5.0 / 12.0, -1.0 / 12.0, 0.75, 0.25;
  radau.gamma = MatX::Zero(2, 2);
  radau.b = VecX::Zero(2);
  radau.b << 0.75, 0.25;
  EXPECT_EQ(attained_order(radau, radau.b, 6), 3);
}

TEST(OrderConditions, SeeASlipOfOneDigit) {
  ExplicitTable slipped = dormand_prince54();
  slipped.a[12] = 46732.0 / 5274.0;
  const MethodCoefficients method = coefficients(slipped);
  EXPECT_LT(attained_order(method, method.b, 5), 5);
  RosenbrockTable turned = rodas4();
  turned.c[4] += 1e-6;
  const MethodCoefficients other = coefficients(turned);
  EXPECT_LT(attained_order(other, other.b, 4, 1e-11), 4);
}

TEST(ExplicitTables, HaveTheirOrderAndNoMore) {
  for (const ExplicitTable* table : explicit_tables()) {
    const MethodCoefficients method = coefficients(*table);
    EXPECT_EQ(attained_order(method, method.b, 6), table->order) << table->name;
    if (table->b_embedded.empty()) continue;
    EXPECT_EQ(attained_order(method, method.b_embedded, 6), table->embedded_order) << table->name;
  }
}

TEST(ExplicitTables, EvaluateAtTheTimeOfTheirStages) {
  for (const ExplicitTable* table : explicit_tables()) {
    const VecX sums = coefficients(*table).alpha.rowwise().sum();
    for (int i = 0; i < table->stages; ++i) EXPECT_NEAR(sums[i], table->c[i], 1e-14) << table->name << " stage " << i;
  }
}

TEST(ExplicitTables, InterpolateToTheirDenseOrderEverywhereInTheStep) {
  for (const ExplicitTable* table : explicit_tables())
    for (double theta : kThetas) {
      const DenseWeights dense = dense_weights(*table, theta);
      EXPECT_GE(attained_order(dense.method, dense.b, table->dense_order, 1e-12, theta), table->dense_order)
          << table->name << " at " << theta;
    }
  const DenseWeights middle = dense_weights(dormand_prince54(), 0.5);
  EXPECT_EQ(attained_order(middle.method, middle.b, 5, 1e-12, 0.5), 4);
}

TEST(ExplicitTables, AreStableAsFarAsTheirConstantsSay) {
  for (const ExplicitTable* table : explicit_tables()) {
    const MethodCoefficients method = coefficients(*table);
    EXPECT_NEAR(stability_limit(method, -1.0), table->real_limit, 1e-9) << table->name;
    EXPECT_NEAR(stability_limit(method, {0.0, 1.0}), table->imaginary_limit, 1e-9) << table->name;
  }
}

TEST(ExplicitTables, MeasureStiffnessWithStagesAtOneTime) {
  for (const ExplicitTable* table : explicit_tables()) {
    const auto [i, j] = table->stiffness_stages;
    EXPECT_EQ(table->c[i], table->c[j]) << table->name;
  }
}

TEST(RosenbrockTables, HaveTheirOrderAndNoMore) {
  for (const RosenbrockTable* table : rosenbrock_tables()) {
    const MethodCoefficients method = coefficients(*table);
    EXPECT_EQ(attained_order(method, method.b, 6, 1e-11), table->order) << table->name;
    EXPECT_EQ(attained_order(method, method.b_embedded, 6, 1e-11), table->embedded_order) << table->name;
  }
}

TEST(RosenbrockTables, EvaluateAtTheTimeOfTheirStages) {
  for (const RosenbrockTable* table : rosenbrock_tables()) {
    const MethodCoefficients method = coefficients(*table);
    for (int i = 0; i < table->stages; ++i) {
      EXPECT_NEAR(method.alpha.row(i).sum(), table->alpha[i], 1e-12) << table->name << " stage " << i;
      EXPECT_NEAR(method.gamma.row(i).sum(), table->d[i], 1e-12) << table->name << " stage " << i;
      EXPECT_NEAR(method.gamma(i, i), table->gamma, 1e-14) << table->name << " stage " << i;
    }
  }
}

TEST(RosenbrockTables, InterpolateToTheirDenseOrderEverywhereInTheStep) {
  for (const RosenbrockTable* table : rosenbrock_tables())
    for (double theta : kThetas) {
      const DenseWeights dense = dense_weights(*table, theta);
      EXPECT_GE(attained_order(dense.method, dense.b, table->dense_order, 1e-11, theta), table->dense_order)
          << table->name << " at " << theta;
    }
}

TEST(RosenbrockTables, AreLStable) {
  for (const RosenbrockTable* table : rosenbrock_tables()) {
    const MethodCoefficients method = coefficients(*table);
    // A-stable: |R| <= 1 on the imaginary axis, the poles (1/gamma) in the right half plane.
    for (double y = 1e-3; y < 1e6; y *= 1.05)
      EXPECT_LE(std::abs(stability_function(method, {0.0, y})), 1.0 + 1e-12) << table->name << " at i " << y;
    EXPECT_GT(table->gamma, 0.0);
    // and it forgets what is infinitely stiff, in every direction of the left half plane.
    for (double angle : {0.5, 0.7, 0.9, 1.0})
      EXPECT_LT(std::abs(stability_function(method, std::polar(1e8, angle * std::acos(-1.0)))), 1e-6) << table->name;
  }
}

}  // namespace tables_test
}  // namespace boresight
