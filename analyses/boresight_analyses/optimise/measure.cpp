#include "boresight_analyses/optimise/measure.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "boresight_analyses/statistics/independent_samples.hpp"

namespace boresight {

const std::vector<MeasureName>& measure_names() {
  static const std::vector<MeasureName> all = {
      {Measure::index, "index", "index", ""},
      {Measure::free_flight_share, "free_flight_share", "share of time in free flight", "1"},
      {Measure::impacts_per_second, "impacts_per_second", "impacts per second", "Hz"},
      {Measure::peak_acceleration, "peak_acceleration", "peak acceleration", "m/s^2"}};
  return all;
}

const std::vector<OverName>& over_names() {
  static const std::vector<OverName> all = {
      {Over::nominal, "nominal"}, {Over::mean, "mean"}, {Over::quantile, "quantile"}, {Over::worst, "worst"}};
  return all;
}

std::string MeasureChoice::si_unit(const IndexChoice& index) const {
  return measure == Measure::index ? index.si_unit() : measure_names()[static_cast<std::size_t>(measure)].si_unit;
}

std::string MeasureChoice::title(const IndexChoice& index) const {
  std::string text =
      measure == Measure::index ? index.title() : measure_names()[static_cast<std::size_t>(measure)].title;
  if (over == Over::mean) text += "; mean over the scatter";
  if (over == Over::worst) text += "; worst of the scatter";
  if (over == Over::quantile) {
    char share[60];
    std::snprintf(share, sizeof share, "; %g %% of the scatter lie below", 100.0 * probability);
    text += share;
  }
  return text;
}

std::string MeasureChoice::key() const { return measure_names()[static_cast<std::size_t>(measure)].name; }

double MeasureChoice::of(const Outcome& outcome) const {
  if (outcome.status != Outcome::Status::done) return std::numeric_limits<double>::quiet_NaN();
  switch (measure) {
    case Measure::index:
      return outcome.value;
    case Measure::free_flight_share:
      return outcome.motion.free_flight_share;
    case Measure::impacts_per_second:
      return outcome.motion.impacts_per_second;
    case Measure::peak_acceleration:
      return outcome.motion.peak_acceleration;
  }
  return std::numeric_limits<double>::quiet_NaN();
}

double MeasureChoice::of(std::span<const Outcome> outcomes) const {
  std::vector<double> values;
  for (const Outcome& o : outcomes) {
    values.push_back(of(o));
    if (!std::isfinite(values.back())) return std::numeric_limits<double>::quiet_NaN();
  }
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  switch (over) {
    case Over::nominal:
      return values.front();
    case Over::mean: {
      double sum = 0.0;
      for (const double v : values) sum += v;
      return sum / static_cast<double>(values.size());
    }
    case Over::worst:
      return *std::max_element(values.begin(), values.end());
    case Over::quantile:
      return IndependentSamples(values).quantile(probability, 0.5).value;
  }
  return values.front();
}

ScatterStatistic MeasureChoice::statistic_of(std::size_t samples) const {
  if (over == Over::quantile) return {probability};
  if (over == Over::worst && samples > 1) return {1.0 - 1.0 / static_cast<double>(samples)};
  return {};
}

ReportedInterval MeasureChoice::interval(std::span<const Outcome> outcomes, double confidence) const {
  std::vector<double> values;
  std::int64_t failed = 0;
  for (const Outcome& o : outcomes) {
    const double v = of(o);
    if (std::isfinite(v))
      values.push_back(v);
    else
      ++failed;
  }
  if (values.size() >= 2 && over == Over::mean) {
    ReportedInterval mean = reported(IndependentSamples(values, failed).mean(confidence));
    if (measure == Measure::index) return mean;
    // Shares, counts and sizes are not below zero, and no share is above one: few samples' own scatter does not know that.
    mean.low = std::max(mean.low, 0.0);
    if (measure == Measure::free_flight_share) mean.high = std::min(mean.high, 1.0);
    return mean;
  }
  if (!values.empty() && over == Over::quantile)
    return reported(IndependentSamples(values, failed).quantile(probability, confidence));
  const double value = of(outcomes);
  return {value, value, value, confidence, 0.0, false, "no scatter is asked for", "none"};
}

bool MeasureChoice::may_be_alike(std::span<const Outcome> a, std::span<const Outcome> b, double confidence,
                                 double further) const {
  MeasureChoice compared = *this;
  const std::size_t fewer = std::min(a.size(), b.size());
  if (over == Over::worst && fewer > 1) {
    compared.over = Over::quantile;
    compared.probability = 1.0 - 1.0 / static_cast<double>(fewer);
  }
  const ReportedInterval of_a = compared.interval(a, confidence), of_b = compared.interval(b, confidence);
  // Order statistics know no more than whether their intervals meet, of which one may have no upper end.
  if (compared.over == Over::quantile) return of_a.low <= of_b.high + further && of_b.low <= of_a.high + further;
  return std::abs(of_a.value - of_b.value) <= further + 0.5 * (of_a.high - of_a.low + of_b.high - of_b.low);
}

}  // namespace boresight
