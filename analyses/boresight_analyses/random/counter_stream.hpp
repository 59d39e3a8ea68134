// Random numbers that are a function: of the seed, of what they are for, and of a counter, and of nothing else. So
// sample k is the same whatever thread, rank or resumed run draws it, and in whatever order.
//
// Philox 4x64-10 (Salmon, Moraes, Dror, Shaw 2011, "Parallel random numbers: as easy as 1, 2, 3"), from Random123.
#pragma once

#include <Random123/philox.h>

#include <cstdint>

namespace boresight {

// What a stream is for; streams of different purposes never meet. The numbers are part of every stored study.
enum class StreamPurpose : std::uint64_t {
  sample = 1,         // coordinates of independent samples
  scrambling = 2,     // of a net
  permutation = 3,    // of a Latin hypercube's strata
  within_cell = 4,    // where in its cell a point of a hypercube or a net lies
  resampling = 5,     // bootstrap
  subset = 6,         // chains of subset simulation
  proposal = 7,       // draws of importance sampling, starts of its mixture
  budget_value = 8,   // what a member's external errors are
  budget_course = 9,  // and how they go in time
  posterior = 12      // chains of a posterior
};

class CounterStream {
 public:
  CounterStream(std::uint64_t seed, StreamPurpose purpose) : key_{{seed, static_cast<std::uint64_t>(purpose)}} {}

  // 64 bits at the place (a, b, c).
  std::uint64_t bits(std::uint64_t a, std::uint64_t b = 0, std::uint64_t c = 0) const {
    const r123::Philox4x64 philox;
    return philox({{a, b, c, 0}}, key_)[0];
  }
  // Uniform in (0, 1): neither end is ever reached.
  double uniform(std::uint64_t a, std::uint64_t b = 0, std::uint64_t c = 0) const { return to_unit(bits(a, b, c)); }
  // Below n, uniform to 2^-64 n.
  std::uint64_t below(std::uint64_t n, std::uint64_t a, std::uint64_t b = 0, std::uint64_t c = 0) const {
    __extension__ using Wide = unsigned __int128;
    return static_cast<std::uint64_t>((Wide{bits(a, b, c)} * n) >> 64);
  }

  // The upper 52 bits, and half of their last one.
  static double to_unit(std::uint64_t bits) { return (static_cast<double>(bits >> 12) + 0.5) * 0x1p-52; }

 private:
  r123::Philox4x64::key_type key_;
};

}  // namespace boresight
