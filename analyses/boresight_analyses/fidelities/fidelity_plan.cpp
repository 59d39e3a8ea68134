#include "boresight_analyses/fidelities/fidelity_plan.hpp"

#include <gsl/gsl_cdf.h>
#include <gsl/gsl_statistics_double.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <stdexcept>

#include "boresight_analyses/random/counter_stream.hpp"

namespace boresight {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr int kResamples = 500;
constexpr double kRounding = 1e-12;  // of a squared correlation
constexpr std::uint64_t kPlace = 1;  // of the resampling stream: rows of Sobol' indices use others

struct Moments {
  std::vector<double> mean, sd, correlation;  // with model 0; 0 where either does not vary
};

Moments moments(const std::vector<std::vector<double>>& values) {
  Moments m;
  for (const auto& v : values) {
    m.mean.push_back(gsl_stats_mean(v.data(), 1, v.size()));
    m.sd.push_back(gsl_stats_sd(v.data(), 1, v.size()));
    const bool varies = m.sd.back() > 0.0 && m.sd.front() > 0.0;
    m.correlation.push_back(varies ? gsl_stats_correlation(values[0].data(), 1, v.data(), 1, v.size()) : 0.0);
  }
  m.correlation[0] = 1.0;
  return m;
}

struct Choice {
  std::vector<int> models = {0};
  double price = 0.0;  // variance times CPU seconds, in units of the variance of model 0
};

std::vector<double> picked(const std::vector<double>& from, const std::vector<int>& models) {
  std::vector<double> result;
  for (const int i : models) result.push_back(from[i]);
  return result;
}

Choice cheapest(const std::vector<double>& correlation, const std::vector<double>& cost) {
  std::vector<int> order(correlation.size() - 1);
  std::iota(order.begin(), order.end(), 1);
  std::stable_sort(order.begin(), order.end(),
                   [&](int a, int b) { return std::abs(correlation[a]) > std::abs(correlation[b]); });
  Choice best{{0}, cost[0]};
  for (unsigned subset = 1; subset < (1u << order.size()); ++subset) {
    std::vector<int> models = {0};
    for (std::size_t k = 0; k < order.size(); ++k)
      if (subset & (1u << k)) models.push_back(order[k]);
    const double price = price_of_models(picked(correlation, models), picked(cost, models));
    if (price < best.price) best = {models, price};
  }
  return best;
}

// Of given models, how many samples of each the CPU seconds `left` pay: in proportion to `share`, but `first` of the dear one where that is not 0.
// Empty where they do not pay so many.
std::vector<std::int64_t> samples_of(const std::vector<double>& rho, const std::vector<double>& cost, double left,
                                     std::int64_t first) {
  const auto share = [&](std::size_t i) {  // m_i is proportional to it
    const double next = i + 1 < rho.size() ? rho[i + 1] * rho[i + 1] : 0.0;
    return std::sqrt(std::max(0.0, rho[i] * rho[i] - next) / cost[i]);
  };
  double unit = 0.0, spent = 0.0;
  for (std::size_t i = first > 0 ? 1 : 0; i < rho.size(); ++i) unit += cost[i] * share(i);
  left -= cost[0] * static_cast<double>(first);
  std::vector<std::int64_t> samples;
  for (std::size_t i = 0; i < rho.size(); ++i) {
    const double wanted = i == 0 && first > 0 ? static_cast<double>(first) : std::max(0.0, left) / unit * share(i);
    samples.push_back(std::max<std::int64_t>(static_cast<std::int64_t>(wanted), i == 0 ? 2 : samples.back() + 2));
    if (i > 0) spent += cost[i] * static_cast<double>(samples.back());
  }
  return first > 0 && spent > left ? std::vector<std::int64_t>{} : samples;
}

// Samples that failed on no model.
std::vector<std::vector<double>> whole(const FidelityPilot& pilot) {
  std::vector<std::vector<double>> values(pilot.models());
  for (std::size_t k = 0; k < pilot.samples(); ++k) {
    if (!std::all_of(pilot.values.begin(), pilot.values.end(), [k](const auto& v) { return std::isfinite(v[k]); }))
      continue;
    for (std::size_t i = 0; i < pilot.models(); ++i) values[i].push_back(pilot.values[i][k]);
  }
  return values;
}

void check(const FidelityPilot& pilot) {
  if (pilot.models() == 0 || pilot.cost.size() != pilot.models() || pilot.models() > 16)
    throw std::invalid_argument("a pilot needs between 1 and 16 models, and the cost of each");
  for (std::size_t i = 0; i < pilot.models(); ++i) {
    if (pilot.values[i].size() != pilot.samples())
      throw std::invalid_argument("a pilot has the same samples on every model");
    if (!(pilot.cost[i] > 0.0)) throw std::invalid_argument("the cost of a model must be positive");
  }
}

}  // namespace

