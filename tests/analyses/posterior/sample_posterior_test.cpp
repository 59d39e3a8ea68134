// Draws from densities whose moments are known.
#include "boresight_analyses/posterior/sample_posterior.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <map>
#include <stdexcept>

#include "boresight_analyses/posterior/chain_diagnostics.hpp"
#include "boresight_analyses/posterior/temperature_ladder.hpp"
#include "known_densities.hpp"

namespace boresight {
namespace sample_posterior_test {

struct Moments {
  VecX mean;
  MatX covariance;
};

Moments moments_of(const PosteriorSamples& samples) {
  const Eigen::Index d = samples.draws[0].cols();
  double n = 0.0;
  Moments m{VecX::Zero(d), MatX::Zero(d, d)};
  for (const MatX& draws : samples.draws) {
    m.mean += draws.colwise().sum().transpose();
    n += static_cast<double>(draws.rows());
  }
  m.mean /= n;
  for (const MatX& draws : samples.draws) {
    const MatX off = draws.rowwise() - m.mean.transpose();
    m.covariance += off.transpose() * off / (n - 1.0);
  }
  return m;
}

// Means to 2 % of a standard deviation, standard deviations to 2 %, correlations to 0.02; R-hat below 1.01.
void expect_moments(const PosteriorSamples& samples, const VecX& mean, const MatX& covariance) {
  const Moments found = moments_of(samples);
  for (Eigen::Index i = 0; i < mean.size(); ++i) {
    const double sd = std::sqrt(covariance(i, i)), sd_found = std::sqrt(found.covariance(i, i));
    EXPECT_NEAR((found.mean[i] - mean[i]) / sd, 0.0, 0.02) << "mean of " << i;
    EXPECT_NEAR(sd_found / sd, 1.0, 0.02) << "standard deviation of " << i;
    for (Eigen::Index j = 0; j < i; ++j)
      EXPECT_NEAR(found.covariance(i, j) / std::sqrt(found.covariance(i, i) * found.covariance(j, j)),
                  covariance(i, j) / std::sqrt(covariance(i, i) * covariance(j, j)), 0.02)
          << "correlation of " << i << " and " << j;
    std::vector<std::vector<double>> draws;
    for (const MatX& d : samples.draws) draws.emplace_back(d.col(i).begin(), d.col(i).end());
    const ChainDiagnostics of = chain_diagnostics(draws);
    EXPECT_LT(of.r_hat, 1.01) << i;
    EXPECT_GT(of.bulk_ess, 400.0) << i;
    EXPECT_GT(of.tail_ess, 400.0) << i;
  }
}

// Four parameters of scales from 1 to 1000, each pair's correlation near 1 or -1.
known::NormalDensity correlated() {
  MatX R(4, 4);
  R << 1.0, 0.99, -0.97, 0.5, 0.99, 1.0, -0.96, 0.45, -0.97, -0.96, 1.0, -0.4, 0.5, 0.45, -0.4, 1.0;
  const VecX scale = (VecX(4) << 1.0, 10.0, 100.0, 1000.0).finished();
  return {(VecX(4) << 3.0, -20.0, 150.0, 700.0).finished(), scale.asDiagonal() * R * scale.asDiagonal()};
}

NormalReference wide_around(const VecX& mean, const MatX& covariance, double times) {
  return {mean, MatX(times * times * covariance.diagonal().asDiagonal())};
}

TEST(PosteriorSampler, HasTheMomentsOfACorrelatedDensity) {
  const known::NormalDensity density = correlated();
  const VecX off = (VecX(4) << 2.0, -10.0, 200.0, 1500.0).finished();
  const PosteriorSampler sampler(density.log_density(), wide_around(density.mean + off, density.covariance, 10.0));
  const PosteriorSamples samples = sampler.run({.temperatures = 10, .draws = 8000});
  expect_moments(samples, density.mean, density.covariance);
}

// Two modes 40 of their standard deviations apart, of unlike weight and shape, in four dimensions.
known::Mixture two_modes() {
  MatX first = MatX::Identity(4, 4), second = MatX::Identity(4, 4);
  first(0, 1) = first(1, 0) = 0.8;
  second.diagonal() << 0.25, 4.0, 1.0, 2.25;
  second(2, 3) = second(3, 2) = -0.9;
  return {{0.7, 0.3}, {{VecX::Constant(4, -10.0), first}, {VecX::Constant(4, 10.0), second}}};
}

TEST(PosteriorSampler, HasTheMomentsAndTheWeightsOfTwoModesFarApart) {
  const known::Mixture density = two_modes();
  const PosteriorSampler sampler(density.log_density(), {VecX::Zero(4), 225.0 * MatX::Identity(4, 4)});
  const PosteriorSamples samples = sampler.run({.temperatures = 12, .draws = 20000, .seed = 3});
  expect_moments(samples, density.mean(), density.covariance());
  double first = 0.0, all = 0.0;
  for (const MatX& draws : samples.draws) {
    first += static_cast<double>((draws.col(0).array() < 0.0).count());
    all += static_cast<double>(draws.rows());
  }
  EXPECT_NEAR(first / all, 0.7, 0.014);
  EXPECT_GT(samples.restarts, 1000);
}

// The guide is off by half a width, and half as wide again: what is drawn is the exact one.
TEST(PosteriorSampler, HasTheMomentsOfTheExactDensityWhereverItsGuideLeads) {
  const known::NormalDensity density = correlated();
  const known::NormalDensity guide{density.mean + 0.5 * density.covariance.diagonal().cwiseSqrt(),
                                   2.0 * density.covariance};
  std::atomic<long> slopes = 0;
  const SampledDensity guided{[exact = density.log_density(), &slopes](const VecX& y, VecX& gradient) {
                                if (gradient.size() > 0) ++slopes;
                                VecX unused(y.size());
                                return exact(y, gradient.size() > 0 ? gradient : unused);
                              },
                              guide.log_density()};
  const PosteriorSampler sampler(guided, wide_around(density.mean, density.covariance, 5.0));
  const PosteriorSamples samples = sampler.run({.temperatures = 10, .draws = 16000});
  expect_moments(samples, density.mean, density.covariance);
  EXPECT_EQ(slopes, 0);
  // One value a step, whatever its trajectory took.
  EXPECT_LE(samples.evaluations, 4l * 10 * (16000 + 500) + 4 * 10 * 1000);
}

TEST(PosteriorSampler, WithoutTemperaturesBetweenStaysInOneMode) {
  const known::Mixture density = two_modes();
  const PosteriorSampler sampler(density.log_density(), {VecX::Zero(4), 225.0 * MatX::Identity(4, 4)});
  const PosteriorSamples samples = sampler.run({.temperatures = 2, .draws = 500});
  std::vector<std::vector<double>> draws;
  for (const MatX& d : samples.draws) draws.emplace_back(d.col(0).begin(), d.col(0).end());
  EXPECT_GT(chain_diagnostics(draws).r_hat, 1.2);
  EXPECT_GT(samples.barrier, 0.9);
}

TEST(PosteriorSampler, HasTheMomentsOfABentDensity) {
  constexpr double b = 0.5, s = 0.5;
  const PosteriorSampler sampler(known::bent(b, s), {VecX::Zero(2), 16.0 * MatX::Identity(2, 2)});
  const PosteriorSamples samples = sampler.run({.temperatures = 8, .draws = 30000, .seed = 2});
  expect_moments(samples, (VecX(2) << 0.0, b).finished(),
                 (VecX(2) << 1.0, s * s + 2.0 * b * b).finished().asDiagonal());
}

TEST(PosteriorSampler, HoldsToWhereThereIsADensity) {
  // The half x > 0 of a standard normal: mean sqrt(2 / pi), variance 1 - 2 / pi.
  const auto half = [](const VecX& y, VecX& gradient) {
    gradient = -y;
    return y[0] > 0.0 ? -0.5 * y[0] * y[0] : -std::numeric_limits<double>::infinity();
  };
  const PosteriorSampler sampler(half, {VecX::Zero(1), 4.0 * MatX::Identity(1, 1)});
  const PosteriorSamples samples = sampler.run({.temperatures = 4, .draws = 20000});
  expect_moments(samples, VecX::Constant(1, std::sqrt(2.0 / M_PI)), MatX::Constant(1, 1, 1.0 - 2.0 / M_PI));
}

TEST(PosteriorSampler, GivesTheSameDrawsOnAnyNumberOfThreads) {
  const known::Mixture density = two_modes();
  const PosteriorSampler sampler(density.log_density(), {VecX::Zero(4), 225.0 * MatX::Identity(4, 4)});
  const PosteriorSamples one = sampler.run({.warm_up = 100, .draws = 50}),
                         three = sampler.run({.warm_up = 100, .draws = 50, .jobs = 3}),
                         other = sampler.run({.warm_up = 100, .draws = 50, .seed = 2});
  for (std::size_t k = 0; k < one.draws.size(); ++k) EXPECT_EQ(one.draws[k], three.draws[k]);
  EXPECT_NE(one.draws[0], other.draws[0]);
}

TEST(PosteriorSampler, GoesOnFromKeptStretchesBitForBit) {
  const known::NormalDensity density = correlated();
  const PosteriorSampler sampler(density.log_density(), wide_around(density.mean, density.covariance, 10.0));
  const SamplerOptions options{.warm_up = 120, .draws = 200, .thin = 2};
  const PosteriorSamples whole = sampler.run(options);
  std::map<int, SamplerStretch> store;
  int computed = 0;
  const KeptStretches kept{
      [&](int first) { return store.contains(first) ? std::optional(store[first]) : std::nullopt; },
      [&](int first, const SamplerStretch& stretch) {
        store[first] = stretch;
        ++computed;
      }};
  SamplerOptions stopped = options;
  stopped.progress = [&](double share, const std::string&) { return share < 0.6; };
  EXPECT_TRUE(sampler.run(stopped, kept).interrupted);
  const int before = computed;
  EXPECT_GT(before, 2);
  const PosteriorSamples gone_on = sampler.run(options, kept);
  EXPECT_FALSE(gone_on.interrupted);
  EXPECT_GT(computed, before);
  for (std::size_t k = 0; k < whole.draws.size(); ++k) EXPECT_EQ(whole.draws[k], gone_on.draws[k]);
  EXPECT_EQ(whole.evaluations, gone_on.evaluations);
}

TEST(PosteriorSampler, RefusesWhatIsNoCovarianceAndWhatHasNoDensity) {
  const auto nowhere = [](const VecX&, VecX&) { return -std::numeric_limits<double>::infinity(); };
  const auto density = known::bent(1.0, 1.0);
  EXPECT_THROW(PosteriorSampler(density, {VecX::Zero(2), MatX::Constant(2, 2, 1.0)}), std::domain_error);
  EXPECT_THROW(PosteriorSampler(nowhere, {VecX::Zero(2), MatX::Identity(2, 2)}).run({}), std::runtime_error);
}

// Steps of barrier 0.6, 0.1, 0.1 in three: a third of it lies below the first exponent, two thirds at 0.533, still below it; from the reference on
// exponents differ by differences, elsewhere by factors.
TEST(TemperatureLadder, IsEvenedWhereSwapsAreRejectedAlike) {
  const std::vector<double> low = evened_ladder({0.0, 0.1, 0.4, 1.0}, {0.6, 0.1, 0.1});
  ASSERT_EQ(low.size(), 4u);
  EXPECT_EQ(low[0], 0.0);
  EXPECT_NEAR(low[1], 0.1 * (0.8 / 3.0) / 0.6, 1e-12);
  EXPECT_NEAR(low[2], 0.1 * (1.6 / 3.0) / 0.6, 1e-12);
  EXPECT_EQ(low[3], 1.0);
  const std::vector<double> high = evened_ladder({0.0, 0.1, 0.4, 1.0}, {0.1, 0.1, 0.6});
  EXPECT_NEAR(high[1], 0.4 * std::pow(2.5, (0.8 / 3.0 - 0.2) / 0.6), 1e-12);
  EXPECT_NEAR(high[2], 0.4 * std::pow(2.5, (1.6 / 3.0 - 0.2) / 0.6), 1e-12);
  EXPECT_NEAR(communication_barrier({0.1, 0.1, 0.6}), 0.8, 1e-15);
}

}  // namespace sample_posterior_test
}  // namespace boresight
