// Multi-fidelity Monte Carlo (Peherstorfer, Willcox, Gunzburger 2016, SIAM J. Sci. Comput. 38): many samples of cheap
// models, few of the dear one, unbiased for the dear one.
//
//   s = mean_1(m_1) + sum_i alpha_i (mean_i(m_i) - mean_i(m_{i-1})),   alpha_i = rho_i sd_1 / sd_i      Eq. 3.2, 3.6
//   m_i = r_i m_1,   r_i = sqrt(w_1 (rho_i^2 - rho_{i+1}^2) / (w_i (1 - rho_2^2)))                      Eq. 3.13
//
// Model 1 is the one to be unbiased for; rho_i is the correlation with it, w_i the cost of a sample. Sample sets are nested.
// Which models to take: all subsets are tried, those that break the conditions of the theorem are left out, the one of least
// variance wins, model 1 alone among them. The plan rests on a pilot whose cost counts and whose samples are not used again:
// weights are then independent of the samples, and the estimate is unbiased.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace boresight {

// The same samples on every model; model 0 is the dear one. A value that is not finite: the sample failed there.
struct FidelityPilot {
  std::vector<std::vector<double>> values;  // [model][sample]
  std::vector<double> cost;                 // per model, CPU seconds a sample

  std::size_t models() const { return values.size(); }
  std::size_t samples() const { return values.empty() ? 0 : values[0].size(); }
  double spent() const;  // CPU seconds
};

// Samples of the dear model without which a share of all samples cannot be shown, whatever they give: where cheap models bound it too, and
// where it stands alone (fewest_to_show). Nothing is to be shown: 0.
struct FewestSamples {
  std::int64_t beside_others = 0, alone = 0;
};

struct FidelityPlan {
  std::vector<int> models;            // chosen, model 0 first, then by falling |rho|
  std::vector<double> weight;         // alpha of each; 1 of the first
  std::vector<std::int64_t> samples;  // m of each, ascending
  double variance = 0.0;              // to expect of the estimate
  double plain_variance = 0.0;        // of model 0 alone for the same CPU, the pilot's included
  // Plain variance over this plan's, pilot paid for by both; 1 or less: do it plainly.
  double gain = 1.0, gain_low = 1.0, gain_high = 1.0;  // 95 % by bootstrap over the pilot's samples
  double cost = 0.0;                                   // CPU seconds of the samples, without the pilot

  // What the pilot saw, per model of the pilot.
  std::vector<double> mean, sd, correlation;
  std::int64_t pilot_samples = 0, pilot_failed = 0;

  // Of the dear model: what is asked of it, 0 for nothing, and what serves the mean best.
  std::int64_t fewest = 0, for_the_mean = 0;
  bool can_show() const { return samples.front() >= fewest; }
  // It has more for what is to be shown than the mean alone would give it, or stands alone for that.
  bool raised() const { return fewest > 0 && can_show() && for_the_mean < fewest; }
};

// `budget`: CPU seconds for everything, what the pilot has spent included. Samples that failed on any model are left out of
// all. The mean's variance is least; where the dear model would have fewer samples than something to be shown takes, it has as many first, and
// the others share the rest; the dear model alone where the budget pays no others beside so many. Where it does not pay that either, the
// plan serves the mean. Throws std::invalid_argument for fewer than ten samples that did not fail, costs that are not positive, or a budget
// that does not pay two samples of every model after the pilot.
FidelityPlan plan_fidelities(const FidelityPilot& pilot, double budget, std::uint64_t seed = 1,
                             const FewestSamples& fewest = {});

// The same samples put to another quantity: weights from its own pilot (indicators in place of values, say).
FidelityPlan with_weights_of(FidelityPlan plan, const FidelityPilot& pilot);

// Variance times CPU seconds for given correlations, in units of sd_1^2: (sum_i sqrt(w_i (rho_i^2 - rho_{i+1}^2)))^2, the
// models in order; infinite where the order or the cost condition w_{i-1} / w_i > (rho_{i-1}^2 - rho_i^2) /
// (rho_i^2 - rho_{i+1}^2) is broken.
double price_of_models(const std::vector<double>& correlation, const std::vector<double>& cost);

// For the probability of an excess: 0 and 1 in place of values, failed samples 1. Each cheap model gets its own limit, where
// its least-squares line through the pilot puts the dear model's: any limit keeps the estimate unbiased, this one makes the
// indicators agree better.
struct ExcessPilot {
  FidelityPilot indicators;
  std::vector<double> limits;  // per model
};
ExcessPilot excess_pilot(const FidelityPilot& pilot, double limit);

// The plan's samples put to the probability of that excess. Where the pilot saw fewer than five exceedances of either model,
// or fewer than five that stay below, its indicators say nothing of how they agree: the weight is then that of two normal
// variables with the pilot's correlation r: beyond the standardised limits a of the dear one and b = r a of the cheap one,
// which is exceeded with the chance q (Plackett 1954, Biometrika 41),
//
//   cov = integral of exp(-(a^2 - 2 a b sin t + b^2) / (2 cos^2 t)) / (2 pi) over t from 0 to asin r,   alpha = cov / (q (1 - q))
//
// Any weight that is fixed beforehand leaves the estimate unbiased.
FidelityPlan with_excess_weights(FidelityPlan plan, const FidelityPilot& pilot, const ExcessPilot& excess,
                                 double limit);

}  // namespace boresight
