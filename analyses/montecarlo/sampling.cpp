#include "boresight_analyses/montecarlo/sampling.hpp"

#include <tbb/global_control.h>
#include <tbb/task_arena.h>
#include <tbb/task_group.h>

#include <algorithm>
#include <exception>
#include <mutex>

#include "boresight_analyses/study/portion.hpp"

namespace boresight {
namespace {

// Hands out the numbers of the ranges, ascending, a few at a time and never across two ranges.
class Numbers {
 public:
  explicit Numbers(const std::vector<NumberRange>& ranges) : ranges_(ranges) {
    for (const NumberRange& range : ranges) left_ += range.size();
  }

  NumberRange next(std::uint64_t batch, int workers) {
    const std::scoped_lock lock(mutex_);
    const std::uint64_t most = portion(batch, left_, workers);
    while (range_ < ranges_.size() && at_ >= ranges_[range_].size()) {
      ++range_;
      at_ = 0;
    }
    if (range_ == ranges_.size()) return {};
    const std::uint64_t first = ranges_[range_].first + at_;
    const std::uint64_t end = std::min(first + most, ranges_[range_].end);
    at_ += end - first;
    left_ -= end - first;
    return {first, end};
  }

 private:
  const std::vector<NumberRange>& ranges_;
  std::mutex mutex_;
  std::size_t range_ = 0;
  std::uint64_t at_ = 0, left_ = 0;
};

}  // namespace

bool compute_samples(const SampleModel& model, const RandomInputs& inputs, const Design& design,
                     const std::vector<NumberRange>& ranges, const SamplingOptions& options) {
  const ValuesOf values_of = [&](std::uint64_t number, std::span<double> values) {
    design.point(number, values);
    inputs.values(values);
  };
  return compute_samples(model, inputs.size(), values_of, ranges, options);
}

bool compute_samples(const SampleModel& model, std::size_t parameters, const ValuesOf& values_of,
                     const std::vector<NumberRange>& ranges, const SamplingOptions& options) {
  Numbers numbers(ranges);
  std::mutex landing;
  std::atomic<bool> no_more{false}, all_reached{true};
  std::exception_ptr fault;
  const std::atomic<bool> never{false};
  const std::atomic<bool>& stop = options.stop != nullptr ? *options.stop : never;

  const int jobs = std::max(1, options.jobs);
  const auto work = [&] {
    std::vector<SampleRecord> records;
    std::vector<Sample> samples;
    std::vector<Outcome> outcomes;
    while (!no_more && !stop) {
      const NumberRange batch = numbers.next(model.batch(), jobs);
      if (batch.size() == 0) return;
      const std::size_t n = batch.size();
      records.assign(n, {});
      samples.resize(n);
      outcomes.assign(n, {});
      for (std::size_t k = 0; k < n; ++k) {
        records[k].number = batch.first + k;
        records[k].inputs.resize(parameters);
        values_of(records[k].number, records[k].inputs);
        samples[k] = {records[k].number, records[k].inputs};
      }
      try {
        model.evaluate(samples, outcomes, stop);
        std::size_t kept = 0;
        for (std::size_t k = 0; k < n; ++k) {
          if (outcomes[k].status == Outcome::Status::not_reached) continue;
          records[k].outcome = std::move(outcomes[k]);
          if (kept != k) records[kept] = std::move(records[k]);
          ++kept;
        }
        if (kept < n) all_reached = false;
        const std::scoped_lock lock(landing);
        if (kept > 0 && !fault && !options.landed({records.data(), kept})) no_more = true;
      } catch (...) {
        const std::scoped_lock lock(landing);
        if (!fault) fault = std::current_exception();
        no_more = true;
      }
    }
  };

  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(jobs));
  tbb::task_arena arena(jobs);
  arena.execute([&] {
    tbb::task_group group;
    for (int j = 1; j < jobs; ++j) group.run(work);
    work();
    group.wait();
  });
  if (fault) std::rethrow_exception(fault);
  return all_reached && numbers.next(1, 1).size() == 0;
}

}  // namespace boresight
