#include "boresight_analyses/runs/sampling.hpp"

#include <algorithm>
#include <chrono>
#include <mutex>

#include "boresight_analyses/threads/on_threads.hpp"
#include "boresight_analyses/threads/portion.hpp"

namespace boresight {
namespace {

// Hands out the numbers of the ranges, ascending, a few at a time and never across two ranges.
class NumbersInRanges {
 public:
  explicit NumbersInRanges(const std::vector<NumberRange>& ranges) : ranges_(ranges) {
    for (const NumberRange& range : ranges) left_ += range.size();
  }

  // wanted: no more than this at once.
  NumberRange next(std::uint64_t batch, int workers, std::uint64_t wanted) {
    const std::scoped_lock lock(mutex_);
    const std::uint64_t most = std::min(portion(batch, left_, workers), wanted);
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

// How many samples to take next, so that a batch lasts about a second: a short motion fills whole batches, a long one or one
// whose scene takes long to prepare comes a few at a time.
class BatchSize {
 public:
  explicit BatchSize(std::uint64_t liked)
      : most_(std::max<std::uint64_t>(1, liked)), least_(std::min<std::uint64_t>(most_, 16)) {
    size_ = std::min<std::uint64_t>(most_, 64);
  }
  std::uint64_t size() const { return size_; }
  void took(std::uint64_t samples, double seconds) {
    constexpr double kSeconds = 1.0, kMostGrowth = 4.0;
    const double wanted = static_cast<double>(samples) * std::min(kMostGrowth, kSeconds / std::max(seconds, 1e-9));
    size_ = std::clamp(static_cast<std::uint64_t>(wanted), least_, most_);
  }

 private:
  std::uint64_t most_, least_, size_;
};

}  // namespace

bool compute_samples(const SampleModel& model, const RandomInputs& inputs, const SamplingDesign& design,
                     const std::vector<NumberRange>& ranges, const ParallelSampling& options) {
  const ValuesOf values_of = [&](std::uint64_t number, std::span<double> values) {
    design.point(number, values);
    inputs.values(values);
  };
  return compute_samples(model, inputs.size(), values_of, ranges, options);
}

bool compute_samples(const SampleModel& model, std::size_t parameters, const ValuesOf& values_of,
                     const std::vector<NumberRange>& ranges, const ParallelSampling& options) {
  NumbersInRanges numbers(ranges);
  std::mutex landing;
  std::atomic<bool> no_more{false}, failed{false}, all_reached{true};
  const std::atomic<bool> never{false};
  const std::atomic<bool>& stop = options.stop != nullptr ? *options.stop : never;

  const int jobs = std::max(1, options.jobs);
  const auto work = [&] {
    using Clock = std::chrono::steady_clock;
    constexpr std::chrono::milliseconds kLandEvery{100};
    std::vector<SampleRecord> records, done;
    std::vector<Sample> samples;
    std::vector<Outcome> outcomes;
    BatchSize size(model.batch());
    Clock::time_point landed = Clock::now();
    const auto land = [&] {
      landed = Clock::now();
      if (done.empty()) return;
      const std::scoped_lock lock(landing);
      if (!failed && !options.landed(done)) no_more = true;
      done.clear();
    };
    while (!no_more && !stop) {
      const NumberRange batch = numbers.next(model.batch(), jobs, size.size());
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
      const Clock::time_point begun = Clock::now();
      std::size_t reached = 0;
      model.evaluate_each(samples, outcomes, stop, [&](std::size_t k) {
        ++reached;
        SampleRecord& record = done.emplace_back();
        record.number = records[k].number;
        record.inputs = records[k].inputs;
        record.outcome = std::move(outcomes[k]);
        if (Clock::now() - landed > kLandEvery) land();
      });
      land();
      if (reached < n) all_reached = false;
      size.took(n, std::chrono::duration<double>(Clock::now() - begun).count());
    }
  };

  on_threads(jobs, work, [&] { failed = no_more = true; });
  return all_reached && numbers.next(1, 1, 1).size() == 0;
}

}  // namespace boresight
