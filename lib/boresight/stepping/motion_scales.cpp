#include "boresight/stepping/motion_scales.hpp"

#include <algorithm>
#include <cmath>

#include "boresight/mechanism/interruption.hpp"
#include "boresight/mechanism/load_time.hpp"

namespace boresight {
namespace {

constexpr int kInstants = 97;  // no divisor of the cycles that a motion is likely to have
// A motion that takes more knots than this may be fast for a moment only: each of them is looked at, up to so many.
constexpr int kFewKnots = 8192, kMostInstants = 1 << 17;
constexpr double kLeastSteps = 100.0;  // of any motion

}  // namespace

double own_time(const IdealMotion& ideal, int bodies, double size) {
  double fastest = 0.0;
  const int instants = ideal.knots() > kFewKnots ? std::min(ideal.knots(), kMostInstants) : kInstants;
  IdealState state;
  for (int i = 0; i < instants; ++i) {
    work_reached("looking how fast the ideal motion is", static_cast<double>(i) / instants);
    ideal.state(ideal.duration() * i / (instants - 1), state);
    for (int b = 0; b < bodies; ++b) {
      const BodyMotion& body = state.bodies[b];
      const BodyAcceleration& change = state.acceleration[b];
      fastest = std::max({fastest, body.w.norm(), body.v.norm() / size, std::sqrt(change.tail<3>().norm()),
                          std::sqrt(change.head<3>().norm() / size)});
    }
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
  if (options.step == 0.0)
    options.largest_step = std::min({duration / kLeastSteps, kTurnOfAStep * own_time, kStepOfLoads * load_time});
  // A flight this short ends below the slowest impact speed that a contact latches: nothing is lost by not locating it.
  if (largest_acceleration > 0.0 && slowest_impact > 0.0)
    options.event_floor = std::min(options.event_floor, 2.0 * slowest_impact / largest_acceleration);
}

}  // namespace boresight
