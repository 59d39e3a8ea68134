#include "boresight_analyses/budget/classical.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>

#include "boresight_analyses/budget/half_cone.hpp"

namespace boresight {

double ClassicalTotal::axis_level(std::size_t axis, double probability) const {
  return std::abs(axes[axis].mean) + coverage_factor(probability) * axes[axis].sd;
}

double ClassicalTotal::radius_by_rule(Interpretation interpretation, double probability) const {
  double square = 0.0;
  if (interpretation == Interpretation::ensemble) {
    for (std::size_t a = 0; a < axes.size(); ++a) square += std::pow(axis_level(a, probability), 2);
    return std::sqrt(square);
  }
  for (const Moments& m : axes) square += m.sd * m.sd;
  const auto n = static_cast<double>(axes.size());
  return std::sqrt(square / n) * equal_axes_factor(probability, static_cast<int>(axes.size()));
}

// A turn of the axes leaves the radius: along the principal ones they are independent.
double ClassicalTotal::radius_integrated(double probability) const {
  const auto n = static_cast<Eigen::Index>(axes.size());
  VecX mean(n);
  for (Eigen::Index a = 0; a < n; ++a) mean[a] = axes[static_cast<std::size_t>(a)].mean;
  MatX own = covariance.topLeftCorner(n, n), principal = MatX::Identity(n, n);
  VecX squares = own.diagonal();
  if (!own.isDiagonal()) {
    const Eigen::SelfAdjointEigenSolver<MatX> solver(own);
    principal = solver.eigenvectors();
    squares = solver.eigenvalues();
  }
  mean = principal.transpose() * mean;
  const VecX deviation = squares.cwiseMax(0.0).cwiseSqrt();
  return radius_of(probability, {mean.data(), axes.size()}, {deviation.data(), axes.size()});
}

namespace {

double correlation_of(const ClassicalLine& a, const ClassicalLine& b) {
  if (&a == &b || (!a.group.empty() && a.group == b.group)) return 1.0;
  return a.draws && b.draws ? a.draws->correlation_with(*b.draws) : 0.0;
}

Mat3 factor_of(const ClassicalLine& line) {
  if (line.factor) return *line.factor;
  Mat3 factor = Mat3::Zero();
  for (std::size_t a = 0; a < line.axes.size(); ++a)
    factor(static_cast<Eigen::Index>(a), static_cast<Eigen::Index>(a)) = line.axes[a].sd;
  return factor;
}

}  // namespace

ClassicalTotal total_of(std::span<const ClassicalLine> lines) {
  ClassicalTotal total;
  if (lines.empty()) return total;
  total.axes.resize(lines.front().axes.size());
  std::vector<double> sizes(total.axes.size(), 0.0);
  for (const ClassicalLine& line : lines) {
    for (std::size_t a = 0; a < total.axes.size(); ++a)
      (line.either_sign ? sizes[a] : total.axes[a].mean) +=
          line.either_sign ? std::abs(line.axes[a].mean) : line.axes[a].mean;
    for (const ClassicalLine& other : lines)
      if (const double correlation = correlation_of(line, other); correlation != 0.0)
        total.covariance += correlation * factor_of(line) * factor_of(other).transpose();
  }
  for (std::size_t a = 0; a < total.axes.size(); ++a) {
    const auto at = static_cast<Eigen::Index>(a);
    total.axes[a].mean += std::copysign(sizes[a], total.axes[a].mean);
    total.axes[a].sd = std::sqrt(std::max(0.0, total.covariance(at, at)));
  }
  return total;
}

const char* to_string(RuleStanding standing) {
  static const char* const names[] = {"fair", "unsafe", "wasteful", "in doubt"};
  return names[static_cast<int>(standing)];
}

RuleStanding standing_of(double by_rule, double simulated) {
  if (by_rule < kUnsafeBelow * simulated) return RuleStanding::unsafe;
  return by_rule > kWastefulAbove * simulated ? RuleStanding::wasteful : RuleStanding::fair;
}

MemberInterval rule_over_simulated(const MemberInterval& by_rule, const MemberInterval& simulated) {
  // Levels are no less than zero, whatever few members leave.
  const double low = std::max(0.0, by_rule.low), least = std::max(0.0, simulated.low);
  constexpr double kNoBound = std::numeric_limits<double>::infinity();
  return {std::isfinite(simulated.high) && simulated.high > 0.0 ? low / simulated.high : 0.0,
          std::isfinite(by_rule.high) && least > 0.0 ? by_rule.high / least : kNoBound};
}

RuleStanding standing_of(const LevelOfMembers& by_rule, const LevelOfMembers& simulated, double nothing) {
  if (by_rule.value <= nothing && simulated.value <= nothing) return RuleStanding::fair;
  const MemberInterval ratio = rule_over_simulated(by_rule.interval, simulated.interval);
  if (ratio.high < kUnsafeBelow) return RuleStanding::unsafe;
  if (ratio.low > kWastefulAbove) return RuleStanding::wasteful;
  const bool fair = standing_of(by_rule.value, simulated.value) == RuleStanding::fair;
  return fair && ratio.low >= 1.0 / kWastefulAbove && ratio.high <= kWastefulAbove ? RuleStanding::fair
                                                                                   : RuleStanding::in_doubt;
}

}  // namespace boresight
