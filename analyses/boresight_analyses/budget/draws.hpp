// What contributors draw from, alone or with others.
//
// Every contributor has a stream of random numbers. Contributors of one group share one: they vary together. Correlated ones have normal scores
// that are sums over streams, z_i = sum of L_ij z_j with L L^T their correlation matrix (a Gaussian copula: Nelsen 2006, An Introduction to Copulas,
// 2.3.6), so that each keeps its own distribution. Axes of one contributor are correlated in the same way.
#pragma once

#include <cmath>
#include <complex>
#include <cstdint>
#include <vector>

#include "boresight/math/types.hpp"
#include "boresight_analyses/random/counter_stream.hpp"

namespace boresight {

struct Draws {
  struct Part {
    std::uint64_t stream;
    double weight;
  };
  std::vector<Part> parts;

  Draws(std::uint64_t stream) : parts{{stream, 1.0}} {}  // NOLINT: a stream alone is the usual case
  explicit Draws(std::vector<Part> of) : parts(std::move(of)) {}
  bool alone() const { return parts.size() == 1; }
  std::uint64_t first() const { return parts.front().stream; }
  double correlation_with(const Draws& other) const;
};

// Two contributors by their places, and the correlation of their normal scores.
struct ContributorCorrelation {
  std::size_t first = 0, second = 0;
  double coefficient = 0.0;
};

// Of contributors with these streams of their own. Throws std::domain_error where the coefficients are no correlation matrix.
std::vector<Draws> draws_of(const std::vector<std::uint64_t>& streams,
                            const std::vector<ContributorCorrelation>& correlations);

// Lower triangular L with L L^T the correlation of three axes [xy, xz, yz]. Throws std::domain_error where there is none.
Mat3 axes_of_correlation(double xy, double xz, double yz);

// The numbers of one member and purpose, mixed over streams and axes.
class MixedNumbers {
 public:
  MixedNumbers(const CounterStream& numbers, std::uint64_t member, const Draws& draws, const Mat3& axes)
      : numbers_(numbers), member_(member), draws_(draws), axes_(axes) {}

  // A uniform number in (0, 1) of an axis. place(stream, axis): where in the numbers it stands, {b, c} of CounterStream.
  template <typename Place>
  double uniform(Eigen::Index axis, const Place& place) const {
    if (is_own(axis)) return at(place(draws_.first(), axis));
    return to_uniform(normal(axis, place));
  }
  template <typename Place>
  double normal(Eigen::Index axis, const Place& place) const {
    if (is_own(axis)) return to_normal(at(place(draws_.first(), axis)));
    double sum = 0.0;
    for (const Draws::Part& part : draws_.parts)
      for (Eigen::Index other = 0; other <= axis; ++other)
        if (axes_(axis, other) != 0.0)
          sum += part.weight * axes_(axis, other) * to_normal(at(place(part.stream, other)));
    return sum;
  }
  // Two independent normal numbers as one complex, from two uniform ones at c and c + 1 (Box and Muller 1958).
  template <typename Place>
  std::complex<double> two_normals(Eigen::Index axis, const Place& place) const {
    std::complex<double> sum = 0.0;
    for (const Draws::Part& part : draws_.parts)
      for (Eigen::Index other = 0; other <= axis; ++other) {
        if (axes_(axis, other) == 0.0) continue;
        const Where from = place(part.stream, other);
        sum += part.weight * axes_(axis, other) *
               std::polar(std::sqrt(-2.0 * std::log(at(from))), 2.0 * M_PI * at({from.b, from.c + 1}));
      }
    return sum;
  }

  struct Where {
    std::uint64_t b, c;
  };

 private:
  bool is_own(Eigen::Index axis) const { return draws_.alone() && axes_(axis, axis) == 1.0; }
  double at(const Where& where) const { return numbers_.uniform(member_, where.b, where.c); }
  static double to_normal(double uniform);
  static double to_uniform(double normal);

  const CounterStream& numbers_;
  std::uint64_t member_;
  const Draws& draws_;
  const Mat3& axes_;
};

}  // namespace boresight
