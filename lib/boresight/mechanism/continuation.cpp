#include "boresight/mechanism/continuation.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "boresight/mechanism/error.hpp"
#include "boresight/mechanism/ideal_motion.hpp"
#include "boresight/mechanism/interruption.hpp"
#include "boresight/mechanism/lost_motion.hpp"
#include "boresight/mechanism/unfollowed_motion.hpp"

namespace boresight {
namespace {

// The finest grid step that continuation may take: far below what any motion needs that is not singular, and a time that t still
// tells apart.
double shortest_step(double duration) { return std::max(std::min(1e-7 * duration, 1e-7), 1e-15 * duration); }

// Whether the velocities and accelerations of two states tell what lies between them: those of a smooth motion do to the step's fifth power,
// by Hermite's rule. Velocities of a pose that more than one branch passes are of none of them, and do not.
bool joined_smoothly(const IdealState& from, const IdealState& to, double length) {
  constexpr double kShare = 1e-6, kRounding = 1e-13, kDigitsOfPoses = 32.0 * std::numeric_limits<double>::epsilon();
  const double dt = to.t - from.t;
  double missed = 0.0, moved = 0.0, farthest = 0.0;
  for (std::size_t b = 0; b < from.bodies.size(); ++b) {
    const BodyMotion &x = from.bodies[b], &y = to.bodies[b];
    Vec6 way, told;
    const Eigen::AngleAxisd turn(Mat3(y.R * x.R.transpose()));
    way << y.p - x.p, turn.angle() * turn.axis();
    told << x.v + y.v, x.w + y.w;
    told = 0.5 * dt * told + dt * dt / 12.0 * (from.acceleration[b] - to.acceleration[b]);
    const Vec6 miss = way - told;
    farthest = std::max(farthest, x.p.lpNorm<Eigen::Infinity>() / length);
    missed = std::max({missed, miss.head<3>().norm() / length, miss.tail<3>().norm()});
    moved = std::max({moved, way.head<3>().norm() / length, way.tail<3>().norm()});
  }
  return missed < kShare * moved + std::max(kRounding, kDigitsOfPoses * farthest);
}

// One step. A pose near a singular one whose velocities do not go on from those before it is not asked for them: the motion is solved beyond
// it, from before it, and laid through it. Where neither distance beyond it joins on smoothly the pose is left as it was solved.
bool step_to(IdealSolver& solver, double t, IdealState& state, const Mechanism& mechanism) {
  constexpr double kNearlySingular = 1e-3;
  const double length = mechanism.characteristic_length();
  const IdealState before = state;
  if (!solver.solve(t, state)) return false;
  if (joined_smoothly(before, state, length) || weakest_lock(mechanism, solver.system()) > kNearlySingular) return true;
  for (const double further : {1.0, 0.5, 2.0, 0.25, 4.0}) {
    IdealState beyond = before;
    if (!solver.solve(t + further * (t - before.t), beyond) || !joined_smoothly(before, beyond, length)) continue;
    IdealMotion(mechanism, {before, beyond}).state(t, state);
    break;
  }
  return true;
}

}  // namespace

bool follow(IdealSolver& solver, double t, IdealState& state, const Mechanism& mechanism, int most_steps,
            double& step) {
  step = t - state.t;
  for (int steps = 0; state.t < t;) {
    const double next = t - state.t <= step * 1.0000001 ? t : state.t + step;
    if (step_to(solver, next, state, mechanism)) {
      if (++steps > most_steps) return false;
      if (state.t < t) step *= 2.0;
    } else if ((step *= 0.5) < shortest_step(mechanism.duration())) {
      char time[40];
      std::snprintf(time, sizeof time, "t = %.6g s", state.t);
      throw ComputationError(std::string("the ideal motion cannot be followed beyond ") + time + ": " +
                             why_not_followed(mechanism, state.t, shortest_step(mechanism.duration())));
    }
    work_reached("following the ideal motion", state.t / mechanism.duration());
  }
  return true;
}

}  // namespace boresight
