#include "boresight_analyses/allocation/confirmation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "boresight_analyses/statistics/binomial.hpp"

namespace boresight {

double confirmation_confidence(const Requirement& requirement) {
  return 1.0 - (1.0 - requirement.confidence) / kMostConfirmations;
}

std::uint64_t confirmation_seed(std::uint64_t seed, std::size_t number) {
  constexpr std::uint64_t kApart = 1'000'003;  // from the search's and from each other
  return seed + kApart * (number + 1);
}

std::vector<double> values_of(const std::vector<Outcome>& outcomes) {
  std::vector<double> values;
  for (const Outcome& o : outcomes)
    values.push_back(o.status == Outcome::Status::done ? o.value + o.model_error * std::abs(o.value)
                                                       : std::numeric_limits<double>::infinity());
  return values;
}

double model_error_of(const std::vector<Outcome>& outcomes) {
  double sum = 0.0, done = 0.0;
  for (const Outcome& o : outcomes) {
    if (o.status != Outcome::Status::done) continue;
    sum += o.model_error;
    done += 1.0;
  }
  return done > 0.0 ? sum / done : 0.0;
}

double shown_limit(std::vector<double> values, double probability, double confidence) {
  const std::int64_t allowed = allowed_failures(static_cast<std::int64_t>(values.size()), probability, confidence);
  if (allowed < 0) return std::numeric_limits<double>::infinity();
  const auto at = values.begin() + allowed;
  std::nth_element(values.begin(), at, values.end(), std::greater<>());
  return *at;
}

AllocationConfirmation confirmation_of(const std::vector<double>& values, const Requirement& requirement,
                                       double confidence) {
  AllocationConfirmation c;
  c.samples = values.size();
  c.confidence = confidence;
  c.reached = shown_limit(values, requirement.probability, confidence);
  std::int64_t within = 0;
  for (const double v : values) {
    within += v <= requirement.limit;
    c.failed += !std::isfinite(v);
  }
  c.share_within = static_cast<double>(within) / static_cast<double>(values.size());
  c.share_low = clopper_pearson_lower(within, static_cast<std::int64_t>(values.size()), confidence);
  c.met = c.share_low >= requirement.probability;
  return c;
}

}  // namespace boresight
