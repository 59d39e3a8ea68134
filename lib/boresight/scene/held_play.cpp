#include "boresight/scene/held_play.hpp"

#include <algorithm>
#include <cmath>

#include "boresight/mechanism/generic_instant.hpp"
#include "boresight/mechanism/load_time.hpp"
#include "boresight/mechanism/play_mobility.hpp"
#include "boresight/rungs/motion_recorder.hpp"
#include "boresight/scene/standing_errors.hpp"
#include "boresight/stepping/unstable_step.hpp"

namespace boresight {

std::vector<std::string> held_plays(const Mechanism& mechanism, const IdealMotion& ideal) {
  IdealState state;
  ideal.state(generic_instant(0.0, ideal.duration()), state);
  return held_plays(mechanism, analyse_play(mechanism, state.bodies));
}

namespace {

// A peak may be higher than at its instants by this share of the maximum: of every peak, as quantiles over time hang on many.
constexpr double kMissed = 1e-4;
// Between two knots of a motion the fastest body turns by some 0.06 of a radian, or moves by that share of the mechanism's size.
constexpr int kInstantsAKnot = 2;
// A motion that ripples faster than its knots show is looked at this often, each time at so many times more instants at most.
constexpr int kMostLooks = 4;
constexpr double kMostTimesMore = 16.0;
constexpr double kMostInstants = 131072.0;   // and so many in all: some seconds
constexpr double kTimesMoreOfRipples = 5.0;  // other than the twos of the grids before
constexpr long kInstantsBetweenLooks = 256;  // at whether to go on

// How much higher than at its instants a number is somewhere between them, by the parabola through a peak and its neighbours.
class Peak {
 public:
  void add(double value) {
    if (seen_ >= 2 && last_ >= before_ && last_ >= value) {
      const double bend = 2.0 * last_ - before_ - value;
      if (bend > 0.0) above_ = std::max(above_, (value - before_) * (value - before_) / (8.0 * bend));
    }
    highest_ = std::max(highest_, value);
    before_ = last_;
    last_ = value;
    ++seen_;
  }
  // Of any peak, relative to the highest.
  double missed() const { return highest_ > 0.0 ? above_ / highest_ : 0.0; }

