#include "boresight_analyses/montecarlo/stored_runs.hpp"

#include <chrono>

namespace boresight {

bool store_runs(const SampleModel& model, std::size_t parameters, const ValuesOf& values_of,
                const std::vector<NumberRange>& numbers, SampleStore& store, const StoredRunsOptions& options) {
  using Clock = std::chrono::steady_clock;
  constexpr auto kCommitEvery = std::chrono::milliseconds(250);
  std::atomic<bool> stop{false};
  auto next_commit = Clock::now() + kCommitEvery;
  const auto landed = [&](std::span<const SampleRecord> records) {
    for (const SampleRecord& record : records) store.add(record);
    if (Clock::now() >= next_commit) {
      store.commit();
      next_commit = Clock::now() + kCommitEvery;
    }
    if (options.landed) options.landed(records);
    if (options.interrupted && options.interrupted()) stop = true;
    return !stop;
  };
  const bool whole =
      compute_samples(model, parameters, values_of, numbers, {.jobs = options.jobs, .landed = landed, .stop = &stop});
  store.commit();
  return whole;
}

}  // namespace boresight
