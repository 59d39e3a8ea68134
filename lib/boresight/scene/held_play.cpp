#include "boresight/scene/held_play.hpp"

#include <algorithm>
#include <cmath>

#include "boresight/mechanism/generic_instant.hpp"
#include "boresight/mechanism/play_mobility.hpp"
#include "boresight/rungs/motion_recorder.hpp"
#include "boresight/stepping/unstable_step.hpp"

namespace boresight {

std::vector<std::string> held_plays(const Mechanism& mechanism, const IdealMotion& ideal) {
  IdealState state;
  ideal.state(generic_instant(0.0, ideal.duration()), state);
  return held_plays(mechanism, analyse_play(mechanism, state.bodies));
}

RunResult motion_without_play(const Mechanism& mechanism, const IdealMotion& ideal, const IdealMotion& commanded,
                              const Parameters& parameters, const RunOptions& options) {
  RunResult result = motion_without_play(
      mechanism, [&](double t, IdealState& state) { ideal.state(t, state); }, commanded, parameters, options,
      longest_step(mechanism.duration()));
  result.error = {0.0, 0.0,
                  mechanism.built()
                      ? "no play can move: the motion is that of the built mechanism's joints, closed exactly"
                      : "no play can move: the motion is the ideal one"};
  return result;
}

RunResult motion_without_play(const Mechanism& mechanism, const std::function<void(double, IdealState&)>& state_at,
                              const IdealMotion& ideal, const Parameters& parameters, const RunOptions& options,
                              double step) {
  const double duration = mechanism.duration();
  const ForceElements forces(mechanism, parameters, true);
  const double wanted = step_on_grid(step, options.sample_spacing);
  const long steps = std::max(1L, static_cast<long>(std::ceil(duration / wanted - 1e-9)));
  MotionRecorder recorder(mechanism, ideal, options, static_cast<double>(steps));
  std::array<ContactState<double>, kContactPlaces> contact;
  IdealState state;
  for (long i = 0; i <= steps; ++i) {
    state_at(duration * static_cast<double>(i) / static_cast<double>(steps), state);
    const int boresight = mechanism.boresight_body();
    recorder.accept(state.t, state.bodies[boresight], state.acceleration[boresight]);
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
  result.cost.steps = result.cost.evaluations = steps;
  return result;
}

}  // namespace boresight
