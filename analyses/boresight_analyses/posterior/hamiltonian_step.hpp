// One step of Hamiltonian Monte Carlo: a trajectory of leapfrog steps of random number, accepted or not by what the energy has
// changed by. It leaves the density as it is, whatever step and shape are.
//
//   H(z, v) = -log pi(z) + v'v / 2,   z = A w:   v += e/2 A' grad log pi(z),  z += e A v,  v += e/2 A' grad log pi(z)
//
// with A A' near the covariance of pi, so that all directions are of like length. Neal (2011), MCMC using Hamiltonian dynamics,
// Handbook of Markov Chain Monte Carlo, sections 5.3.2 (random lengths) and 5.4.1 (the metric).
//
// The density is one of a path from a reference of zero mean and unit variance to the target:
//
//   log pi(z) = -(1 - beta) z'z / 2 + beta log p(z)
#pragma once

#include <cstdint>

#include "boresight_analyses/posterior/log_density.hpp"
#include "boresight_analyses/random/counter_stream.hpp"

namespace boresight {

// Where a chain is, with what is known of the target there.
struct ChainPlace {
  VecX z;
  double log_target = 0.0;  // log p
  VecX slope;               // of it, or of its guide

  // log p less the reference's log density.
  double log_ratio() const { return log_target + 0.5 * z.squaredNorm(); }
};

struct HamiltonianShape {
  double step = 1.0;
  MatX factor;  // A
};

// Random numbers of one chain's one step: uniform and normal ones, by their number.
class StepNumbers {
 public:
  StepNumbers(const CounterStream& stream, std::uint64_t iteration, std::uint64_t chain)
      : stream_(stream), iteration_(iteration), chain_(chain) {}
  double uniform(std::uint64_t k) const { return stream_.uniform(iteration_, chain_, k); }
  double normal(std::uint64_t k) const;

 private:
  const CounterStream& stream_;
  std::uint64_t iteration_, chain_;
};

// The place at z, with all that a step needs.
void see(const SampledDensity& target, ChainPlace& at, long& evaluations);

// Moves `at`, or leaves it. Returns the probability with which it was accepted. evaluations: of the exact density, counted up.
double hamiltonian_step(const SampledDensity& target, double beta, const HamiltonianShape& shape,
                        const StepNumbers& numbers, ChainPlace& at, long& evaluations);

}  // namespace boresight
