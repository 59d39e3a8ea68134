// What a Monte Carlo study is to do, as the [montecarlo] table of a study file says it:
//
//   [montecarlo]
//   samples = 10000
//   seed = 1
//   design = "random"            # lhs, sobol
//   strata = 100                 # lhs: points per hypercube; replicates = 16 # sobol: nets (see random/sampling_design.hpp)
//   confidence = 0.95            # of all intervals
//   requirement = { limit = "0.25 mm", probability = 0.9973, confidence = 0.95 }
//   fidelities = { models = ["multibody", "perturbation", "quasistatic"], budget = "2 min", pilot = 50 }
//                                # the mean for the first rung, most samples on the cheaper ones; CPU time, pilot included
//   tail = { cheap = "perturbation", exact = "multibody", budget = "2 min", pilot = 50 }
//                                # the probability of exceeding the requirement's limit where it is rare
//   stop = { width = "2 %", of = "p99.73", time = "10 min" }    # or earlier: half-width of an interval, or wall time
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "boresight_analyses/random/random_inputs.hpp"
#include "boresight_analyses/random/sampling_design.hpp"
#include "boresight_analyses/study/study.hpp"

namespace boresight {

struct Requirement {
  double limit = 0.0;         // of the index, SI
  double probability = 0.95;  // with which the index is to stay at or below the limit
  double confidence = 0.95;   // one-sided, that it does
  std::string unit = "";      // in which the study writes the limit: "arcsec"
};

struct StopRule {
  double width = 0.0;         // half-width of the interval over the estimate; 0: no such rule
  std::string of = "p99.73";  // among headline_names()
  double seconds = 0.0;       // wall time; 0: no such rule
};

// Several rungs at once: fidelities/fidelity_plan.hpp.
struct FidelityQuestion {
  std::vector<std::string> models;  // rungs; the first is the one to be unbiased for
  double budget = 0.0;              // CPU seconds, the pilot's included
  std::uint64_t pilot = 50;         // samples on every model
};

// A rare excess: tails/tail_estimate.hpp.
struct TailQuestion {
  std::string cheap, exact;  // rungs
  double budget = 0.0;       // CPU seconds of the estimate, after search and pilot
  std::uint64_t pilot = 50;  // samples on both, twice
};

struct MonteCarloPlan {
  std::uint64_t samples = 0;
  bool samples_of_budget = false;          // `samples` was given, where fidelities or tail decide how many there are
  bool confidence_of_requirement = false;  // `confidence` was given beside tail, whose intervals have the requirement's
  SamplingOptions design;
  double confidence = 0.95;
  std::optional<Requirement> requirement;
  StopRule stop;
  std::optional<FidelityQuestion> fidelities;
  std::optional<TailQuestion> tail;
  RandomInputs inputs;

  // What decides the value of sample k, but for mechanism and rung: how many samples there are, what is asked of them
  // and when to stop are not part of it, so that a study may be continued with more.
  std::string sample_text(const Study& study) const;
};

inline constexpr std::uint64_t kMostMonteCarloSamples = 4'000'000'000;

// The estimates that every study reports: mean, sd, p50, p95, p99, p99.73.
struct Headline {
  const char* name;
  double probability;  // of a quantile; 0 for mean and sd
};
const std::vector<Headline>& headlines();

// The table { limit = .., probability = .., confidence = .. }. Throws InputError.
Requirement read_requirement(Cursor table, const Study& study);

// Throws InputError. `accepts`: see read_random_inputs.
MonteCarloPlan read_montecarlo_plan(Cursor& root, const Study& study, const MechanismDescription& mechanism,
                                    const std::function<void(const Setting&)>& accepts);

}  // namespace boresight
