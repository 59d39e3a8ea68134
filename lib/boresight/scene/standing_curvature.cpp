#include "boresight/scene/standing_curvature.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "boresight/scene/standing_model_error.hpp"

namespace boresight {
namespace {

// What the tried errors displace bodies by: far above what the closure rounds, far below what bends once more.
constexpr double kTried = 1e-4;
// Draws of signs, and of those at the size that is typical, each there and back: towards a singular pose more is missed than away from it.
constexpr int kDraws = 16, kDrawsOfSize = 3;

double of_quantity(const PoseError& error, PointingQuantity quantity) {
  switch (quantity) {
    case PointingQuantity::position_error:
      return error.position;
    case PointingQuantity::orientation_error:
      return error.orientation;
    case PointingQuantity::boresight_error:
      return error.boresight;
    case PointingQuantity::line_of_sight_error:
      return error.line_of_sight;
  }
  return 0.0;
}

}  // namespace

StandingCurvature::StandingCurvature(const Mechanism& mechanism, const IdealMotion& commanded,
                                     const StandingErrors& influence, PointingQuantity quantity,
                                     const std::vector<double>& typical)
    : size_(static_cast<std::size_t>(influence.count()), 0.0) {
  Vec6 scale;
  scale << Vec3::Constant(1.0 / mechanism.characteristic_length()), Vec3::Ones();
  for (int k = 0; k <= influence.cells(); ++k)
    for (int b = 0; b < mechanism.bodies(); ++b) {
      const MatX moved = scale.asDiagonal() * influence.at_knot(k, b);
      for (std::size_t e = 0; e < size_.size(); ++e)
        size_[e] = std::max(size_[e], moved.col(static_cast<Eigen::Index>(e)).norm());
    }
  Parameters tried = mechanism.parameters();
  const auto look = [&](bool must_close) {
    const std::optional<PoseError> missed = missed_by_linearity(mechanism, commanded, influence, tried);
    double squares = 0.0;
    for (std::size_t e = 0; e < size_.size(); ++e) squares += std::pow(tried.error[e] * size_[e], 2);
    if (!missed && !must_close) return;
    const double found = missed ? of_quantity(*missed, quantity) / squares : std::numeric_limits<double>::infinity();
    curvature_ = std::max(curvature_, found);
  };
  std::vector<std::size_t> acting;
  for (std::size_t e = 0; e < size_.size(); ++e)
    if (size_[e] > 0.0) acting.push_back(e);
  for (const std::size_t e : acting) {
    std::fill(tried.error.begin(), tried.error.end(), 0.0);
    tried.error[e] = kTried / size_[e];
    look(true);
  }
  std::vector<double> displaces(size_.size(), 0.0);
  double sum_of_squares = 0.0, largest = 0.0;
  for (const std::size_t e : acting) {
    displaces[e] = typical.empty() ? 1.0 : std::abs(typical[e]) * size_[e];
    sum_of_squares += displaces[e] * displaces[e];
    largest = std::max(largest, displaces[e]);
  }
  // One alone has been looked at.
  const bool together = sum_of_squares > (1.0 + 1e-9) * largest * largest;
  std::mt19937_64 random(1);
  for (int draw = 0; draw < kDraws && together; ++draw) {
    for (const std::size_t e : acting)
      tried.error[e] = (random() >> 63 ? kTried : -kTried) * displaces[e] / (std::sqrt(sum_of_squares) * size_[e]);
    look(true);
  }
  // Beside a singular pose even these bend by higher orders than the second, which a small displacement does not show.
  for (int draw = 0; draw < kDrawsOfSize && !typical.empty() && sum_of_squares > kTried * kTried; ++draw) {
    for (const std::size_t e : acting) tried.error[e] = random() >> 63 ? typical[e] : -typical[e];
    look(false);
    for (const std::size_t e : acting) tried.error[e] = -tried.error[e];
    look(false);
  }
}

double StandingCurvature::error(const std::vector<double>& errors, double index) const {
  double squares = 0.0;
  for (std::size_t e = 0; e < size_.size(); ++e) squares += errors[e] * size_[e] * (errors[e] * size_[e]);
  const double missed = squares > 0.0 ? curvature_ * squares : 0.0;
  return index > 0.0 ? missed / index : missed > 0.0 ? 1.0 : 0.0;
}

}  // namespace boresight
