#include "boresight/formulations/ideal_simulation.hpp"

#include <cmath>
#include <cstdio>
#include <limits>
#include <optional>

#include "boresight/formulations/formulation.hpp"
#include "boresight/formulations/own_modes.hpp"
#include "boresight/formulations/starting_state.hpp"
#include "boresight/integrate/explicit_runge_kutta.hpp"
#include "boresight/integrate/integrator.hpp"
#include "boresight/integrate/rosenbrock_method.hpp"
#include "boresight/math/dense_solves.hpp"
#include "boresight/mechanism/built_mechanism.hpp"
#include "boresight/mechanism/error.hpp"
#include "boresight/mechanism/interruption.hpp"
#include "boresight/mechanism/load_time.hpp"
#include "boresight/mechanism/rank_analysis.hpp"

namespace boresight {
namespace {

constexpr const char* kComparing = "comparing two simulations of the ideal motion";

// Of a mode's phase or decay, covered by one step of RK4 that is stable: its limit is 2.785.
constexpr double kStableAngle = 2.5;

// What is to be simulated.
struct Task {
  const Mechanism& mechanism;
  const Parameters& parameters;
  const IdealMotion& drives;
  const IdealState& start;
};

// Why a simulation failed, and when.
struct Failure {
  double t = 0.0;
  std::string reason;        // empty: the motion grew without bound
  bool unconfirmed = false;  // one run came to its end, and no second one
  bool too_long = false;     // shorter steps lead further, and would be too many
};

// The mechanism without clearance as an initial value problem, in joint coordinates: planar loops, redundant when drawn in
// space, are none in them, and singular positions are passed with four digits more than in absolute coordinates.
class ClosedMechanism {
 public:
  explicit ClosedMechanism(const Task& task)
      : formulation_(make_tree_formulation(task.mechanism, task.parameters, &task.drives, {.with_clearance = false})) {
    formulation_->start(task.start, start_);
  }

  const VecX& start() const { return start_; }
  // Not a number where the state cannot be followed: a trial step is then rejected.
  void derivative(double t, const VecX& y, VecX& dy) const {
    try {
      formulation_->derivative(t, y, none_, dy);
    } catch (const ComputationError& failure) {
      failure_ = {t, failure.what()};
      dy.setConstant(std::numeric_limits<double>::quiet_NaN());
    }
  }
  void stabilise(double t, VecX& y) { formulation_->stabilise(t, y); }
  // All bodies at a state; dy: room for its rate.
  IdealState bodies(double t, const VecX& y, VecX& dy) const {
    derivative(t, y, dy);
    return {t, formulation_->bodies(t, y), formulation_->acceleration()};
  }
  Formulation& formulation() { return *formulation_; }
  const Failure& failure() const { return failure_; }

