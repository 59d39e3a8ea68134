#include "boresight_analyses/budget/contributor_size.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace boresight {
namespace {

constexpr double kDeviationsOfSize = 3.0;

double largest_of(const DistributionPtr& distribution, double otherwise) {
  if (!distribution) return otherwise;
  const double reach = kDeviationsOfSize * distribution->sd();
  const auto end = [&](double given, double estimated) { return std::abs(std::isfinite(given) ? given : estimated); };
  return std::max(end(distribution->lowest(), distribution->mean() - reach),
                  end(distribution->highest(), distribution->mean() + reach));
}

double size_of(const ErrorCourse& error, double start, double duration, std::size_t samples) {
  double largest = 0.0;
  for (std::size_t k = 0; error.course && k <= samples; ++k)
    largest = std::max(
        largest,
        std::abs(error.course->at(start + duration * static_cast<double>(k) / static_cast<double>(samples)).value));
  return (largest > 0.0 ? largest * largest_of(error.factor, 1.0) : 0.0) + largest_of(error.value, 0.0);
}

double size_of(const MeasuredCourse& measured) {
  double largest = 0.0;
  for (const std::vector<Vec3>& stretch : measured.stretches())
    for (const Vec3& v : stretch) {
      if (!v.allFinite()) return std::numeric_limits<double>::infinity();
      largest = std::max(largest, v.cwiseAbs().maxCoeff());
    }
  return largest;
}

}  // namespace

double largest_size(const Contributor& c, const Windows& windows, double duration, std::size_t samples) {
  double largest = 0.0;
  if (c.of_error) {
    largest = size_of(*c.of_error, windows.start, duration, std::max<std::size_t>(1, samples));
  } else {
    for (int axis = 0; axis < 3 && !std::isnan(largest); ++axis) {
      const DistributionPtr& parameter = c.parameter[static_cast<std::size_t>(axis)];
      if (!parameter) continue;
      const Moments m = c.measured ? Moments{size_of(*c.measured) * largest_of(parameter, 0.0), 0.0}
                                   : moments(c, axis, ErrorIndex::ape, Interpretation::temporal, windows, duration);
      const double size = std::abs(m.mean) + kDeviationsOfSize * m.sd;
      largest = std::isnan(size) ? size : std::max(largest, size);
    }
  }
  return std::isfinite(largest) ? largest : std::numeric_limits<double>::infinity();
}

}  // namespace boresight
