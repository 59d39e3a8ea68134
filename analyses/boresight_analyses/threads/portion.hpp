// How many samples are handed out at once: as many as a model likes while there are plenty, fewer towards the end, so that no
// worker waits long for the last of the others.
// Source: guided self-scheduling, Polychronopoulos and Kuck (1987), IEEE Transactions on Computers C-36, 1425-1439.
#pragma once

#include <algorithm>
#include <cstdint>

namespace boresight {

// The fewest worth the trouble of a model that likes `batch` at once.
constexpr std::uint64_t least_portion(std::uint64_t batch) { return std::max<std::uint64_t>(1, batch / 16); }

// left: samples not handed out yet; workers: that take them.
constexpr std::uint64_t portion(std::uint64_t batch, std::uint64_t left, int workers) {
  const std::uint64_t share = left / (2 * static_cast<std::uint64_t>(std::max(1, workers)));
  return std::clamp(share, least_portion(batch), std::max<std::uint64_t>(1, batch));
}

}  // namespace boresight
