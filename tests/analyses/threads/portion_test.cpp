// Samples are handed out in large portions while there are plenty, in small ones at the end, and all of them once.
#include "boresight_analyses/threads/portion.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace boresight {
namespace portion_test {

std::vector<std::uint64_t> portions(std::uint64_t batch, std::uint64_t samples, int workers) {
  std::vector<std::uint64_t> all;
  while (samples > 0) {
    all.push_back(std::min(samples, portion(batch, samples, workers)));
    samples -= all.back();
  }
  return all;
}

TEST(Portion, IsAWholeBatchWhileThereArePlenty) {
  EXPECT_EQ(portion(1024, 100'000, 2), 1024u);
  EXPECT_EQ(portion(1, 100'000, 2), 1u);
}

TEST(Portion, ShrinksTowardsTheEndDownToASixteenthOfABatch) {
  const std::vector<std::uint64_t> all = portions(1024, 5'000, 2);
  EXPECT_EQ(all.front(), 1024u);
  for (std::size_t k = 1; k < all.size(); ++k) EXPECT_LE(all[k], all[k - 1]);
  EXPECT_LE(all.back(), 64u);
  // Whoever takes the last whole portion is not busy for longer than the others have work.
  std::uint64_t left = 5'000;
  for (const std::uint64_t taken : all) {
    EXPECT_TRUE(taken <= 64 || 2 * taken <= left) << taken << " of " << left;
    left -= taken;
  }
}

TEST(Portion, IsNeverNothing) {
  EXPECT_EQ(portion(1024, 3, 8), 64u);  // the caller takes what is there
  EXPECT_EQ(portion(0, 1, 0), 1u);
}

}  // namespace portion_test
}  // namespace boresight
