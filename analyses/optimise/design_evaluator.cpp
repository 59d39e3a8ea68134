#include "boresight_analyses/optimise/design_evaluator.hpp"

#include <tbb/global_control.h>
#include <tbb/task_arena.h>
#include <tbb/task_group.h>

#include <algorithm>
#include <chrono>
#include <mutex>
#include <thread>

#include "boresight_analyses/random/design.hpp"

namespace boresight {

DesignEvaluator::DesignEvaluator(const SampleModel& model, const RandomInputs* inputs, EvaluationStore* store,
                                 Options options)
    : model_(model), inputs_(inputs), store_(store), options_(std::move(options)) {}

const std::vector<Outcome>& DesignEvaluator::at(std::span<const double> design) {
  const std::vector<double> key(design.begin(), design.end());
  if (const auto found = seen_.find(key); found != seen_.end()) return found->second;
  if (store_ != nullptr)
    if (const auto* known = store_->find(design, options_.samples)) {
      ++reused_;
      return seen_[key] = *known;
    }

  const std::size_t scattered = inputs_ != nullptr ? inputs_->size() : 0, n = options_.samples;
  std::vector<std::vector<double>> values(n, key);
  if (scattered > 0) {
    const Design points({.kind = DesignKind::random, .seed = options_.seed}, static_cast<int>(scattered));
    std::vector<double> point(scattered);
    for (std::size_t k = 0; k < n; ++k) {
      points.point(k, point);
      inputs_->values(point);
      values[k].insert(values[k].end(), point.begin(), point.end());
    }
  }
  std::vector<Outcome> outcomes(n);
  std::atomic<bool> stop{false};
  std::atomic<std::size_t> next{0};
  std::mutex mutex;
  std::exception_ptr fault;
  const auto work = [&] {
    const std::size_t most = std::max<std::size_t>(1, model_.batch());
    for (;;) {
      const std::size_t first = next.fetch_add(most), end = std::min(n, first + most);
      if (first >= n || stop) return;
      std::vector<Sample> samples;
      for (std::size_t k = first; k < end; ++k) samples.push_back({k, values[k]});
      try {
        model_.evaluate(samples, {outcomes.data() + first, end - first}, stop);
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
        if (options_.interrupted && options_.interrupted()) stop = true;
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
      }
    });
    const int jobs = std::max(1, options_.jobs);
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(jobs));
    tbb::task_arena arena(jobs);
    arena.execute([&] {
      tbb::task_group group;
      for (int j = 1; j < jobs; ++j) group.run(work);
      work();
      group.wait();
    });
  }
  if (fault) std::rethrow_exception(fault);
  for (const Outcome& outcome : outcomes) {
    if (outcome.status == Outcome::Status::not_reached) throw EvaluationInterrupted{};
    cpu_seconds_ += outcome.cpu_seconds;
  }
  ++computed_;
  if (store_ != nullptr) store_->add(design, outcomes);
  const std::vector<Outcome>& kept = seen_[key] = std::move(outcomes);
  if (options_.landed) options_.landed();
  return kept;
}

}  // namespace boresight
