// A selection among rows that are in order, against all their values put in order.
#include "boresight_analyses/budget/value_of_rank.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "boresight_analyses/random/counter_stream.hpp"

namespace boresight {
namespace value_of_rank_test {

TEST(ValueOfRank, IsThatOfAllRowsPutInOrderTogether) {
  const CounterStream stream(1, StreamPurpose::resampling);
  std::vector<std::vector<double>> rows = {{}, {0.0, 0.0, 3.5}, {3.5}, {}};
  for (std::uint64_t r = 0; r < 20; ++r) {
    std::vector<double>& row = rows.emplace_back();
    // Of unequal lengths and of any size, some of them many times.
    for (std::uint64_t k = 0; k < 3 * r; ++k)
      row.push_back(k % 5 == 0 ? 0.25 : std::exp(1400.0 * (stream.uniform(r, k, 0) - 0.5)));
    std::sort(row.begin(), row.end());
  }
  rows.push_back({std::numeric_limits<double>::denorm_min(), std::numeric_limits<double>::max(),
                  std::numeric_limits<double>::infinity()});
  std::vector<double> all;
  for (const std::vector<double>& row : rows) all.insert(all.end(), row.begin(), row.end());
  std::sort(all.begin(), all.end());
  ASSERT_GT(all.size(), 500u);
  for (std::size_t rank = 0; rank < all.size(); ++rank) EXPECT_EQ(value_of_rank(rows, rank), all[rank]) << rank;
}

TEST(ValueOfRank, OfOneValueIsThatOne) {
  EXPECT_EQ(value_of_rank({{2.0}}, 0), 2.0);
  EXPECT_EQ(value_of_rank({{2.0, 2.0}, {2.0}}, 2), 2.0);
}

}  // namespace value_of_rank_test
}  // namespace boresight