 private:
  std::unique_ptr<Formulation> formulation_;
  VecX start_;
  std::vector<ContactMemory> none_;
  mutable Failure failure_;
};

using Knots = std::vector<IdealState>;

// RK4 in equal steps to `end`, every state shown to `see`: not the Integrator's loop, because the bodies are brought back into their joints after
// each step. False where the end is not reached.
template <typename See>
bool reaches(const Task& task, double end, int steps, Failure& failure, const See& see) {
  ClosedMechanism closed(task);
  VecX y = closed.start();
  ExplicitRungeKutta method(classical_rk4(), y.size());
  const double h = end / steps;
  double last = 0.0;
  const auto derivative = [&](double t, const VecX& state, VecX& dy) { closed.derivative(t, state, dy); };
  for (int i = 0; i <= steps; ++i) {
    const double t = i * h;
    work_reached("simulating the ideal motion", static_cast<double>(i) / steps);
    see(closed.bodies(t, y, method.first_slope()));
    last = t;
    if (!method.first_slope().allFinite()) break;
    if (i == steps) return true;
    method.step(t, h, y, derivative);
    if (!y.allFinite()) break;
    try {
      closed.stabilise(t + h, y);
    } catch (const ComputationError& unsettled) {
      failure = {t + h, unsettled.what()};
      return false;
    }
  }
  failure = {last, closed.failure().reason};
  return false;
}

std::optional<Knots> follow_explicit(const Task& task, double end, int steps, Failure& failure) {
  Knots knots;
  knots.reserve(steps + 1);
  if (!reaches(task, end, steps, failure, [&](IdealState&& state) { knots.push_back(std::move(state)); }))
    return std::nullopt;
  return knots;
}

// RODAS4 under error control, which steps over what springs and dampers have damped out; knots where its steps end.
std::optional<Knots> follow_implicit(const Task& task, double tolerance, long most_steps, Failure& failure) {
  const double duration = task.mechanism.duration();
  ClosedMechanism closed(task);
  VecX y = closed.start(), dy = y;
  IntegrationOptions options;
  options.relative_tolerance = tolerance;
  options.absolute_tolerances =
      VecX::Constant(y.size(), tolerance * std::min(1.0, task.mechanism.characteristic_length()));
  for (int k = 0; k < y.size(); ++k)
    if (closed.formulation().is_speed(k)) options.absolute_tolerances[k] *= std::max(1.0, 100.0 / duration);
  options.largest_step = std::min(duration / 200.0, kStepOfLoads * load_time(task.mechanism));
  options.most_steps = most_steps;
  Knots knots{closed.bodies(0.0, y, dy)};
  Integrator<RosenbrockMethod> integrator(RosenbrockMethod(rodas4(), y.size()));
  try {
    const IntegrationSummary summary = integrator.run(closed, 0.0, duration, y, options, [&](const auto& step) {
      work_reached("simulating the ideal motion", step.end() / duration);
      knots.push_back(closed.bodies(step.end(), step.state(), dy));
    });
    if (summary.completed()) return knots;
    failure = {summary.t, closed.failure().reason};
  } catch (const ComputationError& unsettled) {
    failure = {knots.back().t, unsettled.what()};
  }
  return std::nullopt;
}

// Of one body in two motions, in characteristic lengths and radians; infinity where either is nowhere.
double difference(const BodyMotion& x, const BodyMotion& y, double length) {
  const double apart = std::max((x.p - y.p).norm() / length, (x.R - y.R).norm());
  const bool known = x.p.allFinite() && y.p.allFinite() && x.R.allFinite() && y.R.allFinite();
  return known ? apart : std::numeric_limits<double>::infinity();
}

// Largest difference of two motions at the knots of the coarser one and between them.
double difference(const IdealMotion& coarse, const Knots& knots, const IdealMotion& fine, double length) {
  double worst = 0.0;
  for (std::size_t k = 0; k < knots.size(); ++k) {
    work_reached(kComparing, static_cast<double>(k) / static_cast<double>(knots.size()));
    for (const double t : {knots[k].t, 0.5 * (knots[k].t + knots[std::min(k + 1, knots.size() - 1)].t)})
      for (std::size_t b = 0; b < knots[k].bodies.size(); ++b) {
        const int body = static_cast<int>(b);
        worst = std::max(worst, difference(coarse.body(t, body), fine.body(t, body), length));
      }
  }
  return worst;
}

double difference(const Knots& coarse, const Knots& fine, double length) {
  double worst = 0.0;
  for (std::size_t k = 0; k < coarse.size(); ++k) {
    work_reached(kComparing, static_cast<double>(k) / static_cast<double>(coarse.size()));
    for (std::size_t b = 0; b < coarse[k].bodies.size(); ++b)
      worst = std::max(worst, difference(coarse[k].bodies[b], fine[2 * k].bodies[b], length));
  }
  return worst;
}

// Whether far shorter steps lead past where these failed: the motion is sound there, and they are too long for it.
bool fails_by_its_step(const Task& task, const Failure& failure, double step) {
  constexpr double kFiner = 8.0;
  constexpr int kFewest = 1 << 16, kMost = 1 << 19;
  const double end = std::min(task.mechanism.duration(), 1.5 * failure.t + 2.0 * step);
  const double steps = std::max<double>(kFewest, kFiner * end / step);
  Failure again;
  return steps <= kMost && reaches(task, end, static_cast<int>(steps), again, [](const IdealState&) {});
}

// Steps halved until two motions agree. Those that blow up are too long; but a motion that fails at the same time whatever the
// step has no step that holds. failure.too_long: nor has one that is followed only by more steps than these.
std::optional<IdealMotion> explicit_motion(const Task& task, int fewest, int most, Failure& failure) {
  constexpr int kAlike = 3;
  constexpr double kSameTime = 0.01;
  std::optional<Knots> coarse;
  Failure before;
  int alike = 0;
  for (int steps = fewest; steps <= most; steps *= 2) {
    std::optional<Knots> fine = follow_explicit(task, task.mechanism.duration(), steps, failure);
    if (coarse && fine) {
      // Fourth order: the finer run's error is a fifteenth of the difference.
      const double error = difference(*coarse, *fine, task.mechanism.characteristic_length()) / 15.0;
      if (error < IdealMotion::kAccuracy || (2 * steps > most && std::isfinite(error)))
        return IdealMotion(task.mechanism, *fine, error);
    }
    if (!fine) {
      alike = before.t > 0.0 && std::abs(failure.t - before.t) < kSameTime * failure.t ? alike + 1 : 0;
      if (alike == kAlike && !fails_by_its_step(task, failure, task.mechanism.duration() / steps)) return std::nullopt;
      before = failure;
    }
    coarse = std::move(fine);
  }
  failure.too_long = coarse || (alike == 0 && failure.reason.empty()) ||
                     fails_by_its_step(task, failure, task.mechanism.duration() / most);
  return std::nullopt;
}

// Tolerances tightened until two motions agree. Where one alone gets to its end, a looser one tells what it is wrong by; without that it is
// none, and the failure says so.
std::optional<IdealMotion> implicit_motion(const Task& task, long most_steps, Failure& failure) {
  constexpr double kFirst = 1e-9, kLast = 1e-13, kTightening = 0.1;
  const double length = task.mechanism.characteristic_length();
  std::optional<Knots> knots;
  std::optional<IdealMotion> coarse;
  double best = std::numeric_limits<double>::infinity();
  for (double tolerance = kFirst; tolerance >= kLast && best >= IdealMotion::kAccuracy; tolerance *= kTightening) {
    std::optional<Knots> finer = follow_implicit(task, tolerance, most_steps, failure);
    if (!finer) break;
    const IdealMotion fine(task.mechanism, *finer);
    // The coarser one's error, which bounds the finer one's; where it grows again, rounding has been reached.
    const double error = coarse ? difference(*coarse, *knots, fine, length) : best;
    if (error > best) break;
    best = error;
    coarse.emplace(task.mechanism, *finer, error);
    knots = std::move(finer);
  }
  if (!coarse || std::isfinite(best)) return coarse;
  Failure of_looser;
  if (const std::optional<Knots> looser = follow_implicit(task, kFirst / kTightening, most_steps, of_looser))
    best = difference(IdealMotion(task.mechanism, *looser), *looser, *coarse, length);
  if (std::isfinite(best)) return IdealMotion(task.mechanism, *knots, best);
  failure.unconfirmed = true;
  return std::nullopt;
}

}  // namespace

int undriven_freedoms(const Mechanism& mechanism) {
  if (mechanism.description().motion.pose) return 0;
  std::vector<TimeValue> laws(mechanism.joints());
  ConstraintSystem system(mechanism, {.clearance = ClearanceRows::closed});
  system.evaluate(home_state(mechanism).bodies, laws);
  return 6 * mechanism.bodies() - constraint_rank(mechanism, system);
}

bool is_kinematic(const Mechanism& mechanism) {
  if (mechanism.description().motion.pose) return true;
  return mechanism.description().initial_rates.empty() && undriven_freedoms(mechanism) == 0;
}

BuiltMotion built_motion(std::shared_ptr<const Mechanism> drawn, std::shared_ptr<const IdealMotion> commanded,
                         const Parameters& parameters) {
  if (!has_errors(parameters)) return {std::move(drawn), std::move(commanded)};
  BuiltMotion built;
  built.mechanism = built_mechanism(*drawn, parameters, std::move(commanded));
  // Whether all is driven is asked of the drawing: in the built mechanism redundant joints do not quite agree.
  built.motion = std::make_shared<const IdealMotion>(
      is_kinematic(*drawn) ? IdealMotion::kinematic(*built.mechanism) : simulated_motion(*built.mechanism, parameters));
  return built;
}

IdealMotion ideal_motion(const Mechanism& mechanism, const Parameters& parameters) {
  return is_kinematic(mechanism) ? IdealMotion::kinematic(mechanism) : simulated_motion(mechanism, parameters);
}

std::string doubt_of(const IdealMotion& motion, double error_of_built) {
  std::string doubt;
  char text[250];
  const double error = std::max(motion.error(), error_of_built);
  if (error > IdealMotion::kAccuracy) {
    std::snprintf(text, sizeof text,
                  "the ideal motion is known to %.1e of the mechanism's size, not to %.0e as it was sought; so are the "
                  "deviations from it",
                  error, IdealMotion::kAccuracy);
    doubt = text;
  }
  if (motion.lost().empty()) return doubt;
  const LostMotion& first = motion.lost().front();
  const std::size_t more = motion.lost().size() - 1;
  std::snprintf(text, sizeof text, "%sthe motion passes a singular pose at t = %.4g s%s: ", doubt.empty() ? "" : "; ",
                first.t,
                more == 0 ? "" : (", and " + std::to_string(more) + (more == 1 ? " other" : " others")).c_str());
  return doubt + text + first.description +
         ". The drawn mechanism is taken to go on smoothly; a real one may change to another branch there, and no "
         "figure here counts that in";
}

IdealMotion simulated_motion(const Mechanism& mechanism, const Parameters& parameters, const SimulationSize& most) {
  // Explicit steps beyond which an implicit method takes less time.
  constexpr int kFewestSteps = 1000, kManySteps = 16000;
  IdealState start = home_state(mechanism);
  // A motion that carries nothing but the drives' laws, which the simulation needs before there is a motion.
  const IdealMotion laws_only(mechanism, {start, [&] {
                                            IdealState end = start;
                                            end.t = mechanism.duration();
                                            return end;
                                          }()});
  std::vector<TimeValue> laws(mechanism.joints());
  laws_only.drive_laws(0.0, laws);
  start = starting_state(mechanism, laws);
  const Task task{mechanism, parameters, laws_only, start};
  ClosedMechanism closed(task);
  // How many steps an explicit method needs to be stable, to begin with.
  const double rate = fastest_own_rate(closed.formulation(), 0.0, closed.start());
  int steps = kFewestSteps;
  const double of_loads = kStepOfLoads * load_time(mechanism);
  while (steps < most.explicit_steps && steps * of_loads < mechanism.duration()) steps *= 2;
  while (steps < most.explicit_steps && steps * kStableAngle < rate * mechanism.duration()) steps *= 2;
  const bool few = steps <= kManySteps;
  std::optional<IdealMotion> motion;
  Failure failure, of_implicit;
  if (few) motion = explicit_motion(task, steps, most.explicit_steps, failure);
  if (!motion) motion = implicit_motion(task, most.implicit_steps, of_implicit);
  if (!motion && !few)
    motion = explicit_motion(task, std::min(steps, most.explicit_steps / 2), most.explicit_steps, failure);
  if (motion) return *std::move(motion);
  if (of_implicit.unconfirmed)
    throw ComputationError(
        "the ideal motion, simulated without clearance: one run came to its end, and no second one that could tell how "
        "well it is known; shorten motion.duration to what has to be seen");
  if (failure.too_long) {
    char text[250];
    std::snprintf(
        text, sizeof text,
        "the ideal motion of %.6g s, simulated without clearance, is too long to follow: it takes more than %d "
        "steps; shorten motion.duration to what has to be seen",
        mechanism.duration(), most.explicit_steps);
    throw ComputationError(text);
  }
  if (!failure.reason.empty())
    throw ComputationError("the ideal motion, simulated without clearance: " + failure.reason);
  throw ComputationError("the ideal motion, simulated without clearance, grows without bound before t = " +
                         std::to_string(failure.t) + " s, whatever the step");
}

}  // namespace boresight
