#include "boresight_analyses/random/sobol_net.hpp"

#include <bit>
#include <boost/random/sobol.hpp>
#include <stdexcept>

#include "boresight_analyses/random/counter_stream.hpp"

namespace boresight {
namespace {

using Table = boost::random::default_sobol_table;

// Bratley and Fox (1988): m_j = 2 a_1 m_{j-1} ^ ... ^ 2^s m_{j-s} ^ m_{j-s}, and v_j = m_j 2^(bits - 1 - j), j from 0.
std::vector<std::uint32_t> direction_numbers(int dimension) {
  std::vector<std::uint32_t> m(SobolNet::kBits, 1);
  if (dimension > 0) {
    const auto row = static_cast<std::size_t>(dimension - 1);
    const std::uint32_t polynomial = Table::polynomial(row);
    const int degree = std::bit_width(polynomial) - 1;
    for (int j = 0; j < degree; ++j) m[j] = Table::minit(row, static_cast<std::size_t>(j));
    for (int j = degree; j < SobolNet::kBits; ++j) {
      m[j] = m[j - degree];
      for (int back = 1; back <= degree; ++back)
        if ((polynomial >> (degree - back)) & 1u) m[j] ^= m[j - back] << back;
    }
  }
  for (int j = 0; j < SobolNet::kBits; ++j) m[j] <<= SobolNet::kBits - 1 - j;
  return m;
}

}  // namespace

SobolNet::SobolNet(int dimensions) {
  if (dimensions < 1 || dimensions > kMostDimensions)
    throw std::invalid_argument("Sobol's sequence has 1 to " + std::to_string(kMostDimensions) + " dimensions");
  for (int d = 0; d < dimensions; ++d) directions_.push_back(direction_numbers(d));
}

std::uint32_t SobolNet::bits(std::uint64_t k, int dimension) const {
  const std::vector<std::uint32_t>& v = directions_[static_cast<std::size_t>(dimension)];
  std::uint32_t x = 0;
  for (int j = 0; k != 0; ++j, k >>= 1)
    if (k & 1u) x ^= v[static_cast<std::size_t>(j)];
  return x;
}

double SobolNet::scrambled(std::uint64_t k, int dimension, std::uint64_t seed, std::uint64_t replicate) const {
  const CounterStream flips(seed, StreamPurpose::scrambling), place(seed, StreamPurpose::within_cell);
  const std::uint32_t x = bits(k, dimension);
  const auto where = (replicate << 16) | static_cast<std::uint64_t>(dimension);
  std::uint32_t y = 0;
  for (int b = 0; b < kBits; ++b) {
    // The bits above bit b, with a leading one so that prefixes of different lengths differ.
    const std::uint64_t prefix = (std::uint64_t{1} << b) | (b == 0 ? 0u : x >> (kBits - b));
    const std::uint32_t bit = (x >> (kBits - 1 - b)) & 1u;
    y = (y << 1) | (bit ^ static_cast<std::uint32_t>(flips.bits(prefix, where) & 1u));
  }
  const std::uint64_t low = place.bits(k, where) >> 32;
  return CounterStream::to_unit((std::uint64_t{y} << 32) | low);
}

}  // namespace boresight
