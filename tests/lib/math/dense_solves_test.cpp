// Solutions of systems that are no systems: a mechanism without play, or without loops, has matrices without rows or columns.
#include "boresight/math/dense_solves.hpp"

#include <gtest/gtest.h>

#include "boresight/math/singular_values.hpp"

namespace boresight {
namespace dense_solves_test {

TEST(DenseSolves, OfNothingAreNothing) {
  for (const auto& [rows, columns] : {std::pair{0, 0}, {0, 3}, {4, 0}}) {
    const MatX A = MatX::Zero(rows, columns);
    EXPECT_EQ(solve_least(A, VecX(VecX::Ones(rows))), VecX(VecX::Zero(columns)));
    EXPECT_EQ(solve_least(A, MatX(MatX::Ones(rows, 2))), MatX(MatX::Zero(columns, 2)));
    EXPECT_EQ(pseudo_inverse(A), MatX(MatX::Zero(columns, rows)));
    EXPECT_EQ(rank_bounds(A, 1e-9).rank, 0);
    EXPECT_EQ(singular_values(A).size(), 0);
    EXPECT_EQ(singular_decomposition(A).V, MatX(MatX::Identity(columns, columns)));
  }
  const MatX nothing(0, 0);
  const VecX none(0);
  EXPECT_EQ(solve_positive(nothing, none).size(), 0);
  EXPECT_EQ(solve_symmetric(nothing, none).size(), 0);
  EXPECT_EQ(solve_square(nothing, none).size(), 0);
  EXPECT_EQ(cholesky_factor(nothing).size(), 0);
}

}  // namespace dense_solves_test
}  // namespace boresight
