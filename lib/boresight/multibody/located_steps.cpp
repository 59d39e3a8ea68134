#include <limits>
#include <utility>

#include "boresight/contact_events/contact_report.hpp"
#include "boresight/formulations/energy_balance.hpp"
#include "boresight/mechanism/error.hpp"
#include "boresight/mechanism/load_time.hpp"
#include "boresight/multibody/multibody_motion.hpp"
#include "boresight/multibody/multibody_start.hpp"
#include "boresight/multibody/multibody_system.hpp"
#include "boresight/stepping/located_motion.hpp"
#include "boresight/stepping/measured_error.hpp"
#include "boresight/stepping/motion_scales.hpp"
#include "boresight/stepping/own_step.hpp"
#include "boresight/stepping/unstable_step.hpp"

namespace boresight {
namespace {

MotionScales scales_of(const MultibodyMotion& run) {
  MotionScales scales;
  const std::vector<ContactFrequency> contacts = analyse_contacts(run.mechanism, run.parameters, run.ideal);
  for (std::size_t c = 0; c < contacts.size(); ++c)
    if (contacts[c].effective_mass > 0.0)
      scales.add_joint(run.parameters.clearance[c], contacts[c].typical_load / contacts[c].effective_mass,
                       contacts[c].largest_load / contacts[c].effective_mass);
  scales.own_time = own_time(run.ideal, run.mechanism.bodies(), run.mechanism.characteristic_length());
  scales.load_time = load_time(run.mechanism);
  scales.close(run.mechanism.duration());
  return scales;
}

// Displacements are held to the tolerance, turns as if they worked on the mechanism's size.
IntegrationOptions integration_options(const MultibodyMotion& run, const Formulation& formulation,
                                       const ElementStates& elements) {
  const Parameters& parameters = run.parameters;
  const RunOptions& options = run.options;
  const double clearance = smallest_clearance(parameters), size = run.mechanism.characteristic_length();
  const double length = tolerance_of(options, kMultibody) * (clearance > 0.0 ? clearance : 1e-6 * size);
  double slowest_impact = std::numeric_limits<double>::infinity();
  for (const ClearanceParameters& c : parameters.clearance)
    slowest_impact = std::min(slowest_impact, c.contact.minimum_impact_speed);
  const MotionScales scales = scales_of(run);
  IntegrationOptions integration;
  integration.step = options.step;
  if (clearance > 0.0) integration.most_error = most_error(tolerance_of(options, kMultibody));
  integration.relative_tolerance = 0.0;
  integration.absolute_tolerances.resize(formulation.state_size() + elements.size());
  for (int k = 0; k < formulation.state_size(); ++k)
    integration.absolute_tolerances[k] =
        length / (formulation.is_length(k) ? 1.0 : size) / (formulation.is_speed(k) ? scales.flight_time : 1.0);
  elements.tolerances(tolerance_of(options, kMultibody), integration.absolute_tolerances.tail(elements.size()));
  scales.apply(run.mechanism.duration(), slowest_impact, integration);
  integration.largest_step *= options.share_of_longest_step;
  integration.follow_growth = options.follow_growth;
  return integration;
}

}  // namespace

RunResult follow_locating_contacts(const MultibodyMotion& run, const std::string& integrator) {
  const Mechanism& mechanism = run.mechanism;
  const Parameters& parameters = run.parameters;
  const RunOptions& options = run.options;
  const IdealMotion& ideal = run.ideal;
  const double duration = mechanism.duration();
  const auto formulation = run.make_formulation();
  std::vector<ContactTracker> trackers = run.make_trackers(formulation->forces());
  MotionRecorder recorder(mechanism, run.commanded, options, 2.0 * duration / kPaperStep);
  std::string start_warning;
  VecX y = multibody_start(mechanism, parameters, ideal, *formulation, start_warning);
  MultibodySystem system(*formulation, trackers, mechanism.characteristic_length());
  y.conservativeResizeLike(VecX::Zero(system.size()));
  system.start(0.0, y);
  double drift = 0.0;
  long points = 0, ends = 0;  // looked at; of steps
  bool interrupted = false;
  // The energy's balance, by Simpson's rule over each step. The power at a step's start is that at the end of the one
  // before, unless an event changed what acts in between.
  EnergyBalance energy(mechanism, parameters, formulation->bodies(0.0, system.bodies_part(y)));
  VecX within = y;
  double power_at_end = 0.0;
  long events = -1;
  const auto power = [&](double t, const VecX& state) {
    system.evaluate(t, state);
    return energy.power(*formulation, formulation->bodies(t, system.bodies_part(state)));
  };
  const auto taken = [&](const auto& step) {
    const double h = step.end() - step.start();
    const auto power_within = [&](double share) {
      step.at(step.start() + share * h, within);
      return power(step.start() + share * h, within);
    };
    const double at_start =
        std::exchange(events, system.events()) == system.events() ? power_at_end : power_within(0.0);
    const double in_middle = power_within(0.5);
    power_at_end = power(step.end(), step.state());
    energy.add_work(h / 6.0 * (at_start + 4.0 * in_middle + power_at_end));
    energy.look(formulation->bodies(step.end(), system.bodies_part(step.state())));
  };
  const auto show = [&](double t, const VecX& state, bool at_end) {
    // Poses are cheap, accelerations and forces are not: inside a step only where they are sampled.
    const bool whole = at_end || points == 0 || recorder.wants_sample(t);
    if (whole) {
      system.evaluate(t, state);
      drift = std::max(drift, formulation->violation());
    }
    system.observe(t, state, whole);
    run.record(*formulation, system.bodies_part(state), t, recorder);
    ++points;
    interrupted = at_end && ++ends % kEndsBetweenLooks == 0 && options.progress &&
                  !options.progress({t, duration, recorder.position_error_max()});
    return !interrupted;
  };
  IntegrationSummary summary;
  try {
    summary = follow_located(integrator, system, duration, options.sample_spacing, y,
                             integration_options(run, *formulation, system.elements()), show, taken);
  } catch (const StepFailed& failure) {
    throw StepFailed(failure.what() + (system.fault().empty() ? "" : "; refused last: " + system.fault()));
  }
  RunResult result = recorder.finish();
  if (!start_warning.empty()) result.warnings.push_back(start_warning);
  result.energy_error = energy.error();
  run.complete(result, trackers);
  report_integration(options, kMultibody, integrator, summary, result);
  result.cost.evaluations += system.evaluations();
  result.constraint_drift = drift;
  result.error = {{}, kNotMeasured, ""};
  result.interrupted = interrupted;
  return result;
}

}  // namespace boresight
