// Where to draw for a tail: subset simulation finds the excess, a mixture is fitted to it, and sharpened by its own weighted
// draws (cross-entropy: Rubinstein, Kroese 2004; for mixtures Kurtz, Song 2013). All on the cheap model.
#pragma once

#include "boresight_analyses/tails/gaussian_mixture.hpp"
#include "boresight_analyses/tails/subset_simulation.hpp"

namespace boresight {

struct ProposalOptions {
  SubsetOptions subset;
  int components = 3;
  int rounds = 2;      // of sharpening
  int samples = 2000;  // of a round
  // Of the standard normal. Half: the points that it draws are what an excess is held against that the search has not
  // found, and bounds that hold wherever it lies are as much wider as this is smaller; the estimate's variance is at most
  // doubled by it.
  double defensive_share = 0.5;
};

struct TailProposal {
  SubsetResult subset;
  GaussianMixture mixture;  // the standard normal itself where the limit was not reached
  std::int64_t evaluations = 0;
};

TailProposal tail_proposal(const BatchModel& model, int dimensions, double limit, const ProposalOptions& options);

}  // namespace boresight
