// Monte Carlo: the samples of a plan, computed over threads and ranks into a store, from wherever the store stands.
//
// Which samples a study holds when it ends by their number or by an interval's width depends on the plan alone, not on
// threads, ranks, or how often it was resumed: widths are judged only at fixed numbers of samples (growing by half),
// when all up to there are in, by an interval that holds at all of them (looks.hpp). A limit on time ends it where it stands.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "boresight_analyses/montecarlo/montecarlo_plan.hpp"
#include "boresight_analyses/runs/ranks.hpp"
#include "boresight_analyses/runs/sample_store.hpp"
#include "boresight_analyses/statistics/running.hpp"

namespace boresight {

struct MonteCarloProgress {
  std::uint64_t done = 0, total = 0;  // samples, those found in the store included
  std::uint64_t begun_with = 0;       // found in the store
  std::uint64_t failed = 0;
  const RunningQuantiles* running = nullptr;
};

struct MonteCarloOptions {
  std::filesystem::path folder;              // samples.db, and samples.RANK.db while other ranks compute
  std::map<std::string, std::string> facts;  // name the study: see SampleStore
  int jobs = 1;
  std::function<void(const MonteCarloProgress&)> progress;  // on rank 0, one thread at a time, after every batch
  std::function<bool()> interrupted;                        // looked at many times a second
  // On rank 0, each sample that MonteCarloResult::values tells of, in order, as it is read back from the store at the end.
  std::function<void(const SampleRecord&)> read_back = {};
};

enum class Ended { samples, width, time, interrupted };
const char* to_string(Ended ended);

struct MonteCarloResult {  // on rank 0
  Ended ended = Ended::samples;
  std::vector<double> values;  // of samples 0, 1, ... up to the first that is missing; NaN: failed
  std::uint64_t stored = 0;    // in the store, beyond a missing one too
};

// Numbers of samples at which an interval's width is judged, the last one being plan.samples.
std::vector<std::uint64_t> stopping_points(const MonteCarloPlan& plan);

// Merges the stores that lost ranks left in the folder.
void merge_shards(SampleStore& store, const std::filesystem::path& folder);

// `store`: on rank 0; elsewhere nullptr.
MonteCarloResult run_montecarlo(const SampleModel& model, const MonteCarloPlan& plan, SampleStore* store, Ranks& ranks,
                                const MonteCarloOptions& options);

}  // namespace boresight
