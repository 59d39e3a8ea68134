#include "boresight_analyses/budget/spectral_level.hpp"

#include <gsl/gsl_cdf.h>

#include <cmath>
#include <limits>

#include "boresight_analyses/budget/budget_runs.hpp"

namespace boresight {
namespace {

// Mean and variance of the members' mean squares, one after the other.
struct MemberSquares {
  double count = 0.0, mean = 0.0, squares = 0.0;

  void add(double value) {
    const double off = value - mean;
    count += 1.0;
    mean += off / count;
    squares += off * (value - mean);
  }
  double variance() const { return squares / (count - 1.0); }
};

SpectralLevel level_of(const MemberSquares& seen, double alpha) {
  SpectralLevel level;
  level.simulated = std::sqrt(seen.mean);
  level.high = std::numeric_limits<double>::infinity();
  if (!(seen.mean > 0.0) || seen.count < 2.0) return level;
  const double freedom = 2.0 * seen.mean * seen.mean * seen.count / seen.variance();
  const double middle = 1.0 - 2.0 / (9.0 * freedom);
  const double side = gsl_cdf_tdist_Qinv(0.5 * alpha, seen.count - 1.0) * std::sqrt(2.0 / (9.0 * freedom));
  level.low = level.simulated / std::pow(middle + side, 1.5);
  if (middle > side) level.high = level.simulated / std::pow(middle - side, 1.5);
  return level;
}

}  // namespace

std::vector<SpectralLevel> spectral_levels(const BudgetPlan& plan) {
  const std::vector<ErrorIndex> indices = plan.indices();
  const std::vector<Draws> draws = draws_of(plan.contributors, plan.correlations);
  std::size_t noises = 0;
  for (const Contributor& c : plan.contributors) noises += c.noise != nullptr;
  // Mean squares of slow noise have longer tails than a chi-squared variable of estimated freedom, up to twice as many beyond such ends.
  constexpr double kOfTails = 0.5;
  const double alpha = kOfTails * kFalseFlags / static_cast<double>(std::max<std::size_t>(1, noises * indices.size()));
  std::vector<SpectralLevel> out;
  for (std::size_t i = 0; i < plan.contributors.size(); ++i) {
    Contributor c = plan.contributors[i];
    if (!c.noise) continue;
    c.frame.setIdentity();  // on its own axes
    double square_of_factor = 0.0, axes = 0.0;
    for (const DistributionPtr& factor : c.parameter)
      if (factor) {
        square_of_factor = factor->mean() * factor->mean() + factor->sd() * factor->sd();
        axes += 1.0;
      }
    std::vector<MemberSquares> seen(indices.size());
    for (std::uint64_t member = 0; member < plan.members; ++member) {
      const PointingHistory history{
          plan.sampling, course(c, plan.seed, member, draws[i], plan.sampling, samples_of(plan), plan.windows)};
      for (std::size_t k = 0; k < indices.size(); ++k) {
        const std::vector<Vec3> values = index_values(indices[k], history, plan.windows);
        double sum = 0.0;
        for (const Vec3& v : values) sum += v.squaredNorm();
        seen[k].add(sum / (axes * static_cast<double>(values.size())));
      }
    }
    for (std::size_t k = 0; k < indices.size(); ++k) {
      SpectralLevel level = level_of(seen[k], alpha);
      level.contributor = c.name;
      level.index = indices[k];
      level.by_filter = std::sqrt(square_of_factor * c.noise->variance(indices[k], plan.windows));
      level.above_sampling = c.noise_course->power_above_sampling();
      level.differs = (level.by_filter < level.low || level.by_filter > level.high) &&
                      std::abs(level.simulated / level.by_filter - 1.0) > kTolerable;
      out.push_back(level);
    }
  }
  return out;
}

}  // namespace boresight
