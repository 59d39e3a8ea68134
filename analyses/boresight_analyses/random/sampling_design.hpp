// Where the samples lie in the unit cube. Point k is a function of (seed, k) alone, so any thread, rank or resumed run
// draws the same one, and a study with more samples begins with the same points.
//
//   random   independent points
//   lhs      Latin hypercubes (McKay, Beckman, Conover 1979) of `strata` points each, one after the other: points 0 to
//            strata - 1 are the first hypercube, and so on; each is an independent replicate
//   sobol    `replicates` scrambled Sobol' nets side by side: point k belongs to net k mod replicates, as its point
//            k / replicates; each is an independent replicate
//
// Points of a hypercube or a net are not independent, so intervals come from the replicates, never from order
// statistics.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "boresight_analyses/random/sobol_net.hpp"

namespace boresight {

enum class SamplingKind { random, lhs, sobol };
const char* to_string(SamplingKind kind);

struct SamplingOptions {
  SamplingKind kind = SamplingKind::random;
  std::uint64_t seed = 1;
  std::uint64_t strata = 100;     // lhs: points per hypercube
  std::uint64_t replicates = 16;  // sobol: nets

  std::string text() const;  // equal texts give equal points
};

class SamplingDesign {
 public:
  // Throws std::invalid_argument for options out of range.
  SamplingDesign(const SamplingOptions& options, int dimensions);

  const SamplingOptions& options() const { return options_; }
  int dimensions() const { return dimensions_; }
  // Coordinates in (0, 1).
  void point(std::uint64_t k, std::span<double> coordinates) const;

  // Designs other than `random`: which replicate point k belongs to, and how many replicates the first n points
  // complete (all of one size; for sobol the size is that of each net so far).
  std::uint64_t replicate_of(std::uint64_t k) const;
  std::uint64_t whole_replicates(std::uint64_t n) const;
  // The number of leading points that make whole replicates of one size.
  std::uint64_t whole_points(std::uint64_t n) const;
  // What is wrong with n samples of this design, in a sentence; "" if nothing is.
  std::string warning(std::uint64_t n) const;

 private:
  SamplingOptions options_;
  int dimensions_;
  std::unique_ptr<const SobolNet> net_;
};

}  // namespace boresight
