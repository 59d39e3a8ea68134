#include "boresight_analyses/budget/classical.hpp"

#include <cmath>
#include <map>

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

double ClassicalTotal::radius_integrated(double probability) const {
  std::vector<double> mean, sd;
  for (const Moments& m : axes) {
    mean.push_back(m.mean);
    sd.push_back(m.sd);
  }
  return radius_of(probability, mean, sd);
}

ClassicalTotal total_of(std::span<const ClassicalLine> lines) {
  ClassicalTotal total;
  if (lines.empty()) return total;
  total.axes.resize(lines.front().axes.size());
  for (std::size_t a = 0; a < total.axes.size(); ++a) {
    double square = 0.0;
    std::map<std::string, double> together;
    for (const ClassicalLine& line : lines) {
      total.axes[a].mean += line.axes[a].mean;
      if (line.group.empty())
        square += line.axes[a].sd * line.axes[a].sd;
      else
        together[line.group] += line.axes[a].sd;
    }
    for (const auto& [group, sd] : together) square += sd * sd;
    total.axes[a].sd = std::sqrt(square);
  }
  return total;
}

const char* to_string(RuleStanding standing) {
  static const char* const names[] = {"fair", "unsafe", "wasteful"};
  return names[static_cast<int>(standing)];
}

RuleStanding standing_of(double by_rule, double simulated) {
  if (by_rule < kUnsafeBelow * simulated) return RuleStanding::unsafe;
  return by_rule > kWastefulAbove * simulated ? RuleStanding::wasteful : RuleStanding::fair;
}

}  // namespace boresight
