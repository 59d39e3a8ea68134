// Two ways of computing the same samples, compared by what a study asks of their scatter: a mean or a quantile.
//
// Samples are paired: both ways compute the same parameters, so that what the parameters scatter cancels and a few pairs
// say as much as thousands of single samples would. What impacts scatter does not cancel; it is in the standard error.
// With z the normal score of each pair's sample among many (by some cheap way that ranks them all), a way's values are
// taken as a + b z plus chance of standard deviation s, and its statistics over the scatter are
//
//   mean       a
//   quantile   a + z_p sqrt(b^2 + s^2)
//
// which lets pairs be chosen where the question lies (in the tail, for a far quantile) without falsifying the answer.
// Where the values are not normal both ways bend alike, and the difference keeps little of it. The standard error of the
// difference is the jackknife's, over pairs (Efron and Stein 1981).
#pragma once

#include <span>
#include <string>
#include <vector>

#include "boresight_analyses/study/measurement.hpp"

namespace boresight {

// What a study asks of the index over its scatter.
struct ScatterStatistic {
  double probability = 0.0;  // of a quantile; 0: the mean

  // "mean over the scatter", "95 % quantile over the scatter"
  std::string title() const;
};

struct ScatterDifference {
  double value = 0.0, reference = 0.0;  // the statistic, by either way
  double difference = 0.0;              // (value - reference) / |reference|
  double half_width = 0.0;              // of its 95 % interval; infinite with fewer than four pairs
  std::size_t pairs = 0;

  double bound() const { return (difference < 0.0 ? -difference : difference) + half_width; }
};

// values, reference: of the same samples. scores: their normal scores; empty where nothing ranks them: the values' own
// mean and standard deviation then stand for a and s, and the pairs must be plain draws.
ScatterDifference compare_scatter(std::span<const double> values, std::span<const double> reference,
                                  std::span<const double> scores, const ScatterStatistic& statistic,
                                  double nothing = kNothing);

// Samples to pair, in the order in which to take them, and their scores.
struct ChosenSamples {
  std::vector<std::size_t> sample;
  std::vector<double> score;  // empty if nothing ranks them
};

// For a mean, or a quantile in the middle: as they come. For a quantile in a tail every second one from that tail.
// ranked_by: a value of the leading samples by a cheap way, NaN where it failed; empty: there is none.
ChosenSamples choose_samples(std::span<const double> ranked_by, std::size_t samples, std::size_t most,
                             const ScatterStatistic& statistic);

}  // namespace boresight
