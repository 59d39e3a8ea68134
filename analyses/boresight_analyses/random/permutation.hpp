// A random permutation of 0 .. n - 1, element by element and without a table: a Feistel network over the smallest even
// number of bits that holds n, walked until it lands below n (Black, Rogaway 2002, "Ciphers with arbitrary finite
// domains").
#pragma once

#include <bit>
#include <cstdint>

#include "boresight_analyses/random/counter_stream.hpp"

namespace boresight {

// Where element `i` < `n` goes, in the permutation that (seed, a, b) name.
inline std::uint64_t permuted(std::uint64_t i, std::uint64_t n, std::uint64_t seed, std::uint64_t a, std::uint64_t b) {
  if (n < 2) return 0;
  const CounterStream stream(seed, StreamPurpose::permutation);
  const int half = (static_cast<int>(std::bit_width(n - 1)) + 1) / 2;
  const std::uint64_t mask = (std::uint64_t{1} << half) - 1;
  constexpr std::uint64_t kRounds = 8;
  do {
    std::uint64_t left = i >> half, right = i & mask;
    for (std::uint64_t round = 0; round < kRounds; ++round) {
      const std::uint64_t next = left ^ (stream.bits((round << 32) | right, a, b) & mask);
      left = right;
      right = next;
    }
    i = (left << half) | right;
  } while (i >= n);
  return i;
}

}  // namespace boresight
