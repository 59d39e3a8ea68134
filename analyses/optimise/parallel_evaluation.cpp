#include "boresight_analyses/optimise/parallel_evaluation.hpp"

#include <tbb/global_control.h>
#include <tbb/task_arena.h>
#include <tbb/task_group.h>

#include <algorithm>
#include <chrono>
#include <exception>
#include <mutex>
#include <thread>

#include "boresight_analyses/study/portion.hpp"

namespace boresight {

std::vector<Outcome> evaluate_all(const SampleModel& model, const std::vector<std::vector<double>>& values,
                                  const ParallelEvaluation& options) {
  const std::size_t n = values.size();
  std::vector<Outcome> outcomes(n);
  std::atomic<bool> stop{false};
  std::size_t next = 0;
  std::mutex mutex;
  std::exception_ptr fault;
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
      try {
        model.evaluate(samples, {outcomes.data() + first, end - first}, stop);
        const std::scoped_lock lock(mutex);
        for (std::size_t k = first; k < end; ++k)
          if (options.landed && !fault && outcomes[k].status != Outcome::Status::not_reached)
            options.landed(k, outcomes[k]);
      } catch (...) {
        const std::scoped_lock lock(mutex);
        if (!fault) fault = std::current_exception();
        stop = true;
      }
    }
  };
  {
    const std::jthread watcher([&](const std::stop_token& end) {
      while (!end.stop_requested() && !stop) {
        if (options.interrupted && options.interrupted()) stop = true;
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
      }
    });
    const int jobs = std::max(1, options.jobs);
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                    static_cast<std::size_t>(jobs));
    tbb::task_arena arena(jobs);
    arena.execute([&] {
      tbb::task_group group;
      for (int j = 1; j < jobs; ++j) group.run(work);
      work();
      group.wait();
    });
  }
  if (fault) std::rethrow_exception(fault);
  for (const Outcome& outcome : outcomes)
    if (outcome.status == Outcome::Status::not_reached) throw EvaluationInterrupted{};
  return outcomes;
}

}  // namespace boresight
