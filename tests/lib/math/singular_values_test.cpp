#include "boresight/math/singular_values.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <random>

namespace boresight {
namespace singular_values_test {

// What a table on a plane and three arms of two links leave open where all revolute joints have play: turns across the joints' axes, the drives'
// turns about them, the table's plane. 24 x 42 numbers, many of the singular values equal.
MatX rows_of_parallel_joints(const Vec3& axis) {
  const Vec3 across = axis.unitOrthogonal(), other = axis.cross(across);
  constexpr int kTable = 0, kGroundBody = -1;
  MatX A = MatX::Zero(24, 42);
  int row = 0;
  const auto turn = [&](int first, int second, const Vec3& about) {
    if (first != kGroundBody) A.block<1, 3>(row, 6 * first + 3) = about.transpose();
    A.block<1, 3>(row++, 6 * second + 3) = -about.transpose();
  };
  for (int arm = 0; arm < 3; ++arm) {
    const int upper = 2 * arm + 1, lower = upper + 1;
    turn(kGroundBody, upper, axis);
    for (const Vec3& about : {across, other}) {
      turn(kGroundBody, upper, about);
      turn(upper, lower, about);
      turn(lower, kTable, about);
    }
  }
  A.block<1, 3>(row++, 6 * kTable) = axis.transpose();
  turn(kGroundBody, kTable, across);
  turn(kGroundBody, kTable, other);
  return A;
}

TEST(SingularValues, GiveANullSpaceAndADecompositionWhereTheyRepeat) {
  constexpr double kRounding = 1e-13;
  std::mt19937 generator(1);
  std::normal_distribution<double> normal;
  for (int drawing = 0; drawing < 2000; ++drawing) {
    const MatX A = rows_of_parallel_joints(Vec3(normal(generator), normal(generator), normal(generator)).normalized());
    const auto [values, V] = singular_decomposition(A);
    ASSERT_EQ(V.cols(), A.cols());
    EXPECT_LT((V.transpose() * V - MatX::Identity(V.cols(), V.cols())).norm(), kRounding * 42.0) << drawing;
    const VecX lengths = (A * V).colwise().norm();
    for (Eigen::Index k = 0; k < V.cols(); ++k)
      ASSERT_NEAR(lengths[k], k < values.size() ? values[k] : 0.0, kRounding * values[0]) << drawing << " " << k;
    EXPECT_LT((singular_values(A) - values).norm(), kRounding * values[0]) << drawing;
    EXPECT_NEAR(values.squaredNorm(), A.squaredNorm(), kRounding * A.squaredNorm()) << drawing;
  }
}

TEST(SingularValues, OfAnEmptyMatrixAreNone) {
  EXPECT_EQ(singular_values(MatX(0, 3)).size(), 0);
  EXPECT_EQ(singular_decomposition(MatX(0, 3)).V, MatX(MatX::Identity(3, 3)));
}

}  // namespace singular_values_test
}  // namespace boresight
