// The pointing indices: what a motion's errors come to, over time.
//
//   position_error       length of p_true - p_ideal of the boresight body's centre of mass [m]
//   orientation_error    angle of the rotation from ideal to true orientation [rad]
//   boresight_error      angle between true and ideal pointing axis [rad]
//   line_of_sight_error  angle at the target between the true and the ideal reference point: between the two lines of sight
//                        from there to the target; only where the mechanism names one (pointing.hpp) [rad]
//
// Statistics weigh each accepted step by the time it covers, so that they do not depend on how an integrator steps.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "boresight/pointing/pointing.hpp"

namespace boresight {

enum class PointingQuantity { position_error, orientation_error, boresight_error, line_of_sight_error };
inline constexpr int kPointingQuantities = 4;
// One number a PointingQuantity, in the order of their declaration.
using PerQuantity = std::array<double, kPointingQuantities>;

// Error of a pose against the ideal one.
struct PoseError {
  Vec3 displacement = Vec3::Zero();  // world axes [m]
  Vec3 rotation = Vec3::Zero();      // rotation vector from ideal to true, world axes [rad]
  double position = 0.0, orientation = 0.0, boresight = 0.0, line_of_sight = 0.0;  // the four indices, see above
};

// line_of_sight stays zero where nothing is sighted.
PoseError pose_error(const Pose& truth, const Pose& ideal, const Pointing& pointing);

// The same error as a vector whose length is the index, for budgets per axis:
//   position_error       displacement, world axes [m]
//   orientation_error    rotation vector from ideal to true, axes of the ideal body [rad]
//   boresight_error      turn of the pointing axis about the two axes across the ideal one, third component zero [rad];
//                        the two are the body's x and y where its z points, else these turned the shortest way from z
//                        to the pointing axis
//   line_of_sight_error  the same of the line of sight (LineOfSight::reversed), with the world's axes for the body's [rad];
//                        zero where nothing is sighted
Vec3 error_vector(PointingQuantity quantity, const Pose& truth, const Pose& ideal, const Pointing& pointing);
// To first order, all of it in world axes: for a displacement of the centre of mass and a rotation of the body (six numbers)
// the displacement, the rotation, the change of the pointing axis (a unit vector) or the turn of the line of sight. Its length
// is the index [m or rad for m and rad]. axis: the ideal pointing axis, world axes. Throws std::logic_error for a line of
// sight where nothing is sighted.
Eigen::Matrix<double, 3, 6> error_gain(PointingQuantity quantity, const Pose& ideal, const Vec3& axis,
                                       const std::optional<LineOfSight>& line_of_sight);

struct Statistics {
  double max = 0.0, rms = 0.0, mean = 0.0, p9973 = 0.0;  // p9973: the value not exceeded for 99.73 % of the time
  double time_of_max = 0.0;                              // [s]
};

struct PointingIndices {
  Statistics position_error, orientation_error, boresight_error, line_of_sight_error;
  bool has_line_of_sight = false;  // else line_of_sight_error means nothing

  const Statistics& of(PointingQuantity quantity) const {
    const Statistics* const all[] = {&position_error, &orientation_error, &boresight_error, &line_of_sight_error};
    return *all[static_cast<int>(quantity)];
  }
};

// The largest values of each quantity in parts of the motion, of equal length from its start on: where motions go their own ways late, that of
// another part may be the largest of the next one.
inline constexpr int kPeakParts = 32;
using PeaksOfParts = std::array<std::array<double, kPeakParts>, kPointingQuantities>;

// The times at which a scalar is known, each of which stands for half the gap to either neighbour; and statistics of its values there.
class TimeWeights {
 public:
  explicit TimeWeights(std::span<const double> times);

  Statistics of(std::span<const double> values) const;
  std::size_t place_of_max(std::span<const double> values) const;
  double mean(std::span<const double> values) const;
  double rms(std::span<const double> values) const;
  double p9973(std::span<const double> values) const;

 private:
  std::vector<double> time_, weight_;
  double total_ = 1.0;
};

// Gathers one scalar over time. add() takes non-decreasing times; each value stands for half the gap to either neighbour.
class StatisticsOverTime {
 public:
  // What comes before `start` is left out; a step across it counts from there, its value there by a straight line.
  explicit StatisticsOverTime(double start = 0.0) : start_(start) {}
  void reserve(std::size_t steps);
  void add(double t, double value);
  Statistics result() const;
  std::array<double, kPeakParts> peaks() const;

 private:
  double start_, last_time_ = 0.0, last_value_ = 0.0;
  bool before_ = false;  // the last value lies before the start
  std::vector<double> time_, value_;
};

class IndicesOverTime {
 public:
  explicit IndicesOverTime(bool has_line_of_sight = false, double start = 0.0)
      : has_line_of_sight_(has_line_of_sight),
        position_(start),
        orientation_(start),
        boresight_(start),
        line_of_sight_(start) {}
  void reserve(std::size_t steps);
  void add(double t, const PoseError& error);
  PointingIndices result() const;
  PeaksOfParts peaks() const;

 private:
  bool has_line_of_sight_;
  StatisticsOverTime position_, orientation_, boresight_, line_of_sight_;
};

}  // namespace boresight
