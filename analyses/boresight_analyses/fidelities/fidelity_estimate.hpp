// The estimate of a multi-fidelity plan from its samples, with its interval.
//
// A sample contributes with every model it ran on, so that the estimate is a sum over samples; those between m_{i-1} and m_i
// are independent and alike, and their scatter gives the variance, whatever the pilot had thought (Welch's degrees of
// freedom over these groups).
#pragma once

#include <vector>

#include "boresight_analyses/fidelities/fidelity_plan.hpp"
#include "boresight_analyses/statistics/interval.hpp"

namespace boresight {

struct FidelityEstimate {
  IndependentInterval value;
  double standard_error = 0.0;
  std::int64_t failed = 0;  // samples that failed on some model they ran on; the others' values of them count
  // Variance of the dear model alone with as many of its samples, over this one's; measured, not forecast.
  double variance_ratio = 1.0;
};

// values[i]: of the plan's i-th model, its first samples[i] or more of one common sequence of independent samples; further
// ones are not used. A value that is not finite leaves the mean of its own model and no other: the dear model fails where
// the cheap ones lie high or low, and leaving such samples out of all of them in the first group alone, which is the only one
// that ran on the dear model, would compare unlike means. Throws std::invalid_argument where fewer than two samples are left.
FidelityEstimate estimate_fidelities(const FidelityPlan& plan, const std::vector<std::vector<double>>& values,
                                     double confidence);

// Of a probability, from 0 and 1 in place of values: bounds that hold for every number of exceedances, each end at
// (1 + confidence) / 2. Scatter between few of them, or none, says nothing, so Student's interval is not for claims.
IndependentInterval excess_bounds(const FidelityPlan& plan, const std::vector<std::vector<double>>& indicators,
                                  double confidence);

// The fewest samples of the first model with which these bounds can show that a share of `probability` stays below a limit, one-sided at
// `confidence`: with none of them beyond (Wilks 1941). Betting takes no fewer, however closely cheap models follow: of n terms, all
// alike, its bound is that of n samples without a hit, 1 - risk^(1/n).
FewestSamples fewest_to_show(double probability, double confidence);

// 0 and 1 in place of values, for a probability; a sample that failed counts as beyond. limits: of the pilot's models.
std::vector<std::vector<double>> excess_indicators(const FidelityPlan& plan,
                                                   const std::vector<std::vector<double>>& values,
                                                   const std::vector<double>& limits);

}  // namespace boresight
