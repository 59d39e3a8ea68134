// Computes the samples of some ranges of numbers, on several threads (oneTBB).
//
// Threads take the next few numbers in ascending order, as many as the model likes at once and as fit into about a second, so
// that at any time the samples not yet done are the last ones begun. A sample lands a tenth of a second after it is done, however
// long the others of its batch take. A sample's values and outcome depend on its number alone.
#pragma once

#include <atomic>
#include <functional>
#include <span>
#include <vector>

#include "boresight_analyses/random/random_inputs.hpp"
#include "boresight_analyses/random/sampling_design.hpp"
#include "boresight_analyses/runs/sample_store.hpp"

namespace boresight {

struct ParallelSampling {
  int jobs = 1;
  // Called with samples that are done, one thread at a time, in the order in which they are; samples that were not
  // reached are left out. Return false to take no further batch.
  std::function<bool(std::span<const SampleRecord>)> landed;
  // Set from outside: batches under way are cut short.
  const std::atomic<bool>* stop = nullptr;
};

// The values (SI) of the parameters of one sample, from its number.
using ValuesOf = std::function<void(std::uint64_t, std::span<double>)>;

// Returns true if every sample was reached. What `landed` throws ends the sampling and is thrown on.
bool compute_samples(const SampleModel& model, const RandomInputs& inputs, const SamplingDesign& design,
                     const std::vector<NumberRange>& ranges, const ParallelSampling& options);
bool compute_samples(const SampleModel& model, std::size_t parameters, const ValuesOf& values_of,
                     const std::vector<NumberRange>& ranges, const ParallelSampling& options);

}  // namespace boresight
