#include "boresight/stepping/motion_scales.hpp"

#include <algorithm>
#include <cmath>

namespace boresight {
namespace {

constexpr int kInstants = 97;          // no divisor of the cycles that a motion is likely to have
constexpr double kTurnOfAStep = 0.5;   // [rad] an error estimate sees what a step of this size leaves out
constexpr double kLeastSteps = 100.0;  // of any motion

}  // namespace

double own_time(const IdealMotion& ideal, int bodies, double size) {
  double fastest = 0.0;
  for (int i = 0; i < kInstants; ++i)
    for (int b = 0; b < bodies; ++b) {
      const BodyMotion body = ideal.body(ideal.duration() * i / (kInstants - 1), b);
      fastest = std::max({fastest, body.w.norm(), body.v.norm() / size});
    }
  return 1.0 / fastest;
}

void MotionScales::add_joint(const ClearanceParameters& play, double acceleration_rms, double acceleration_max) {
  largest_acceleration = std::max(largest_acceleration, acceleration_max);
  for (const auto gap : kGaps)
    if (play.*gap > 0.0 && acceleration_rms > 0.0)
      flight_time = std::min(flight_time, std::sqrt(2.0 * play.*gap / acceleration_rms));
}

void MotionScales::close(double duration) {
  own_time = std::min(own_time, duration);
  flight_time = std::min(flight_time, own_time);
}

void MotionScales::apply(double duration, double slowest_impact, IntegrationOptions& options) const {
  // A step that was asked for is taken as it is.
  if (options.step == 0.0) options.largest_step = std::min(duration / kLeastSteps, kTurnOfAStep * own_time);
  // A flight this short ends below the slowest impact speed that a contact latches: nothing is lost by not locating it.
  if (largest_acceleration > 0.0 && slowest_impact > 0.0)
    options.event_floor = std::min(options.event_floor, 2.0 * slowest_impact / largest_acceleration);
}

}  // namespace boresight
