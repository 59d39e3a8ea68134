// Bounds of the mean of independent values that lie between 0 and 1, whatever their distribution: of the share of the
// time, say, that each member of an ensemble spends below a limit.
//
// Hoeffding (1963), J. Am. Stat. Assoc. 58, Theorem 1: for a true mean p the mean of n values reaches m > p with a
// chance of at most exp(-n KL(m || p)), KL(m || p) = m ln(m / p) + (1 - m) ln((1 - m) / (1 - p)). With every value at 1
// the lower bound is (1 - confidence)^(1/n): that of Wilks and of Clopper and Pearson, which nothing without a
// distribution can better.
#pragma once

namespace boresight {

// One-sided, each at this confidence. Throws std::invalid_argument unless 0 <= mean <= 1, samples > 0, 0 < confidence
// < 1.
double bounded_mean_lower(double mean, double samples, double confidence);
double bounded_mean_upper(double mean, double samples, double confidence);

// The mean that has to be seen before the lower bound reaches `target`; above 1 (2.0) where no mean would do.
double mean_that_shows(double target, double samples, double confidence);
// The mean at and below which the upper bound stays at or below `target`; -1 where none would do.
double mean_that_denies(double target, double samples, double confidence);

}  // namespace boresight
