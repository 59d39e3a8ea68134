#include "boresight/math/block_cholesky.hpp"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <random>

namespace boresight {
namespace block_cholesky_test {

// A mechanism-like graph: three chains of five blocks whose last ones all meet.
const std::vector<BlockCholesky::Pair> kPairs = {{1, 0},   {2, 1},   {3, 2}, {4, 3},   {6, 5},
                                                 {7, 6},   {8, 7},   {9, 8}, {11, 10}, {12, 11},
                                                 {13, 12}, {14, 13}, {9, 4}, {14, 4},  {14, 9}};
constexpr int kBlocks = 15;

struct Problem {
  BlockCholesky blocks{kPairs, kBlocks};
  MatX dense = MatX::Zero(6 * kBlocks, 6 * kBlocks);
};

Problem random_problem(unsigned seed) {
  std::mt19937 generator(seed);
  std::normal_distribution<double> normal;
  const auto random = [&] { return Mat6(Mat6::NullaryExpr([&] { return normal(generator); })); };
  Problem p;
  p.blocks.set_zero();
  for (std::size_t k = 0; k < kPairs.size(); ++k) {
    const Mat6 block = random();
    const auto [i, j] = kPairs[k];
    p.blocks.add_off_diagonal(static_cast<int>(k), block);
    p.dense.block<6, 6>(6 * i, 6 * j) = block;
    p.dense.block<6, 6>(6 * j, 6 * i) = block.transpose();
  }
  for (int i = 0; i < kBlocks; ++i) {
    const Mat6 a = random();
    const Mat6 block = a * a.transpose() + 60.0 * Mat6::Identity();
    p.blocks.diagonal(i) = block;
    p.dense.block<6, 6>(6 * i, 6 * i) = block;
  }
  return p;
}

TEST(BlockCholesky, SolvesWhatADenseFactorisationSolves) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    Problem p = random_problem(seed);
    VecX b = VecX::Random(6 * kBlocks);
    std::vector<Vec6> x(kBlocks);
    for (int i = 0; i < kBlocks; ++i) x[i] = b.segment<6>(6 * i);
    ASSERT_TRUE(p.blocks.factor());
    p.blocks.solve(x);
    const VecX exact = p.dense.llt().solve(b);
    for (int i = 0; i < kBlocks; ++i) EXPECT_LT((x[i] - exact.segment<6>(6 * i)).norm(), 1e-13);
  }
}

TEST(BlockCholesky, RefusesAMatrixThatIsNotPositiveDefiniteAndNamesTheRow) {
  Problem p = random_problem(3);
  p.blocks.diagonal(7)(2, 2) = -1.0;
  EXPECT_FALSE(p.blocks.factor());
  EXPECT_EQ(p.blocks.weakest(), 7);
}

}  // namespace block_cholesky_test
}  // namespace boresight
