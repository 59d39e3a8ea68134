// The value of a rank among the values of several rows, each of which is in order: what a selection among all of them finds, without
// putting them together.
//
// Halves the range in which the value lies, of all numbers that there are: those of no sign are in the order of their bits, so that this takes
// 64 halvings at most. In each row only the values within the range are looked at.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <vector>

namespace boresight {

// rows: each ascending, of numbers no less than zero. rank: counted from zero, below the number of all values.
inline double value_of_rank(const std::vector<std::vector<double>>& rows, std::size_t rank) {
  using Place = std::vector<double>::const_iterator;
  struct Open {
    Place begin, end;  // of the values in the range
  };
  std::vector<Open> open;
  std::uint64_t low = ~std::uint64_t{0}, high = 0;
  for (const std::vector<double>& row : rows) {
    if (row.empty()) continue;
    open.push_back({row.begin(), row.end()});
    low = std::min(low, std::bit_cast<std::uint64_t>(row.front()));
    high = std::max(high, std::bit_cast<std::uint64_t>(row.back()));
  }
  std::size_t below = 0;  // values less than the range
  std::vector<Place> middles(open.size());
  while (low < high) {
    const std::uint64_t middle = low + (high - low) / 2;
    const auto at = std::bit_cast<double>(middle);
    std::size_t up_to = below;
    for (std::size_t k = 0; k < open.size(); ++k) {
      middles[k] = std::upper_bound(open[k].begin, open[k].end, at);
      up_to += static_cast<std::size_t>(middles[k] - open[k].begin);
    }
    const bool lower_half = up_to > rank;
    (lower_half ? high : low) = lower_half ? middle : middle + 1;
    if (!lower_half) below = up_to;
    for (std::size_t k = 0; k < open.size(); ++k) (lower_half ? open[k].end : open[k].begin) = middles[k];
  }
  return std::bit_cast<double>(low);
}

}  // namespace boresight
