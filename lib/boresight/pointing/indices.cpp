#include "boresight/pointing/indices.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include "boresight/math/cross_matrix.hpp"

namespace boresight {
namespace {

// Angle between two vectors, exact to rounding at small and at straight angles alike (Kahan's form loses nothing at 0).
double angle_between(const Vec3& a, const Vec3& b) { return std::atan2(a.cross(b).norm(), a.dot(b)); }

Vec3 rotation_vector(Quat q) {
  if (q.w() < 0.0) q.coeffs() *= -1.0;
  const double sine = q.vec().norm();
  if (sine < 1e-12) return 2.0 * q.vec();
  return (2.0 * std::atan2(sine, q.w()) / sine) * q.vec();
}

// The turn that takes z to `direction`, about an axis across z.
Vec3 turn_of_z(const Vec3& direction) {
  const double sine = std::hypot(direction.x(), direction.y());
  if (sine == 0.0) return Vec3::Zero();
  const double angle = std::atan2(sine, direction.z());
  return angle / sine * Vec3(-direction.y(), direction.x(), 0.0);
}

Vec3 turn_between(const Vec3& truth, const Vec3& ideal) {
  return turn_of_z(Quat::FromTwoVectors(ideal, Vec3::UnitZ()) * truth.normalized());
}

// Between the line to the target and the same line with its start displaced by d. The lines themselves may be as long as an
// orbit is high: their difference would have lost the digits that d has.
double turn_of_line(const Vec3& line, const Vec3& d) {
  return std::atan2(d.cross(line).norm(), line.squaredNorm() - line.dot(d));
}

}  // namespace

Eigen::Matrix<double, 3, 6> LineOfSight::gain(const Pose& ideal) const {
  // d = dp + turn x r, turn of the line = d x s / |s|^2.
  const Vec3 s = line(ideal);
  Eigen::Matrix<double, 3, 6> gain = Eigen::Matrix<double, 3, 6>::Zero();
  if (!(s.squaredNorm() > 0.0)) return gain;
  gain.leftCols<3>() = -cross_matrix(s) / s.squaredNorm();
  gain.rightCols<3>() = cross_matrix(s) * cross_matrix(ideal.q * from_B) / s.squaredNorm();
  return gain;
}

PoseError pose_error(const Pose& truth, const Pose& ideal, const Pointing& pointing) {
  PoseError e;
  e.displacement = truth.p - ideal.p;
  e.rotation = rotation_vector(truth.q * ideal.q.conjugate());
  e.position = e.displacement.norm();
  e.orientation = e.rotation.norm();
  e.boresight = angle_between(truth.q * pointing.boresight_B, ideal.q * pointing.boresight_B);
  if (const auto& sight = pointing.line_of_sight)
    e.line_of_sight = turn_of_line(sight->line(ideal), sight->displacement(truth, ideal));
  return e;
}

Vec3 error_vector(PointingQuantity quantity, const Pose& truth, const Pose& ideal, const Pointing& pointing) {
  switch (quantity) {
    case PointingQuantity::position_error:
      return truth.p - ideal.p;
    case PointingQuantity::orientation_error:
      return ideal.q.conjugate() * rotation_vector(truth.q * ideal.q.conjugate());
    case PointingQuantity::boresight_error:
      return turn_between(ideal.q.conjugate() * (truth.q * pointing.boresight_B), pointing.boresight_B);
    case PointingQuantity::line_of_sight_error: {
      if (!pointing.line_of_sight) return Vec3::Zero();
      const LineOfSight& sight = *pointing.line_of_sight;
      const Vec3 line = sight.line(ideal), d = sight.displacement(truth, ideal), axis = d.cross(line);
      if (!(axis.norm() > 0.0)) return Vec3::Zero();
      Vec3 turn = Quat::FromTwoVectors(sight.reversed ? Vec3(-line) : line, Vec3::UnitZ()) *
                  Vec3(turn_of_line(line, d) / axis.norm() * axis);
      turn.z() = 0.0;  // across the line but for rounding
      return turn;
    }
  }
  return Vec3::Zero();
}

Eigen::Matrix<double, 3, 6> error_gain(PointingQuantity quantity, const Pose& ideal, const Vec3& axis,
                                       const std::optional<LineOfSight>& line_of_sight) {
  Eigen::Matrix<double, 3, 6> gain = Eigen::Matrix<double, 3, 6>::Zero();
  switch (quantity) {
    case PointingQuantity::position_error:
      gain.leftCols<3>().setIdentity();
      break;
    case PointingQuantity::orientation_error:
      gain.rightCols<3>().setIdentity();
      break;
    case PointingQuantity::boresight_error:
      gain.rightCols<3>() = -cross_matrix(axis);
      break;
    case PointingQuantity::line_of_sight_error:
      if (!line_of_sight) throw std::logic_error("no line of sight: the mechanism names no target");
      return line_of_sight->gain(ideal);
  }
  return gain;
}

void StatisticsOverTime::reserve(std::size_t steps) {
  time_.reserve(steps);
  value_.reserve(steps);
}

void StatisticsOverTime::add(double t, double value) {
  if (t < start_) {
    last_time_ = t;
    last_value_ = value;
    before_ = true;
    return;
  }
  if (before_ && t > start_) {
    time_.push_back(start_);
    value_.push_back(last_value_ + (start_ - last_time_) / (t - last_time_) * (value - last_value_));
  }
  before_ = false;
  time_.push_back(t);
  value_.push_back(value);
}

Statistics StatisticsOverTime::result() const { return TimeWeights(time_).of(value_); }

std::array<double, kPeakParts> StatisticsOverTime::peaks() const {
  std::array<double, kPeakParts> peaks = {};
  if (time_.empty()) return peaks;
  const double first = time_.front(), length = time_.back() - first;
  for (std::size_t i = 0; i < time_.size(); ++i) {
    const int part = length > 0.0 ? static_cast<int>(kPeakParts * ((time_[i] - first) / length)) : 0;
    double& peak = peaks[static_cast<std::size_t>(std::min(part, kPeakParts - 1))];
    peak = std::max(peak, value_[i]);
  }
  return peaks;
}

TimeWeights::TimeWeights(std::span<const double> times)
    : time_(times.begin(), times.end()), weight_(times.size(), 0.0) {
  const std::size_t n = time_.size();
  for (std::size_t i = 0; i + 1 < n; ++i) {
    const double half = 0.5 * (time_[i + 1] - time_[i]);
    weight_[i] += half;
    weight_[i + 1] += half;
  }
  const double total = std::accumulate(weight_.begin(), weight_.end(), 0.0);
  if (total > 0.0)
    total_ = total;
  else
    std::fill(weight_.begin(), weight_.end(), 1.0 / static_cast<double>(n));
}

Statistics TimeWeights::of(std::span<const double> values) const {
  Statistics s;
  if (values.empty()) return s;
  if (const std::size_t place = place_of_max(values); values[place] > s.max) {
    s.max = values[place];
    s.time_of_max = time_[place];
  }
  s.mean = mean(values);
  s.rms = rms(values);
  s.p9973 = p9973(values);
  return s;
}

std::size_t TimeWeights::place_of_max(std::span<const double> values) const {
  return static_cast<std::size_t>(std::max_element(values.begin(), values.end()) - values.begin());
}

double TimeWeights::mean(std::span<const double> values) const {
  double sum = 0.0;
  for (std::size_t i = 0; i < values.size(); ++i) sum += weight_[i] * values[i];
  return sum / total_;
}

double TimeWeights::rms(std::span<const double> values) const {
  double sum = 0.0;
  for (std::size_t i = 0; i < values.size(); ++i) sum += weight_[i] * values[i] * values[i];
  return std::sqrt(sum / total_);
}

// Only the highest values matter: walk down from the top until 0.27 % of the time lies above.
double TimeWeights::p9973(std::span<const double> values) const {
  const double above_allowed = (1.0 - 0.9973) * total_;
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto higher = [&](std::size_t a, std::size_t b) { return values[a] > values[b]; };
  double above = 0.0;
  // Some at a time: where the times are even it ends among the first.
  for (auto sorted = order.begin(); sorted != order.end();) {
    const auto some = sorted + std::min<std::ptrdiff_t>(order.end() - sorted, 16 + (order.end() - order.begin()) / 256);
    std::partial_sort(sorted, some, order.end(), higher);
    for (; sorted != some; ++sorted) {
      above += weight_[*sorted];
      if (above > above_allowed) return values[*sorted];
    }
  }
  return values[order.back()];
}

void IndicesOverTime::reserve(std::size_t steps) {
  for (StatisticsOverTime* s : {&position_, &orientation_, &boresight_}) s->reserve(steps);
  if (has_line_of_sight_) line_of_sight_.reserve(steps);
}

void IndicesOverTime::add(double t, const PoseError& error) {
  position_.add(t, error.position);
  orientation_.add(t, error.orientation);
  boresight_.add(t, error.boresight);
  if (has_line_of_sight_) line_of_sight_.add(t, error.line_of_sight);
}

PeaksOfParts IndicesOverTime::peaks() const {
  return {position_.peaks(), orientation_.peaks(), boresight_.peaks(), line_of_sight_.peaks()};
}

PointingIndices IndicesOverTime::result() const {
  return {position_.result(), orientation_.result(), boresight_.result(), line_of_sight_.result(), has_line_of_sight_};
}

}  // namespace boresight
