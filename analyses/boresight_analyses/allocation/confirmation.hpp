// Fresh samples of one set of fits or tolerances on the rung that confirms, and what they show.
//
// A search may ask for several confirmations before one holds, and each set is chosen by what the earlier ones
// said. So every confirmation draws samples that no choice has seen, from a seed of its own, and takes an equal
// part of the risk: with at most m of them each speaks at confidence 1 - (1 - confidence) / m, and the chance
// that any of them calls a set good that is not stays below 1 - confidence (Bonferroni; Dunn 1961, J. Am. Stat.
// Assoc. 56).
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "boresight_analyses/allocation/gap_requirements.hpp"
#include "boresight_analyses/montecarlo/montecarlo_plan.hpp"
#include "boresight_analyses/study/sample_model.hpp"

namespace boresight {

constexpr int kMostRounds = 4;                       // of search and confirmation
constexpr int kMostConfirmations = kMostRounds + 2;  // and of the sets with the least index, before "infeasible"

// Of each confirmation, so that all together keep the requirement's.
double confirmation_confidence(const Requirement& requirement);

struct AllocationConfirmation {
  std::string rung;
  std::uint64_t seed = 0;
  std::size_t samples = 0, failed = 0;
  double confidence = 0.0;  // of this one
  double factor = 1.0;      // index of the rung over that of the linear deviation, when this set was searched for
  double price = 0.0;
  double model_error =
      0.0;  // what the rung thinks it leaves out, relative: mean over the samples, each counted as larger by its own
  double reached = 0.0;                        // the least limit that these samples show
  double share_within = 0.0, share_low = 0.0;  // and the lower bound at `confidence`
  bool met = false, agrees = false;
  std::string sentence;
};

// The outcomes of the confirming rung at these gaps, [sample][joint] in m; `others`: coordinates in (0, 1) of the
// other random parameters, [sample][parameter], of the same design as the gaps.
using ConfirmingModel = std::function<std::vector<Outcome>(const std::vector<std::vector<double>>& gaps,
                                                           const std::vector<std::vector<double>>& others)>;

// The seed of confirmation `number` (from 0) of a search with this seed.
std::uint64_t confirmation_seed(std::uint64_t seed, std::size_t number);

// The values of these outcomes, each as large as what its rung leaves out may make it; a failed one is above everything.
std::vector<double> values_of(const std::vector<Outcome>& outcomes);

// The mean of what their rung leaves out, relative.
double model_error_of(const std::vector<Outcome>& outcomes);

// The least limit that these values show to be kept: the largest of them but the allowed ones.
double shown_limit(std::vector<double> values, double probability, double confidence);

// What these values say of a requirement at `confidence`; `reached`, `share_within`, `share_low`, `met`.
AllocationConfirmation confirmation_of(const std::vector<double>& values, const Requirement& requirement,
                                       double confidence);

}  // namespace boresight