 private:
  double before_ = 0.0, last_ = 0.0, highest_ = 0.0, above_ = 0.0;
  long seen_ = 0;
};

struct Peaks {
  Peak position, orientation, boresight, line_of_sight;
  void add(const PoseError& error) {
    position.add(error.position);
    orientation.add(error.orientation);
    boresight.add(error.boresight);
    line_of_sight.add(error.line_of_sight);
  }
  double missed() const {
    return std::max({position.missed(), orientation.missed(), boresight.missed(), line_of_sight.missed()});
  }
};

// step: of the samples a whole share, or they lie closer than it. Without samples instants divide the motion alike.
RunResult follow(const Mechanism& mechanism, const std::function<void(double, IdealState&)>& state_at,
                 const IdealMotion& ideal, const Parameters& parameters, const RunOptions& options, double step,
                 Peaks& peaks) {
  const double duration = mechanism.duration(), spacing = options.sample_spacing;
  const ForceElements forces(mechanism, parameters, true);
  const double wanted = spacing > 0.0 && spacing < step ? spacing : step_on_grid(step, spacing);
  const long steps = std::max(1L, static_cast<long>(std::ceil(duration / wanted - 1e-9)));
  const auto time = [&](long i) {
    if (i == steps) return duration;
    return spacing > 0.0 ? wanted * static_cast<double>(i)
                         : duration * static_cast<double>(i) / static_cast<double>(steps);
  };
  MotionRecorder recorder(mechanism, ideal, options, static_cast<double>(steps));
  bool interrupted = false;
  std::array<ContactState<double>, kContactPlaces> contact;
  IdealState state;
  for (long i = 0; i <= steps && !interrupted; ++i) {
    interrupted = i % kInstantsBetweenLooks == 0 && options.progress &&
                  !options.progress({time(i), duration, recorder.position_error_max()});
    state_at(time(i), state);
    const int boresight = mechanism.boresight_body();
    peaks.add(recorder.accept(state.t, state.bodies[boresight], state.acceleration[boresight]));
    if (!recorder.sampling()) continue;
    for (std::size_t k = 0; k < recorder.bodies_wanted().size(); ++k) {
      const int body = recorder.bodies_wanted()[k];
      recorder.sample_body(static_cast<int>(k), state.bodies[body], state.acceleration[body]);
    }
    for (int c = 0; c < forces.clearances(); ++c) {
      const PlayMotion<double> motion = forces.play_motion(c, state.bodies);
      forces.joint(c).penetrations(motion, contact);
      recorder.sample_clearance(c, motion, contact);
    }
  }
  RunResult result = recorder.finish();
  for (int c = 0; c < forces.clearances(); ++c) {
    ContactSummary summary;
    summary.joint = mechanism.description().joints[mechanism.description().clearances[c].joint].name;
    summary.validity_speed = forces.joint(c).validity_speed;
    result.contact.push_back(summary);
  }
  result.integrator = "none: no play can move";
  result.interrupted = interrupted;
  result.cost.steps = result.cost.evaluations = steps;
  return result;
}

// What goes on a whole number of times between two instants is a constant at all of them: whether, at places of no order that a motion has,
// the pose is elsewhere than its neighbours a step apart say.
bool ripples_between(const Mechanism& mechanism, const std::function<void(double, IdealState&)>& state_at,
                     const IdealMotion& commanded, double step) {
  constexpr int kPlaces = 31;
  constexpr double kGolden = 0.6180339887498949, kBeside = 0.02, kRounding = 1e-11;
  const int boresight = mechanism.boresight_body();
  const double length = mechanism.characteristic_length(), duration = mechanism.duration();
  const auto error_at = [&](double t) {
    IdealState state;
    state_at(std::min(duration, t), state);
    const BodyMotion ideal = commanded.body(std::min(duration, t), boresight);
    const BodyMotion& body = state.bodies[boresight];
    const PoseError error = pose_error({body.p, Quat(body.R)}, {ideal.p, Quat(ideal.R)}, mechanism.pointing());
    Vec6 off;
    off << error.displacement / length, error.rotation;
    return off;
  };
  double largest = 0.0, off = 0.0;
  for (int i = 1; i <= kPlaces; ++i) {
    const double place = std::fmod(i * kGolden, 1.0) * duration / step, whole = std::floor(place),
                 share = place - whole;
    const Vec6 before = error_at(whole * step), after = error_at((whole + 1.0) * step), here = error_at(place * step);
    off = std::max(off, (here - (1.0 - share) * before - share * after).norm());
    largest = std::max({largest, here.norm(), before.norm()});
  }
  return off > kBeside * largest && largest > kRounding;
}

}  // namespace

RunResult motion_without_play(const Mechanism& mechanism, const std::function<void(double, IdealState&)>& state,
                              const IdealMotion& commanded, const Parameters& parameters, const RunOptions& options,
                              double step) {
  Peaks peaks;
  return follow(mechanism, state, commanded, parameters, options, step, peaks);
}

RunResult motion_without_play(const Mechanism& mechanism, const std::function<void(double, IdealState&)>& state,
                              const IdealMotion& commanded, const Parameters& parameters, const RunOptions& options) {
  double step =
      mechanism.duration() / std::max(StandingErrors::kFewestInstants, kInstantsAKnot * (commanded.knots() - 1));
  std::vector<bool> errs;
  for (const double value : parameters.error) errs.push_back(value != 0.0);
  step = std::min(step, kStepOfLoads * error_time(mechanism, commanded, errs));
  for (int look = 1;; ++look) {
    Peaks peaks;
    RunResult result = follow(mechanism, state, commanded, parameters, options, step, peaks);
    const double finest = mechanism.duration() / kMostInstants;
    if (result.interrupted || look == kMostLooks || step <= finest) return result;
    if (peaks.missed() > kMissed) {
      // What is missed goes with the square of the step.
      step = std::max(finest, step / std::clamp(std::ceil(std::sqrt(peaks.missed() / kMissed)), 2.0, kMostTimesMore));
    } else if (ripples_between(mechanism, state, commanded, step)) {
      step /= kTimesMoreOfRipples;
    } else {
      return result;
    }
  }
}

RunResult motion_without_play(const Mechanism& mechanism, const IdealMotion& ideal, const IdealMotion& commanded,
                              const Parameters& parameters, const RunOptions& options) {
  RunResult result = motion_without_play(
      mechanism, [&](double t, IdealState& state) { ideal.state(t, state); }, commanded, parameters, options);
  result.error = {{},
                  0.0,
                  mechanism.built()
                      ? "no play can move: the motion is that of the built mechanism's joints, closed exactly"
                      : "no play can move: the motion is the ideal one"};
  return result;
}

}  // namespace boresight
