#include "boresight_analyses/runs/model_samples.hpp"

#include <algorithm>
#include <boost/math/special_functions/erf.hpp>
#include <cmath>
#include <limits>

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

BatchModel on_normal_space(const SampleModel& model, const RandomInputs& inputs, const MethodOptions& options,
                           std::shared_ptr<std::vector<double>> cost) {
  return [&model, &inputs, options, cost](const Points& points) {
    std::vector<double> values(points.size(), std::numeric_limits<double>::quiet_NaN());
    Watcher watcher(options.interrupted);
    const bool whole = compute_samples(model, inputs.size(),
                                       [&](std::uint64_t number, std::span<double> at) {
                                         for (std::size_t i = 0; i < at.size(); ++i)
                                           at[i] = unit_of_normal(points[number][i]);
                                         inputs.values(at);
                                       },
                                       {{0, points.size()}},
                                       {.jobs = options.jobs,
                                        .landed =
                                            [&](std::span<const SampleRecord> records) {
                                              double spent = 0.0;
                                              for (const SampleRecord& r : records) {
                                                if (r.outcome.status == Outcome::Status::done)
                                                  values[r.number] = r.outcome.value;
                                                if (r.outcome.status == Outcome::Status::failed && options.failed)
                                                  options.failed(r.number, r.outcome);
                                                cost->push_back(r.outcome.cpu_seconds);
                                                spent += r.outcome.cpu_seconds;
                                              }
                                              if (options.progress) options.progress(spent);
                                              return !watcher.stop;
                                            },
                                        .stop = &watcher.stop});
    if (!whole) throw MethodInterrupted{};
    return values;
  };
}

}  // namespace boresight