double FidelityPilot::spent() const { return double(samples()) * std::accumulate(cost.begin(), cost.end(), 0.0); }

double price_of_models(const std::vector<double>& correlation, const std::vector<double>& cost) {
  const std::size_t n = correlation.size();
  const auto square = [&](std::size_t i) { return i < n ? correlation[i] * correlation[i] : 0.0; };
  double sum = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    // A model that follows to the last digit leaves next to nothing to the one before, and never nothing: a pilot cannot tell.
    const double here = std::max(square(i) - square(i + 1), kRounding);
    if (i > 0 && !(cost[i - 1] * here > cost[i] * (square(i - 1) - square(i)))) return kInfinity;
    sum += std::sqrt(cost[i] * here);
  }
  return sum * sum;
}

FidelityPlan plan_fidelities(const FidelityPilot& pilot, double budget, std::uint64_t seed,
                             const FewestSamples& fewest) {
  check(pilot);
  const std::vector<std::vector<double>> values = whole(pilot);
  const std::size_t n = values[0].size();
  if (n < 10)
    throw std::invalid_argument("the pilot needs ten samples that fail on no model, there are " + std::to_string(n));
  FidelityPlan plan;
  const double left = budget - pilot.spent(), pair = std::accumulate(pilot.cost.begin(), pilot.cost.end(), 0.0);
  if (!(left >= 2.0 * pair))
    throw std::invalid_argument("the budget leaves less than two samples of every model after the pilot");
  const Moments m = moments(values);
  const Choice choice = cheapest(m.correlation, pilot.cost);
  plan.models = choice.models;
  plan.mean = m.mean;
  plan.sd = m.sd;
  plan.correlation = m.correlation;
  plan.pilot_samples = static_cast<std::int64_t>(pilot.samples());
  plan.pilot_failed = plan.pilot_samples - static_cast<std::int64_t>(n);

  std::vector<double> rho = picked(m.correlation, plan.models), cost = picked(pilot.cost, plan.models);
  plan.samples = samples_of(rho, cost, left, 0);
  plan.for_the_mean = plan.samples.front();
  plan.fewest = plan.models.size() > 1 ? fewest.beside_others : fewest.alone;
  if (!plan.can_show() && plan.models.size() > 1) {
    if (std::vector<std::int64_t> raised = samples_of(rho, cost, left, plan.fewest); !raised.empty()) {
      plan.samples = std::move(raised);
    } else if (cost[0] * static_cast<double>(fewest.alone) <= left) {
      plan.models = {0};
      plan.fewest = fewest.alone;
      rho.resize(1);
      cost.resize(1);
      plan.samples = samples_of(rho, cost, left, 0);
    }
  }
  for (std::size_t i = 0; i < rho.size(); ++i) {
    plan.weight.push_back(i == 0 ? 1.0 : rho[i] * m.sd[0] / m.sd[plan.models[i]]);
    plan.cost += cost[i] * double(plan.samples[i]);
  }
  // With whole numbers of samples (Eq. 3.4).
  plan.variance = m.sd[0] * m.sd[0] / double(plan.samples[0]);
  for (std::size_t i = 1; i < rho.size(); ++i)
    plan.variance -=
        (1.0 / double(plan.samples[i - 1]) - 1.0 / double(plan.samples[i])) * rho[i] * rho[i] * m.sd[0] * m.sd[0];
  plan.plain_variance = m.sd[0] * m.sd[0] * pilot.cost[0] / budget;
  if (m.sd[0] == 0.0) return plan;
  plan.gain = plan.plain_variance / plan.variance;

  // The same choice of models, correlations resampled.
  const CounterStream stream(seed, StreamPurpose::resampling);
  std::vector<double> gains;
  for (int r = 0; r < kResamples; ++r) {
    std::vector<std::vector<double>> drawn(plan.models.size(), std::vector<double>(n));
    for (std::size_t k = 0; k < n; ++k) {
      const std::uint64_t from = stream.below(n, static_cast<std::uint64_t>(r), k, kPlace);
      for (std::size_t i = 0; i < plan.models.size(); ++i) drawn[i][k] = values[plan.models[i]][from];
    }
    const Moments again = moments(drawn);
    double variance = 1.0 / double(plan.samples[0]);
    for (std::size_t i = 1; i < rho.size(); ++i) {
      // The weight is fixed by then: a wrong one costs, alpha^2 sd_i^2 - 2 alpha rho_i sd_1 sd_i in place of -rho_i^2 sd_1^2.
      const double a = again.sd[0] > 0.0 ? plan.weight[i] * again.sd[i] / again.sd[0] : 0.0;
      variance += (1.0 / double(plan.samples[i - 1]) - 1.0 / double(plan.samples[i])) *
                  (a * a - 2.0 * a * again.correlation[i]);
    }
    gains.push_back(pilot.cost[0] / budget / variance);
  }
  std::sort(gains.begin(), gains.end());
  plan.gain_low = gsl_stats_quantile_from_sorted_data(gains.data(), 1, gains.size(), 0.025);
  plan.gain_high = gsl_stats_quantile_from_sorted_data(gains.data(), 1, gains.size(), 0.975);
  return plan;
}

