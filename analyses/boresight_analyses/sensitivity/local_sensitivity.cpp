#include "boresight_analyses/sensitivity/local_sensitivity.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "boresight_analyses/threads/watcher.hpp"

namespace boresight {
namespace {

constexpr std::array<double, 3> kSteps = {0.5, 0.25, 0.125};  // of the sd
const char* const kTurnsHere = "the index turns here: from the median it changes alike to either side";
constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

LocalSensitivity described(const RandomParameter& parameter) {
  const Distribution& d = *parameter.distribution;
  LocalSensitivity s;
  s.name = parameter.name();
  s.si_unit = parameter.si_unit;
  s.told_unit = parameter.told_unit();
  s.unit = parameter.unit;
  s.median = d.quantile(0.5);
  s.sd = d.sd();
  s.low = d.quantile(0.05);
  s.high = d.quantile(0.95);
  s.step.fill(kNone);
  if (d.is_discrete()) return s;
  // Inside the support: a difference beyond it would be of a mechanism that the study does not contain.
  const double room = std::min(s.median - d.lowest(), d.highest() - s.median);
  for (std::size_t k = 0; k < kSteps.size(); ++k) s.step[k] = std::min(kSteps[k] * s.sd, room * kSteps[k] / kSteps[0]);
  return s;
}

// index: at the medians. `either_way`: at every step it is larger to both sides, or smaller. What differences are by its
// rounding is no slope.
void assess_linearity(LocalSensitivity& s, double index, bool either_way, bool discrete) {
  constexpr double kRounding = 1e-12;  // relative, of the index of a motion
  const auto [least, largest] = std::minmax_element(s.derivative.begin(), s.derivative.end());
  const double size = std::max(std::abs(*least), std::abs(*largest));
  if (discrete) {
    s.why_not = "the parameter is discrete";
  } else if (!std::all_of(s.derivative.begin(), s.derivative.end(), [](double v) { return std::isfinite(v); })) {
    s.why_not = "a run near the medians failed";
  } else if (size * s.step.front() <= kRounding * std::abs(index)) {
    s.meaningful = true;
  } else {
    s.spread = (*largest - *least) / size;
    s.meaningful = s.spread <= kSettledSlope;
    char text[160];
    std::snprintf(text, sizeof text,
                  "three steps give slopes that differ by %.0f %% of the largest: the index is rough here",
                  100.0 * s.spread);
    if (!s.meaningful) s.why_not = either_way ? kTurnsHere : text;
    s.turns = !s.meaningful && either_way;
  }
}

}  // namespace

LocalResult local_sensitivity(const SampleModel& model, const RandomInputs& inputs, int jobs,
                              const std::function<bool()>& interrupted) {
  LocalResult result;
  std::vector<double> medians;
  for (const RandomParameter& p : inputs.parameters) {
    result.parameters.push_back(described(p));
    medians.push_back(result.parameters.back().median);
  }
  // Run 0 at the medians, then per parameter low, high, and below and above at each step.
  std::vector<std::vector<double>> points = {medians};
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    const LocalSensitivity& s = result.parameters[i];
    const auto with = [&](double value) {
      points.push_back(medians);
      points.back()[i] = std::isfinite(value) ? value : s.median;
    };
    with(s.low);
    with(s.high);
    for (const double h : s.step) {
      with(s.median - h);
      with(s.median + h);
    }
  }
  std::vector<double> values(points.size(), kNone);
  Watcher watcher(interrupted);
  ParallelSampling sampling{.jobs = jobs, .landed = {}, .stop = &watcher.stop};
  sampling.landed = [&](std::span<const SampleRecord> records) {
    for (const SampleRecord& r : records)
      if (r.outcome.status == Outcome::Status::done) values[r.number] = r.outcome.value;
    return !watcher.stop;
  };
  result.interrupted = !compute_samples(
      model, inputs.size(),
      [&](std::uint64_t number, std::span<double> at) {
        std::copy(points[number].begin(), points[number].end(), at.begin());
      },
      {{0, points.size()}}, sampling);
  result.at_medians = values[0];
  std::size_t at = 1;
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    LocalSensitivity& s = result.parameters[i];
    s.at_low = values[at++];
    s.at_high = values[at++];
    bool larger = true, smaller = true;
    for (std::size_t k = 0; k < s.step.size(); ++k, at += 2) {
      s.derivative[k] = (values[at + 1] - values[at]) / (2.0 * s.step[k]);
      larger = larger && std::min(values[at], values[at + 1]) > result.at_medians;
      smaller = smaller && std::max(values[at], values[at + 1]) < result.at_medians;
    }
    assess_linearity(s, result.at_medians, larger || smaller, inputs.parameters[i].distribution->is_discrete());
  }
  return result;
}

}  // namespace boresight
