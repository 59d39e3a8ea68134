#include "boresight_analyses/budget/draws.hpp"

#include <Eigen/Cholesky>
#include <boost/math/special_functions/erf.hpp>
#include <cmath>
#include <stdexcept>

namespace boresight {
namespace {

// Throws std::domain_error unless it is a correlation matrix that leaves every one something of its own.
MatX factor_of(const MatX& correlation) {
  const Eigen::LLT<MatX> factored(correlation);
  constexpr double kOwn = 1e-6;
  if (factored.info() != Eigen::Success || MatX(factored.matrixL()).diagonal().minCoeff() < kOwn)
    throw std::domain_error("no correlation matrix");
  return factored.matrixL();
}

}  // namespace

double Draws::correlation_with(const Draws& other) const {
  double sum = 0.0;
  for (const Part& own : parts)
    for (const Part& one : other.parts)
      if (own.stream == one.stream) sum += own.weight * one.weight;
  return sum;
}

std::vector<Draws> draws_of(const std::vector<std::uint64_t>& streams,
                            const std::vector<ContributorCorrelation>& correlations) {
  if (correlations.empty()) return {streams.begin(), streams.end()};
  const auto n = static_cast<Eigen::Index>(streams.size());
  MatX correlation = MatX::Identity(n, n);
  for (const ContributorCorrelation& c : correlations) {
    const auto a = static_cast<Eigen::Index>(streams[c.first]), b = static_cast<Eigen::Index>(streams[c.second]);
    correlation(a, b) = correlation(b, a) = c.coefficient;
  }
  const MatX lower = factor_of(correlation);
  std::vector<Draws> out;
  for (const std::uint64_t stream : streams) {
    std::vector<Draws::Part> parts;
    for (Eigen::Index j = 0; j <= static_cast<Eigen::Index>(stream); ++j)
      if (const double weight = lower(static_cast<Eigen::Index>(stream), j); weight != 0.0)
        parts.push_back({static_cast<std::uint64_t>(j), weight});
    out.emplace_back(std::move(parts));
  }
  return out;
}

Mat3 axes_of_correlation(double xy, double xz, double yz) {
  MatX correlation(3, 3);
  correlation << 1.0, xy, xz, xy, 1.0, yz, xz, yz, 1.0;
  return factor_of(correlation);
}

double MixedNumbers::to_normal(double uniform) { return -std::sqrt(2.0) * boost::math::erfc_inv(2.0 * uniform); }

double MixedNumbers::to_uniform(double normal) { return 0.5 * std::erfc(-normal / std::sqrt(2.0)); }

}  // namespace boresight
