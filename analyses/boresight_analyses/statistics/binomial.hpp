// What the binomial distribution says without knowing the distribution of the samples: bounds of a probability, ranks
// that enclose a quantile, and how many samples a statement needs. For independent samples only.
#pragma once

#include <cstdint>

namespace boresight {

struct ProbabilityBounds {
  double low = 0.0, high = 1.0;
};

// Two-sided bounds of a probability of which `hits` of `samples` were seen (Clopper, Pearson 1934). Each side errs with
// a chance of at most (1 - confidence) / 2. Throws std::invalid_argument unless 0 <= hits <= samples, samples > 0,
// 0 < confidence < 1.
ProbabilityBounds clopper_pearson(std::int64_t hits, std::int64_t samples, double confidence);
// One-sided: the probability is at least this (at most that), each with the whole of 1 - confidence.
double clopper_pearson_lower(std::int64_t hits, std::int64_t samples, double confidence);
double clopper_pearson_upper(std::int64_t hits, std::int64_t samples, double confidence);

// Ranks (from 1, ascending) whose order statistics enclose the quantile of probability p:
//   P(X_(low) <= q_p < X_(high)) = P(low <= B <= high - 1), B binomial(samples, p)          (David, Nagaraja 2003, 7.1)
// low = 0 and high = samples + 1 mean that no sample bounds that side. Equal tails, then narrowed rank by rank while
// the coverage stays at `confidence` or above.
struct QuantileRanks {
  std::int64_t low = 0, high = 0;
  double coverage = 0.0;  // exact for a continuous distribution, a lower bound for others
};
QuantileRanks quantile_ranks(std::int64_t samples, double p, double confidence);

// Wilks (1941): the fewest samples such that, with `confidence`, the share `probability` lies below the largest but
// `exceedances` (one-sided: as many may exceed the limit), or between the smallest but and the largest but
// `exceedances` (two-sided).
std::int64_t wilks_one_sided(double probability, double confidence, std::int64_t exceedances = 0);
std::int64_t wilks_two_sided(double probability, double confidence, std::int64_t exceedances = 0);

}  // namespace boresight
