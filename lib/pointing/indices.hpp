// The pointing indices: what a motion's errors come to, over time.
//
//   position_error       length of p_true - p_ideal of the boresight body's centre of mass [m]
//   orientation_error    angle of the rotation from ideal to true orientation [rad]
//   boresight_error      angle between true and ideal pointing axis [rad]
//   line_of_sight_error  angle at the world origin between true and ideal position of the centre of mass [rad]
//
// Statistics weigh each accepted step by the time it covers, so that they do not depend on how an integrator steps.
#pragma once

#include <vector>

#include "boresight/math/types.hpp"

namespace boresight {

enum class PointingQuantity { position_error, orientation_error, boresight_error, line_of_sight_error };

struct Pose {
  Vec3 p = Vec3::Zero();       // p_WB, centre of mass, world [m]
  Quat q = Quat::Identity();   // R_WB
};

// Error of a pose against the ideal one.
struct PoseError {
  Vec3 displacement = Vec3::Zero();  // world axes [m]
  Vec3 rotation = Vec3::Zero();      // rotation vector from ideal to true, world axes [rad]
  double position = 0.0, orientation = 0.0, boresight = 0.0, line_of_sight = 0.0;  // the four indices, see above
};

// boresight_B: the pointing axis in body axes, unit length.
PoseError pose_error(const Pose& truth, const Pose& ideal, const Vec3& boresight_B);

// The same error as a vector whose length is the index, for budgets per axis:
//   position_error       displacement, world axes [m]
//   orientation_error    rotation vector from ideal to true, axes of the ideal body [rad]
//   boresight_error      turn of the pointing axis about the two axes across the ideal one, third component zero [rad];
//                        the two are the body's x and y where its z points, else these turned the shortest way from z
//                        to the pointing axis
//   line_of_sight_error  the same of the line from the world origin to the centre of mass, in world axes [rad]
Vec3 error_vector(PointingQuantity quantity, const Pose& truth, const Pose& ideal, const Vec3& boresight_B);

struct Statistics {
  double max = 0.0, rms = 0.0, mean = 0.0, p9973 = 0.0;  // p9973: the value not exceeded for 99.73 % of the time
  double time_of_max = 0.0;                              // [s]
};

struct PointingIndices {
  Statistics position_error, orientation_error, boresight_error, line_of_sight_error;
};

// Gathers one scalar over time. add() takes non-decreasing times; each value stands for half the gap to either neighbour.
class StatisticsOverTime {
 public:
  void reserve(std::size_t steps);
  void add(double t, double value);
  Statistics result() const;

 private:
  std::vector<double> time_, value_;
};

class IndicesOverTime {
 public:
  void reserve(std::size_t steps);
  void add(double t, const PoseError& error);
  PointingIndices result() const;

 private:
  StatisticsOverTime position_, orientation_, boresight_, line_of_sight_;
};

}  // namespace boresight
