// How often intervals hold the truth, for tests of coverage.
#pragma once

#include <gsl/gsl_qrng.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <vector>

namespace boresight::repetition {

constexpr int kRepetitions = 1000;

// Share of `kRepetitions` intervals, each from `interval(engine)`, that hold `truth`.
template <typename F>
double coverage(double truth, F&& interval, unsigned seed) {
  int held = 0;
  for (int k = 0; k < kRepetitions; ++k) {
    std::mt19937_64 engine(1000003ull * seed + static_cast<unsigned>(k));
    const auto i = interval(engine);
    held += i.low <= truth && truth <= i.high;
  }
  return double(held) / kRepetitions;
}

inline double uniform(std::mt19937_64& engine) {
  return (double(engine() >> 11) + 0.5) * 0x1p-53;  // open interval
}

using Points = std::vector<std::vector<double>>;  // [sample][dimension], in the unit cube

inline Points latin_hypercube(std::mt19937_64& engine, int n, int d) {
  Points x(n, std::vector<double>(d));
  std::vector<int> cell(n);
  for (int j = 0; j < d; ++j) {
    std::iota(cell.begin(), cell.end(), 0);
    std::shuffle(cell.begin(), cell.end(), engine);
    for (int k = 0; k < n; ++k) x[k][j] = (cell[k] + uniform(engine)) / n;
  }
  return x;
}

// The first 2^m points of a Sobol' sequence, each dimension scrambled after Owen (1995): every bit is flipped or not by
// a coin that belongs to the bits above it. GSL leaves out the point at zero, which belongs to the net.
inline Points scrambled_sobol(std::mt19937_64& engine, int n, int d) {
  Points x(n, std::vector<double>(d, 0.0));
  gsl_qrng* sequence = gsl_qrng_alloc(gsl_qrng_sobol, static_cast<unsigned>(d));
  for (int k = 1; k < n; ++k) gsl_qrng_get(sequence, x[k].data());
  gsl_qrng_free(sequence);
  const auto mixed = [](std::uint64_t z) {  // the finaliser of SplitMix64 (Steele, Lea, Flood 2014)
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ull;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebull;
    return z ^ (z >> 31);
  };
  int levels = 0;
  while ((1 << levels) < n) ++levels;
  for (int j = 0; j < d; ++j) {
    const std::uint64_t key = engine();
    for (auto& point : x) {
      const auto bits = static_cast<std::uint64_t>(std::ldexp(point[j], levels));
      std::uint64_t scrambled = 0;
      for (int level = levels - 1; level >= 0; --level) {
        const std::uint64_t above = (bits >> (level + 1)) + (1ull << (levels - 1 - level));
        scrambled |= (((bits >> level) ^ mixed(key + 0x9e3779b97f4a7c15ull * above)) & 1u) << level;
      }
      point[j] = (double(scrambled) + uniform(engine)) / n;  // below the net's cells all bits are coins
    }
  }
  return x;
}

}  // namespace boresight::repetition
