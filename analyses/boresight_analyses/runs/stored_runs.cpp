#include "boresight_analyses/runs/stored_runs.hpp"

#include <algorithm>
#include <chrono>
#include <string>

#include "boresight_analyses/threads/watcher.hpp"

namespace boresight {

bool store_runs(const SampleModel& model, std::size_t parameters, const ValuesOf& values_of,
                const std::vector<NumberRange>& numbers, SampleStore& store, const StoredRunsOptions& options) {
  using Clock = std::chrono::steady_clock;
  constexpr auto kCommitEvery = std::chrono::milliseconds(250);
  Watcher watcher(options.interrupted);
  std::atomic<bool>& stop = watcher.stop;
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
  if (whole && !numbers.empty())
    for (const NumberRange& gap : store.missing(numbers.back().end))
      for (const NumberRange& asked : numbers)
        if (gap.first < asked.end && asked.first < gap.end)
          throw StoreFailed(store.file().string() + " does not give back run " +
                            std::to_string(std::max(gap.first, asked.first)) +
                            ", which was stored in it; the same command computes it anew");
  return whole;
}

}  // namespace boresight
