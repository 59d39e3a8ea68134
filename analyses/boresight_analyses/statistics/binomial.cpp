#include "boresight_analyses/statistics/binomial.hpp"

#include <algorithm>
#include <boost/math/distributions/binomial.hpp>
#include <stdexcept>

namespace boresight {
namespace {

using Binomial = boost::math::binomial_distribution<double>;

void check_share(double share, const char* name) {
  if (!(share > 0.0 && share < 1.0)) throw std::invalid_argument(std::string(name) + " must lie between 0 and 1");
}

void check_hits(std::int64_t hits, std::int64_t samples, double confidence) {
  if (samples <= 0 || hits < 0 || hits > samples)
    throw std::invalid_argument("hits must lie between 0 and the number of samples");
  check_share(confidence, "confidence");
}

double lower(std::int64_t hits, std::int64_t samples, double risk) {
  if (hits == 0) return 0.0;
  return Binomial::find_lower_bound_on_p(double(samples), double(hits), risk);
}

double upper(std::int64_t hits, std::int64_t samples, double risk) {
  if (hits == samples) return 1.0;
  return Binomial::find_upper_bound_on_p(double(samples), double(hits), risk);
}

// P(B <= k); boost refuses k outside 0..n.
double at_most(const Binomial& b, std::int64_t k) {
  if (k < 0) return 0.0;
  return double(k) >= b.trials() ? 1.0 : cdf(b, double(k));
}
double more_than(const Binomial& b, std::int64_t k) {
  if (k < 0) return 1.0;
  return double(k) >= b.trials() ? 0.0 : cdf(complement(b, double(k)));
}

// The fewest n with P(binomial(n, 1 - probability) <= allowed) <= 1 - confidence: it falls with n.
std::int64_t fewest(double probability, double confidence, std::int64_t allowed) {
  check_share(probability, "probability");
  check_share(confidence, "confidence");
  if (allowed < 0) throw std::invalid_argument("exceedances must not be negative");
  const auto enough = [&](std::int64_t n) {
    return at_most(Binomial(double(n), 1.0 - probability), allowed) <= 1.0 - confidence;
  };
  std::int64_t few = allowed, many = allowed + 1;
  while (!enough(many)) {
    few = many;
    many *= 2;
  }
  while (many - few > 1) {
    const std::int64_t middle = few + (many - few) / 2;
    (enough(middle) ? many : few) = middle;
  }
  return many;
}

}  // namespace

ProbabilityBounds clopper_pearson(std::int64_t hits, std::int64_t samples, double confidence) {
  check_hits(hits, samples, confidence);
  const double risk = 0.5 * (1.0 - confidence);
  return {lower(hits, samples, risk), upper(hits, samples, risk)};
}

double clopper_pearson_lower(std::int64_t hits, std::int64_t samples, double confidence) {
  check_hits(hits, samples, confidence);
  return lower(hits, samples, 1.0 - confidence);
}

double clopper_pearson_upper(std::int64_t hits, std::int64_t samples, double confidence) {
  check_hits(hits, samples, confidence);
  return upper(hits, samples, 1.0 - confidence);
}

QuantileRanks quantile_ranks(std::int64_t samples, double p, double confidence) {
  if (samples <= 0) throw std::invalid_argument("a quantile needs at least one sample");
  check_share(p, "probability");
  check_share(confidence, "confidence");
  const Binomial b(double(samples), p);
  const double risk = 0.5 * (1.0 - confidence);
  // The largest `low` with P(B < low) <= risk, the smallest `high` with P(B >= high) <= risk; boost's quantiles start it.
  auto low = static_cast<std::int64_t>(quantile(b, risk));
  while (low > 0 && at_most(b, low - 1) > risk) --low;
  while (low < samples && at_most(b, low) <= risk) ++low;
  auto high = static_cast<std::int64_t>(quantile(complement(b, risk))) + 1;
  while (high <= samples && more_than(b, high - 1) > risk) ++high;
  while (high > low + 1 && more_than(b, high - 2) <= risk) --high;
  const auto coverage = [&](std::int64_t l, std::int64_t h) { return 1.0 - at_most(b, l - 1) - more_than(b, h - 1); };
  for (;;) {
    const double without_low = coverage(low + 1, high), without_high = coverage(low, high - 1);
    if (std::max(without_low, without_high) < confidence) break;
    if (without_low >= without_high)
      ++low;
    else
      --high;
  }
  return {low, high, coverage(low, high)};
}

std::int64_t wilks_one_sided(double probability, double confidence, std::int64_t exceedances) {
  return fewest(probability, confidence, exceedances);
}

// The share between X_(e+1) and X_(n-e) has a beta distribution: what lies outside counts 2 e + 1 ways to fail.
std::int64_t wilks_two_sided(double probability, double confidence, std::int64_t exceedances) {
  return fewest(probability, confidence, 2 * exceedances + 1);
}

}  // namespace boresight
