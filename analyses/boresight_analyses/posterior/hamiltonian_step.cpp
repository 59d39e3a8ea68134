#include "boresight_analyses/posterior/hamiltonian_step.hpp"

#include <algorithm>
#include <boost/math/distributions/normal.hpp>
#include <cmath>

namespace boresight {
namespace {

// Of a normal density of unit variance this is a quarter of a period on average: as far as a trajectory can lead.
constexpr double kLongest = 3.14159265358979323846;
constexpr int kMostSteps = 64;

double log_density(double beta, const ChainPlace& at) {
  return -0.5 * (1.0 - beta) * at.z.squaredNorm() + (beta > 0.0 ? beta * at.log_target : 0.0);
}

VecX slope(double beta, const ChainPlace& at) { return -(1.0 - beta) * at.z + beta * at.slope; }

}  // namespace

double StepNumbers::normal(std::uint64_t k) const {
  static const boost::math::normal standard;
  return boost::math::quantile(standard, uniform(k));
}

void see(const SampledDensity& target, ChainPlace& at, long& evaluations) {
  VecX none;
  at.slope.setZero(at.z.size());
  at.log_target = target.exact(at.z, target.guide ? none : at.slope);
  if (target.guide) target.guide(at.z, at.slope);
  ++evaluations;
}

double hamiltonian_step(const SampledDensity& target, double beta, const HamiltonianShape& shape,
                        const StepNumbers& numbers, ChainPlace& at, long& evaluations) {
  const Eigen::Index d = at.z.size();
  const double length = kLongest * numbers.uniform(0);
  const int steps = std::clamp(static_cast<int>(std::ceil(length / shape.step)), 1, kMostSteps);
  VecX v(d);
  for (Eigen::Index i = 0; i < d; ++i) v[i] = numbers.normal(static_cast<std::uint64_t>(i) + 2);
  const double before = log_density(beta, at) - 0.5 * v.squaredNorm();
  ChainPlace there = at;
  v += 0.5 * shape.step * shape.factor.transpose() * slope(beta, there);
  for (int k = 0; k < steps; ++k) {
    there.z += shape.step * shape.factor * v;
    if (target.guide && k + 1 < steps)
      target.guide(there.z, there.slope);
    else
      see(target, there, evaluations);
    if (!std::isfinite(there.log_target)) return 0.0;
    v += (k + 1 < steps ? 1.0 : 0.5) * shape.step * shape.factor.transpose() * slope(beta, there);
  }
  const double gained = log_density(beta, there) - 0.5 * v.squaredNorm() - before;
  const double probability = std::isfinite(gained) ? std::min(1.0, std::exp(gained)) : 0.0;
  if (numbers.uniform(1) < probability) at = std::move(there);
  return probability;
}

}  // namespace boresight
