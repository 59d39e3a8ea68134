// Draws from a density that may have several modes: Hamiltonian Monte Carlo within each temperature, swaps between neighbours.
//
// Several ladders run side by side, each from places of its own, so that their agreement can be judged (chain_diagnostics.hpp).
// Each has a chain at every exponent beta between a normal reference, from which the first draws afresh every time, and the target.
// Swaps go over even and odd pairs in turn, so that places travel rather than diffuse. Warm-up, in rounds of doubling length, finds the
// steps (Robbins and Monro 1951, for an acceptance of 0.8), the shape of each temperature's density and the ladder; then all of that
// stays, and every draw counts.
//
//   PosteriorSampler sampler(log_density, {.mean = m, .covariance = C});
//   const PosteriorSamples found = sampler.run({.draws = 1000});
//
// Syed, Bouchard-Cote, Deligiannidis, Doucet (2022), Journal of the Royal Statistical Society B 84, 321-350, algorithms 1 and 4;
// of a reference other than a prior Surjanovic, Syed, Bouchard-Cote, Campbell (2022), Parallel tempering with a variational
// reference, NeurIPS. The random numbers are functions of (seed, iteration, chain): any number of threads gives the same draws.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "boresight_analyses/posterior/hamiltonian_step.hpp"

namespace boresight {

// Wide enough to reach every mode that there may be: where it has next to no density no mode is found.
struct NormalReference {
  VecX mean;
  MatX covariance;  // positive definite
};

struct SamplerOptions {
  int chains = 4;        // ladders
  int temperatures = 8;  // the reference and the target among them
  int warm_up = 500;     // iterations
  int draws = 1000;      // of each ladder
  int thin = 1;          // iterations for one draw
  std::uint64_t seed = 1;
  int jobs = 1;
  // A first guess of the target's covariance; empty: that of the reference.
  MatX covariance = {};
  std::function<bool(double share, const std::string& stage)> progress = {};  // return false to stop
};

// What the sampler knows between two iterations: all that the next ones hang on.
struct SamplerState {
  int iteration = 0;
  std::vector<double> beta;
  std::vector<HamiltonianShape> shape;  // by temperature
  std::vector<ChainPlace> place;        // ladder by ladder, each from the reference on
  // Of the round under way.
  std::vector<double> log_step_sum;  // of its second half
  int in_round = 0;
  std::vector<double> acceptance, rejection;  // sums, of steps by temperature, of swaps between k and k + 1
  std::vector<VecX> sum;                      // by temperature
  std::vector<MatX> square;
  // Of places on their way: whether one comes from the reference, and how many arrived at the target from there.
  std::vector<int> from_reference;
  int restarts = 0;
  long evaluations = 0;
};

struct PosteriorSamples {
  std::vector<MatX> draws;  // by ladder: draws x dimensions
  std::vector<double> beta, acceptance, swap_rejection, step;
  double barrier = 0.0;  // communication_barrier()
  int restarts = 0;      // places that came from the reference to the target while draws were taken
  long evaluations = 0;  // of the density, warm-up included
  bool interrupted = false;
};

// A stretch of iterations as it is kept: the state after it, and the draws taken in it.
struct SamplerStretch {
  SamplerState state;
  std::vector<std::vector<VecX>> draws;  // by ladder
};
// Where stretches are kept as they are done, so that a run that was stopped goes on.
struct KeptStretches {
  std::function<std::optional<SamplerStretch>(int first_iteration)> find;
  std::function<void(int first_iteration, const SamplerStretch&)> keep;
};

class PosteriorSampler {
 public:
  // Throws std::domain_error where the reference's covariance is not positive definite.
  PosteriorSampler(SampledDensity target, NormalReference reference);
  PosteriorSampler(LogDensity target, NormalReference reference)
      : PosteriorSampler(SampledDensity{std::move(target), {}}, std::move(reference)) {}
  PosteriorSampler(const PosteriorSampler&) = delete;
  PosteriorSampler& operator=(const PosteriorSampler&) = delete;

  // Throws std::runtime_error where no place of the reference has any density.
  PosteriorSamples run(const SamplerOptions& options, const KeptStretches& kept = {}) const;

 private:
  struct Run;
  ChainPlace drawn_from_reference(const StepNumbers& numbers, std::uint64_t first_number) const;

  SampledDensity target_;  // in coordinates in which the reference is of zero mean and unit variance
  VecX mean_;
  MatX factor_;
};

}  // namespace boresight
