// What an optimisation is about: a number of the motion (the study's index, or one of its contact measures),
// and what is made of it where parameters scatter.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "boresight_analyses/statistics/interval.hpp"
#include "boresight_analyses/study/index_choice.hpp"
#include "boresight_analyses/study/sample_model.hpp"
#include "boresight_analyses/study/scatter_comparison.hpp"

namespace boresight {

enum class Measure { index, free_flight_share, impacts_per_second, peak_acceleration };
struct MeasureName {
  Measure measure;
  const char* name;
  const char* title;    // for people; of the index the study's own is taken
  const char* si_unit;  // likewise
};
const std::vector<MeasureName>& measure_names();

// Of the samples of one design: at nominal values there is one sample.
enum class Over { nominal, mean, quantile, worst };
struct OverName {
  Over over;
  const char* name;
};
const std::vector<OverName>& over_names();

struct MeasureChoice {
  Measure measure = Measure::index;
  Over over = Over::nominal;
  double probability = 0.95;  // of the quantile

  std::string si_unit(const IndexChoice& index) const;
  std::string title(const IndexChoice& index) const;  // "position error, maximum; mean"
  std::string key() const;                            // "index", "free_flight_share", ...

  double of(const Outcome& outcome) const;
  // NaN where a sample failed or the model does not say.
  double of(std::span<const Outcome> outcomes) const;
  // What it asks of a design's samples; of the worst of them the quantile that so many can see.
  ScatterStatistic statistic_of(std::size_t samples) const;
  // The same with its interval: Student's t of a mean, order statistics of a quantile; a nominal value or a
  // worst case has none (its ends are the value).
  ReportedInterval interval(std::span<const Outcome> outcomes, double confidence) const;
  // Whether two sets of samples leave open that they are of one value, but for `further` in its unit. The worst of more samples is larger: of
  // worst cases both are asked for the quantile that the fewer can see.
  bool may_be_alike(std::span<const Outcome> a, std::span<const Outcome> b, double confidence, double further) const;
};

}  // namespace boresight
