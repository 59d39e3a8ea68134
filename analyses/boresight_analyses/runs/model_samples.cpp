#include "boresight_analyses/runs/model_samples.hpp"

#include <algorithm>
#include <boost/math/special_functions/erf.hpp>
#include <chrono>
#include <cmath>
#include <limits>
#include <map>

#include "boresight_analyses/runs/stored_runs.hpp"
#include "boresight_analyses/threads/watcher.hpp"

namespace boresight {
namespace {

double unit_of_normal(double u) {
  // Quantile functions want the open interval.
  constexpr double kLeast = std::numeric_limits<double>::min(), kMost = 1.0 - 0x1p-53;
  return std::clamp(0.5 * boost::math::erfc(-u / std::sqrt(2.0)), kLeast, kMost);
}

}  // namespace

double median(std::vector<double> values) {
  if (values.empty()) return 0.0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

std::vector<double> as_large_as_may_be(std::vector<double> values, const std::vector<double>& model_errors,
                                       double steps) {
  const double alike = std::isfinite(steps) ? steps : 0.0;
  for (std::size_t k = 0; k < values.size(); ++k) {
    const double own = k < model_errors.size() && std::isfinite(model_errors[k]) ? model_errors[k] : 0.0;
    values[k] += (alike + own) * std::abs(values[k]);
  }
  return values;
}

void complete_samples(const SampleModel& model, const RandomInputs& inputs, const SamplingDesign& design,
                      const NumberRange& range, SampleStore& store, const MethodOptions& options) {
  std::vector<NumberRange> missing;
  for (NumberRange r : store.missing(range.end)) {
    r.first = std::max(r.first, range.first);
    if (r.first < r.end) missing.push_back(r);
  }
  const ValuesOf values_of = [&](std::uint64_t number, std::span<double> values) {
    design.point(number, values);
    inputs.values(values);
  };
  const auto landed = [&](std::span<const SampleRecord> records) {
    double cost = 0.0;
    for (const SampleRecord& r : records) cost += r.outcome.cpu_seconds;
    if (options.progress) options.progress(cost);
  };
  const bool whole = store_runs(model, inputs.size(), values_of, missing, store,
                                {.jobs = options.jobs, .landed = landed, .interrupted = options.interrupted});
  if (!whole) throw MethodInterrupted{};
}

StoredValues stored_values(const SampleStore& store, const NumberRange& range) {
  StoredValues result;
  std::vector<double> costs;
  double done = 0.0;
  store.read(range.end, [&](const SampleRecord& r) {
    if (r.number < range.first) return;
    const bool good = r.outcome.status == Outcome::Status::done;
    result.failures.see(r.number, r.outcome);
    result.values.push_back(good ? r.outcome.value : std::numeric_limits<double>::quiet_NaN());
    result.model_errors.push_back(good ? r.outcome.model_error : 0.0);
    costs.push_back(r.outcome.cpu_seconds);
    result.spent += r.outcome.cpu_seconds;
    if (!good) return;
    done += 1.0;
    result.model += r.outcome.model_error;
  });
  if (done > 0.0) result.model /= done;
  result.typical_cost = median(std::move(costs));
  return result;
}

namespace {

// The points that a method asks for, one batch after the other.
class AskedPoints {
 public:
  AskedPoints(const SampleModel& model, const RandomInputs& inputs, MethodOptions options,
              std::shared_ptr<std::vector<double>> cost, SampleStore* store)
      : model_(model), inputs_(inputs), options_(std::move(options)), cost_(std::move(cost)), store_(store) {
    if (store_ == nullptr) return;
    store_->read(~std::uint64_t{0} >> 1, [&](const SampleRecord& record) { known_[record.number] = record; });
  }

  std::vector<double> values(const Points& points) {
    const std::uint64_t first = asked_;
    asked_ += points.size();
    const auto values_of = [&](std::uint64_t number, std::span<double> at) {
      const Point& point = points[number - first];
      for (std::size_t i = 0; i < at.size(); ++i) at[i] = unit_of_normal(point[i]);
      inputs_.values(at);
    };
    std::vector<Outcome> outcomes(points.size());
    const std::vector<NumberRange> missing = take_known(first, values_of, outcomes);
    Watcher watcher(options_.interrupted);
    const auto landed = [&](std::span<const SampleRecord> records) {
      for (const SampleRecord& record : records) {
        if (store_ != nullptr) store_->add(record);
        outcomes[record.number - first] = record.outcome;
      }
      commit_now_and_then();
      tell(records);
      return !watcher.stop;
    };
    const bool whole = compute_samples(model_, inputs_.size(), values_of, missing,
                                       {.jobs = options_.jobs, .landed = landed, .stop = &watcher.stop});
    if (!whole) {
      if (store_ != nullptr) store_->commit();
      throw MethodInterrupted{};
    }
    std::vector<double> values;
    for (std::size_t k = 0; k < outcomes.size(); ++k) {
      const bool done = outcomes[k].status == Outcome::Status::done;
      values.push_back(done ? outcomes[k].value : std::numeric_limits<double>::quiet_NaN());
      if (outcomes[k].status == Outcome::Status::failed && options_.failed) options_.failed(k, outcomes[k]);
      if (options_.answered) options_.answered(outcomes[k]);
    }
    return values;
  }

 private:
  using Clock = std::chrono::steady_clock;

  // Returns the numbers of those that are not.
  std::vector<NumberRange> take_known(std::uint64_t first, const ValuesOf& values_of, std::vector<Outcome>& outcomes) {
    std::vector<NumberRange> missing;
    std::vector<double> at(inputs_.size());
    std::vector<SampleRecord> found;
    for (std::uint64_t number = first; number < first + outcomes.size(); ++number) {
      const auto known = known_.find(number);
      if (known == known_.end()) {
        if (missing.empty() || missing.back().end != number) missing.push_back({number, number});
        ++missing.back().end;
        continue;
      }
      values_of(number, at);
      if (at != known->second.inputs)
        throw StoreRefused(store_->file().string() + " holds other points than are asked for now; remove it");
      outcomes[number - first] = known->second.outcome;
      found.push_back(std::move(known->second));
      known_.erase(known);
    }
    if (!found.empty()) tell(found);
    return missing;
  }

  void tell(std::span<const SampleRecord> records) {
    double spent = 0.0;
    for (const SampleRecord& r : records) {
      cost_->push_back(r.outcome.cpu_seconds);
      spent += r.outcome.cpu_seconds;
    }
    if (options_.progress) options_.progress(spent);
  }

  void commit_now_and_then() {
    constexpr auto kCommitEvery = std::chrono::milliseconds(250);
    if (store_ == nullptr || Clock::now() < next_commit_) return;
    store_->commit();
    next_commit_ = Clock::now() + kCommitEvery;
  }

  const SampleModel& model_;
  const RandomInputs& inputs_;
  MethodOptions options_;
  std::shared_ptr<std::vector<double>> cost_;
  SampleStore* store_;
  std::map<std::uint64_t, SampleRecord> known_;
  std::uint64_t asked_ = 0;
  Clock::time_point next_commit_ = Clock::now();
};

}  // namespace

BatchModel on_normal_space(const SampleModel& model, const RandomInputs& inputs, const MethodOptions& options,
                           std::shared_ptr<std::vector<double>> cost, SampleStore* store) {
  return [asked = std::make_shared<AskedPoints>(model, inputs, options, std::move(cost), store)](const Points& points) {
    return asked->values(points);
  };
}

}  // namespace boresight
