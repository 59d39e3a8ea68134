// Runs computed into a store: what every study with many runs does.
#pragma once

#include <functional>
#include <vector>

#include "boresight_analyses/runs/sample_store.hpp"
#include "boresight_analyses/runs/sampling.hpp"

namespace boresight {

struct StoredRunsOptions {
  int jobs = 1;
  std::function<void(std::span<const SampleRecord>)> landed = {};  // one thread at a time, after they are in the store
  std::function<bool()> interrupted = {};                          // asked many times a second, from any thread
};

// Computes the runs of these numbers and adds them to the store, committing four times a second and at the end. Returns
// false if it was interrupted; the store then holds what there is.
bool store_runs(const SampleModel& model, std::size_t parameters, const ValuesOf& values_of,
                const std::vector<NumberRange>& numbers, SampleStore& store, const StoredRunsOptions& options);

}  // namespace boresight
