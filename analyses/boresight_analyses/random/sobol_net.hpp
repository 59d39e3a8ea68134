// Sobol's sequence, point by point, each dimension scrambled as Owen (1995) does it.
//
// Direction numbers: Joe and Kuo (2008), from Boost.Random's table. Scrambling: bit b of a coordinate is flipped or
// not by a random number that belongs to the dimension and to the bits above it (nested uniform scrambling), so that
// every point is uniform on the cube and every net stays a net; below the 32 bits of the sequence the point lies
// anywhere in its cell. Owen (2021, "On dropping the first Sobol' point"): the first point is part of the net and is
// kept, and a number of points that is a power of two keeps the balance.
#pragma once

#include <cstdint>
#include <vector>

namespace boresight {

class SobolNet {
 public:
  static constexpr int kBits = 32;
  static constexpr int kMostDimensions = 3667;
  // Throws std::invalid_argument for more dimensions than there are.
  explicit SobolNet(int dimensions);

  int dimensions() const { return static_cast<int>(directions_.size()); }
  // The first kBits bits of a coordinate of point k < 2^kBits, unscrambled.
  std::uint32_t bits(std::uint64_t k, int dimension) const;
  // In (0, 1), scrambled as (seed, replicate) say.
  double scrambled(std::uint64_t k, int dimension, std::uint64_t seed, std::uint64_t replicate) const;

 private:
  std::vector<std::vector<std::uint32_t>> directions_;  // per dimension and bit
};

}  // namespace boresight
