// The times that a scene gives an integrator, in place of those of any other scene: how long a journal flies through its
// clearance, and how fast the mechanism itself moves.
#pragma once

#include <limits>
#include <vector>

#include "boresight/integrate/integration_options.hpp"
#include "boresight/mechanism/ideal_motion.hpp"

namespace boresight {

// What a step may take of the own time below: an error estimate sees what a step of this size leaves out.
inline constexpr double kTurnOfAStep = 0.5;

struct MotionScales {
  // In which a journal, let go at rest, crosses the smallest clearance under what its joint carries [s]; where nothing
  // drives it, the time below. Speeds are held to the tolerance of positions over this time.
  double flight_time = std::numeric_limits<double>::infinity();
  // In which the fastest body of the ideal motion turns by a radian or moves by the mechanism's size, or would from rest [s].
  double own_time = std::numeric_limits<double>::infinity();
  double load_time =
      std::numeric_limits<double>::infinity();  // in which a load changes by all that it does: load_time.hpp [s]
  double largest_acceleration = 0.0;            // of a journal that is let go [m/s^2]

  // Of one joint: its gaps, and the mean square and largest acceleration of its journal when let go [m/s^2].
  void add_joint(const ClearanceParameters& play, double acceleration_rms, double acceleration_max);
  // With what is left open closed by the duration; times are never longer than it.
  void close(double duration);
  // Into the options: the largest step and the floor of events.
  void apply(double duration, double slowest_impact, IntegrationOptions& options) const;
};

// 1 / the largest rate of any body in the ideal motion, or the root of an acceleration [s]; infinite where nothing moves. size [m].
double own_time(const IdealMotion& ideal, int bodies, double size);

}  // namespace boresight
