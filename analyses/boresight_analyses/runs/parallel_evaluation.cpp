#include "boresight_analyses/runs/parallel_evaluation.hpp"

#include <algorithm>
#include <mutex>

#include "boresight_analyses/threads/on_threads.hpp"
#include "boresight_analyses/threads/portion.hpp"
#include "boresight_analyses/threads/watcher.hpp"

namespace boresight {

std::vector<Outcome> evaluate_all(const SampleModel& model, const std::vector<std::vector<double>>& values,
                                  const ParallelEvaluation& options) {
  const std::size_t n = values.size();
  std::vector<Outcome> outcomes(n);
  Watcher watcher(options.interrupted);
  std::atomic<bool>& stop = watcher.stop;
  std::size_t next = 0;
  std::mutex mutex;
  std::atomic<bool> failed{false};  // what landed after a fault may not be whole
  const auto work = [&] {
    for (;;) {
      std::size_t first, end;
      {
        const std::scoped_lock lock(mutex);
        first = next;
        next = end = std::min(n, first + portion(model.batch(), n - first, options.jobs));
      }
      if (first >= n || stop) return;
      std::vector<Sample> samples;
      for (std::size_t k = first; k < end; ++k) samples.push_back({k, values[k]});
      model.evaluate(samples, {outcomes.data() + first, end - first}, stop);
      const std::scoped_lock lock(mutex);
      if (failed) return;
      for (std::size_t k = first; k < end; ++k)
        if (options.landed && outcomes[k].status != Outcome::Status::not_reached) options.landed(k, outcomes[k]);
    }
  };
  on_threads(options.jobs, work, [&] { failed = stop = true; });
  for (const Outcome& outcome : outcomes)
    if (outcome.status == Outcome::Status::not_reached) throw EvaluationInterrupted{};
  return outcomes;
}

}  // namespace boresight