FidelityPlan with_weights_of(FidelityPlan plan, const FidelityPilot& pilot) {
  check(pilot);
  const Moments m = moments(whole(pilot));
  for (std::size_t i = 1; i < plan.models.size(); ++i) {
    const auto model = static_cast<std::size_t>(plan.models[i]);
    plan.weight[i] = m.sd[model] > 0.0 ? m.correlation[model] * m.sd[0] / m.sd[model] : 0.0;
  }
  return plan;
}

ExcessPilot excess_pilot(const FidelityPilot& pilot, double limit) {
  check(pilot);
  const std::vector<std::vector<double>> values = whole(pilot);
  ExcessPilot result{pilot, std::vector<double>(pilot.models(), limit)};
  if (values[0].size() >= 2) {
    const Moments m = moments(values);
    for (std::size_t i = 1; i < pilot.models(); ++i)
      if (m.correlation[i] != 0.0)
        result.limits[i] = m.mean[i] + m.correlation[i] * m.sd[i] / m.sd[0] * (limit - m.mean[0]);
  }
  for (std::size_t i = 0; i < pilot.models(); ++i)
    for (double& v : result.indicators.values[i]) v = !std::isfinite(v) || v > result.limits[i] ? 1.0 : 0.0;
  return result;
}

FidelityPlan with_excess_weights(FidelityPlan plan, const FidelityPilot& pilot, const ExcessPilot& excess,
                                 double limit) {
  plan = with_weights_of(std::move(plan), excess.indicators);
  const std::vector<std::vector<double>> values = whole(pilot), indicators = whole(excess.indicators);
  const Moments m = moments(values);
  const auto few = [&](std::size_t model) {
    constexpr double kFewest = 5.0;
    const double beyond = std::accumulate(indicators[model].begin(), indicators[model].end(), 0.0);
    return beyond < kFewest || double(indicators[model].size()) - beyond < kFewest;
  };
  const double a = m.sd[0] > 0.0 ? (limit - m.mean[0]) / m.sd[0] : 0.0;
  for (std::size_t i = 1; i < plan.models.size(); ++i) {
    const auto model = static_cast<std::size_t>(plan.models[i]);
    if (!few(0) && !few(model)) continue;
    const double r = std::clamp(m.correlation[model], -1.0, 1.0), b = r * a;
    const double q = gsl_cdf_ugaussian_Q(b), whole_angle = std::asin(r);
    constexpr int kPanels = 200;  // midpoint rule; the integrand is smooth
    double covariance = 0.0;
    for (int k = 0; k < kPanels; ++k) {
      const double t = whole_angle * (k + 0.5) / kPanels;
      covariance += std::exp(-0.5 * (a * a - 2.0 * a * b * std::sin(t) + b * b) / std::pow(std::cos(t), 2)) /
                    (2.0 * std::numbers::pi) * whole_angle / kPanels;
    }
    plan.weight[i] = q > 0.0 && q < 1.0 ? covariance / (q * (1.0 - q)) : 0.0;
  }
  return plan;
}

}  // namespace boresight
