#include "boresight_analyses/tails/tail_proposal.hpp"

#include <cmath>

namespace boresight {

TailProposal tail_proposal(const BatchModel& model, int dimensions, double limit, const ProposalOptions& options) {
  TailProposal result{subset_simulation(model, dimensions, limit, options.subset), GaussianMixture(dimensions), 0};
  result.evaluations = result.subset.evaluations;
  if (!result.subset.reached) return result;
  const std::uint64_t seed = options.subset.seed;
  result.mixture =
      GaussianMixture(result.subset.beyond, {}, options.components, seed).defended(options.defensive_share);
  const CounterStream stream(seed, StreamPurpose::proposal);
  for (int round = 0; round < options.rounds; ++round) {
    // Sets from the top down: the estimates count theirs from zero.
    const WeightedDraws drawn =
        weighted_draws(result.mixture, stream, ~0ull - 1 - static_cast<std::uint64_t>(round), 0, options.samples);
    const std::vector<double> values = model(drawn.points);
    result.evaluations += options.samples;
    Points beyond;
    std::vector<double> weights;
    for (std::size_t k = 0; k < values.size(); ++k) {
      if (std::isfinite(values[k]) && !(values[k] > limit)) continue;
      beyond.push_back(drawn.points[k]);
      weights.push_back(drawn.weights[k]);
    }
    if (beyond.empty()) break;
    result.mixture = GaussianMixture(beyond, weights, options.components, seed).defended(options.defensive_share);
  }
  return result;
}

}  // namespace boresight
