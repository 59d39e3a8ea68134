#include "boresight/rungs/multibody.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <limits>
#include <mutex>
#include <utility>

#include "boresight/integrate/explicit_runge_kutta.hpp"
#include "boresight/mechanism/error.hpp"
#include "boresight/rungs/bristle_state.hpp"
#include "boresight/rungs/contact_tracker.hpp"
#include "boresight/rungs/cpu_clock.hpp"
#include "boresight/rungs/energy_balance.hpp"
#include "boresight/rungs/formulation.hpp"
#include "boresight/rungs/held_play.hpp"
#include "boresight/rungs/ideal_simulation.hpp"
#include "boresight/rungs/located_motion.hpp"
#include "boresight/rungs/measured_error.hpp"
#include "boresight/rungs/motion_recorder.hpp"
#include "boresight/rungs/motion_scales.hpp"
#include "boresight/rungs/damped_contact.hpp"
#include "boresight/rungs/default_integrator.hpp"
#include "boresight/rungs/multibody_start.hpp"
#include "boresight/rungs/multibody_system.hpp"
#include "boresight/rungs/option_check.hpp"
#include "boresight/rungs/own_step.hpp"
#include "boresight/rungs/scene_rung.hpp"
#include "boresight/rungs/start_up.hpp"
#include "boresight/rungs/unstable_step.hpp"

namespace boresight {
namespace {

// Into how many a failed step is divided, to see whether it was too long.
constexpr int kShorter = 64;

class Multibody final : public Rung {
 public:
  explicit Multibody(std::shared_ptr<const Mechanism> mechanism) : mechanism_(std::move(mechanism)) {}

  std::string name() const override { return "multibody"; }
  std::string leaves_out() const override {
    return "Bodies are rigid and joints without clearance are perfect; contacts are points with a dissipative Hertz law.";
  }

  RunResult run(const Parameters& parameters, const RunOptions& options) const override {
    check_options(options, name(), *mechanism_, parameters);
    const auto wall = std::chrono::steady_clock::now();
    const double cpu = thread_cpu_seconds();
    const std::shared_ptr<const IdealMotion> held_ideal = ideal_for(parameters);
    const IdealMotion& ideal = *held_ideal;

    const std::string integrator = integrator_of(options);
    RunResult result;
    if (make_formulation(parameters, options, ideal)->state_size() == 0) {
      result = motion_without_play(*mechanism_, ideal, parameters, options);
      result.rung = name();
      result.formulation = "tree";
    } else if (integrator != "rk4") {
      result = integrate_located(parameters, options, ideal, integrator);
    } else {
      const double own = options.step > 0.0 ? options.step : own_step(*mechanism_, parameters, ideal);
      result = follow_by_default(
          options, own, [&](const RunOptions& by_steps, double step) { return integrate(parameters, by_steps, ideal, step); },
          [&](const RunOptions& located) {
            check_options(located, name(), *mechanism_, parameters);
            return integrate_located(parameters, located, ideal, located.integrator);
          });
    }
    const std::vector<std::string>& held = held_by_others(ideal);
    result.warnings.insert(result.warnings.begin(), held.begin(), held.end());
    result.cost.cpu_seconds = thread_cpu_seconds() - cpu;
    result.cost.wall_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - wall).count();
    return result;
  }

 private:
  // The last one is kept: a simulated one costs as much as a run, and further runs of the same parameters ask for it again.
  std::shared_ptr<const IdealMotion> ideal_for(const Parameters& parameters) const {
    std::call_once(once_, [this] { kinematic_ = is_kinematic(*mechanism_); });
    {
      const std::lock_guard lock(ideal_mutex_);
      if (ideal_ && (kinematic_ || same_scene(ideal_parameters_, parameters))) return ideal_;
      if (kinematic_) return ideal_ = std::make_shared<const IdealMotion>(ideal_motion(*mechanism_, parameters));
    }
    auto simulated = std::make_shared<const IdealMotion>(ideal_motion(*mechanism_, parameters));
    const std::lock_guard lock(ideal_mutex_);
    ideal_ = simulated;
    ideal_parameters_ = parameters;
    return simulated;
  }

  // Sentences on plays that cannot move: of the mechanism, whatever the parameters.
  const std::vector<std::string>& held_by_others(const IdealMotion& ideal) const {
    std::call_once(held_once_, [&] { held_ = held_plays(*mechanism_, ideal); });
    return held_;
  }

  RunResult integrate(const Parameters& parameters, const RunOptions& options, const IdealMotion& ideal,
                      double wanted_step) const {
    const Mechanism& mechanism = *mechanism_;
    const double duration = mechanism.duration();
    const long steps = std::max(1L, static_cast<long>(std::ceil(duration / wanted_step - 1e-9)));
    const double h = duration / static_cast<double>(steps);
    const auto formulation = make_formulation(parameters, options, ideal);
    const ForceElements& forces = formulation->forces();

    const OffsetLayout layout(mechanism);
    std::vector<JournalInSleeve> joints;
    for (int c = 0; c < forces.clearances(); ++c) joints.push_back(forces.joint(c));
    std::vector<ContactTracker> trackers = make_trackers(forces, options);
    std::vector<ContactMemory> memory(trackers.size());
    std::vector<JournalMotion<double>> motion(trackers.size());
    MotionRecorder recorder(mechanism, ideal, options, static_cast<double>(steps));

    std::string start_warning;
    VecX y = multibody_start(mechanism, parameters, ideal, *formulation, start_warning);
    const BristleState bristles(joints);
    // Where friction has a state it follows the bodies', which then are a copy of the head of the whole.
    const Eigen::Index n = y.size();
    VecX head, head_dot(n);
    if (!bristles.empty()) y.conservativeResizeLike(VecX::Zero(n + bristles.size()));
    const auto bodies_of = [&](const VecX& state) -> const VecX& {
      if (bristles.empty()) return state;
      head = state.head(n);
      return head;
    };
    ExplicitRungeKutta method(classical_rk4(), y.size());
    // The energy's balance, by the weights of the method: a step's work is that of its stages.
    EnergyBalance energy(mechanism, parameters, formulation->bodies(0.0, bodies_of(y)));
    std::size_t stage = 0;
    double work = 0.0;
    const auto add_power = [&](double t, const VecX& state) {
      // Steps tried again for a diagnosis have no weight.
      if (stage < classical_rk4().b.size())
        work += h * classical_rk4().b[stage++] * energy.power(*formulation, formulation->bodies(t, bodies_of(state)));
    };
    const auto derivative = [&](double t, const VecX& state, VecX& dy) {
      if (bristles.empty()) {
        formulation->derivative(t, state, memory, dy);
        return add_power(t, state);
      }
      bristles.hand_over(state.tail(bristles.size()), h, memory);
      formulation->derivative(t, bodies_of(state), memory, head_dot);
      dy.head(n) = head_dot;
      bristles.rates([&](std::size_t c) -> const Bristles<double>& { return forces.bristle_rate(static_cast<int>(c)); },
                     dy.tail(bristles.size()));
      add_power(t, state);
    };

    const auto advance = [&](double t, double step, VecX& state) {
      method.step(t, step, state, derivative);
      if (bristles.empty()) return formulation->settle(t + step, state);
      head = state.head(n);
      formulation->settle(t + step, head);
      state.head(n) = head;
    };

    double drift = 0.0;
    VecX before;
    MatX compliance;
    DampingWatch damping(mechanism, h, classical_rk4().real_limit);
    long compliance_age = 0;
    // The compliance changes with the pose only: fifty times along the motion is often enough.
    const long compliance_every = std::max(1L, steps / 50);
    bool interrupted = false;
    for (long i = 0;; ++i) {
      const double t = static_cast<double>(i) * h;
      if (!y.allFinite()) throw UnstableStep("the state is not finite", t, h);
      accept_contacts(formulation->bodies(t, bodies_of(y)), t, forces, trackers, memory, motion);
      bristles.release(memory, y.tail(bristles.size()));
      energy.add_work(work);
      work = 0.0;
      stage = 0;
      derivative(t, y, method.first_slope());
      energy.look(formulation->bodies(t, bodies_of(y)));
      drift = std::max(drift, formulation->violation());
      record(*formulation, bodies_of(y), t, trackers, recorder);
      if (std::any_of(trackers.begin(), trackers.end(), [](const ContactTracker& c) { return c.touching(); })) {
        if (compliance.size() == 0 || i - compliance_age >= compliance_every) {
          compliance = formulation->offset_compliance();
          compliance_age = i;
          damping.look(t, layout, joints, motion, trackers, compliance);
        }
        const StiffestContact stiffest = stiffest_contact(layout, joints, motion, compliance);
        if (h * stiffest.angular_frequency > classical_rk4().real_limit) throw UnstableStep(mechanism, stiffest, t, h);
      }
      if (i == steps) break;
      if (options.progress && i % 256 == 0 && !options.progress({t, duration, recorder.position_error_max()})) {
        interrupted = true;
        break;
      }
      before = y;
      try {
        advance(t, h, y);
      } catch (const ComputationError&) {
        // A pose that short steps from the same state pass as well, or one that is met with journals deep in their sleeves,
        // comes of the step.
        if (sunk(joints, motion)) throw UnstableStep("a journal deep in its sleeve", t, h);
        for (int k = 0; k < kShorter; ++k) {
          const double within = t + k * h / kShorter;
          derivative(within, before, method.first_slope());
          advance(within, h / kShorter, before);
        }
        throw UnstableStep("shorter steps go on from there", t, h);
      }
    }

    RunResult result = recorder.finish();
    if (!start_warning.empty()) result.warnings.push_back(start_warning);
    if (const std::string warning = damping.warning(); !warning.empty()) result.warnings.push_back(warning);
    result.damped_beyond_steps = damping.beyond();
    complete(result, options, trackers);
    char text[60];
    std::snprintf(text, sizeof text, "RK4, h = %.6g s", h);
    result.integrator = text;
    result.constraint_drift = drift;
    result.energy_error = energy.error();
    result.error = {0.0, kNotMeasured, ""};
    result.interrupted = interrupted;
    result.cost.steps = steps;
    result.cost.evaluations = 4 * steps + 1;
    return result;
  }

  RunResult integrate_located(const Parameters& parameters, const RunOptions& options, const IdealMotion& ideal,
                              const std::string& integrator) const {
    const double duration = mechanism_->duration();
    const auto formulation = make_formulation(parameters, options, ideal);
    std::vector<ContactTracker> trackers = make_trackers(formulation->forces(), options);
    MotionRecorder recorder(*mechanism_, ideal, options, 2.0 * duration / kPaperStep);
    std::string start_warning;
    VecX y = multibody_start(*mechanism_, parameters, ideal, *formulation, start_warning);
    MultibodySystem system(*formulation, trackers, mechanism_->characteristic_length());
    system.start(0.0, y);
    double drift = 0.0;
    long points = 0;
    bool interrupted = false;
    // The energy's balance, by Simpson's rule over each step. The power at a step's start is that at the end of the one
    // before, unless an event changed what acts in between.
    EnergyBalance energy(*mechanism_, parameters, formulation->bodies(0.0, y));
    VecX within = y;
    double power_at_end = 0.0;
    long events = -1;
    const auto power = [&](double t, const VecX& state) {
      system.evaluate(t, state);
      return energy.power(*formulation, formulation->bodies(t, state));
    };
    const auto taken = [&](const auto& step) {
      const double h = step.end() - step.start();
      const auto power_within = [&](double share) {
        step.at(step.start() + share * h, within);
        return power(step.start() + share * h, within);
      };
      const double at_start = std::exchange(events, system.events()) == system.events() ? power_at_end : power_within(0.0);
      const double in_middle = power_within(0.5);
      power_at_end = power(step.end(), step.state());
      energy.add_work(h / 6.0 * (at_start + 4.0 * in_middle + power_at_end));
      energy.look(formulation->bodies(step.end(), step.state()));
    };
    const auto show = [&](double t, const VecX& state, bool at_end) {
      // Poses are cheap, accelerations and forces are not: inside a step only where they are sampled.
      const bool whole = at_end || points == 0 || recorder.wants_sample(t);
      if (whole) {
        system.evaluate(t, state);
        drift = std::max(drift, formulation->violation());
      }
      system.observe(t, state, whole);
      record_motion(*formulation, state, t, recorder);
      interrupted =
          ++points % 1024 == 0 && options.progress && !options.progress({t, duration, recorder.position_error_max()});
      return !interrupted;
    };
    IntegrationSummary summary;
    try {
      summary = follow_located(integrator, system, duration, options.sample_spacing, y,
                               integration_options(*formulation, parameters, options, ideal), show, taken);
    } catch (const ComputationError& failure) {
      throw ComputationError(failure.what() + (system.fault().empty() ? "" : "; refused last: " + system.fault()));
    }
    RunResult result = recorder.finish();
    if (!start_warning.empty()) result.warnings.push_back(start_warning);
    complete(result, options, trackers);
    report_integration(options, name(), integrator, summary, result);
    result.cost.evaluations += system.evaluations();
    result.constraint_drift = drift;
    result.energy_error = energy.error();
    result.error = {0.0, kNotMeasured, ""};
    result.interrupted = interrupted;
    return result;
  }

  // Displacements are held to the tolerance, turns as if they worked on the mechanism's size.
  IntegrationOptions integration_options(const Formulation& formulation, const Parameters& parameters,
                                         const RunOptions& options, const IdealMotion& ideal) const {
    const double clearance = smallest_clearance(parameters), size = mechanism_->characteristic_length();
    const double length = tolerance_of(options, name()) * (clearance > 0.0 ? clearance : 1e-6 * size);
    double slowest_impact = std::numeric_limits<double>::infinity();
    for (const ClearanceParameters& c : parameters.clearance)
      slowest_impact = std::min(slowest_impact, c.contact.minimum_impact_speed);
    const MotionScales scales = scales_of(parameters, ideal);
    IntegrationOptions integration;
    integration.step = options.step;
    if (clearance > 0.0) integration.most_error = most_error(tolerance_of(options, name()));
    integration.relative_tolerance = 0.0;
    integration.absolute_tolerances.resize(formulation.state_size());
    for (int k = 0; k < formulation.state_size(); ++k)
      integration.absolute_tolerances[k] = length / (formulation.is_length(k) ? 1.0 : size) /
                                           (formulation.is_speed(k) ? scales.flight_time : 1.0);
    scales.apply(mechanism_->duration(), slowest_impact, integration);
    integration.largest_step *= options.share_of_longest_step;
    return integration;
  }

  MotionScales scales_of(const Parameters& parameters, const IdealMotion& ideal) const {
    MotionScales scales;
    const std::vector<ContactFrequency> contacts = analyse_contacts(*mechanism_, parameters, ideal);
    for (std::size_t c = 0; c < contacts.size(); ++c)
      if (contacts[c].effective_mass > 0.0)
        scales.add_joint(parameters.clearance[c].radial, parameters.clearance[c].axial,
                         contacts[c].typical_load / contacts[c].effective_mass,
                         contacts[c].largest_load / contacts[c].effective_mass);
    scales.own_time = own_time(ideal, mechanism_->bodies(), mechanism_->characteristic_length());
    scales.close(mechanism_->duration());
    return scales;
  }

  std::vector<ContactTracker> make_trackers(const ForceElements& forces, const RunOptions& options) const {
    std::vector<ContactTracker> trackers;
    const MechanismDescription& m = mechanism_->description();
    for (int c = 0; c < mechanism_->clearances(); ++c)
      trackers.emplace_back(c, m.joints[m.clearances[c].joint].name, forces.joint(c), options.events, options.start);
    return trackers;
  }

  // What both ways of integrating report alike.
  void complete(RunResult& result, const RunOptions& options, std::vector<ContactTracker>& trackers) const {
    result.rung = name();
    result.formulation = options.formulation.empty() ? "tree" : options.formulation;
    for (ContactTracker& tracker : trackers) result.contact.push_back(tracker.finish(result.end_time, result.events));
    std::stable_sort(result.events.begin(), result.events.end(),
                     [](const ContactEvent& a, const ContactEvent& b) { return a.start < b.start; });
    warn(result);
    note_start_up(result);
  }

  std::unique_ptr<Formulation> make_formulation(const Parameters& parameters, const RunOptions& options,
                                                const IdealMotion& ideal) const {
    const bool paper = options.formulation == "paper";
    // Each formulation's own habit where nothing is asked for: the paper's is Baumgarte's, the tree's projection.
    const bool project = options.stabilisation.empty() ? !paper : options.stabilisation == "projection";
    const Stabilisation stabilisation = project ? Stabilisation::projection : Stabilisation::baumgarte;
    if (paper)
      return make_paper_formulation(*mechanism_, parameters, &ideal,
                                    {true, stabilisation, options.baumgarte_alpha, options.baumgarte_beta});
    return make_tree_formulation(*mechanism_, parameters, &ideal,
                                 {true, stabilisation, options.baumgarte_alpha, options.baumgarte_beta});
  }

  // Whether a contact is deeper than solids are pressed into each other: a tenth of the bore's radius.
  static bool sunk(const std::vector<JournalInSleeve>& joints, const std::vector<JournalMotion<double>>& motion) {
    std::array<ContactState<double>, kContactPlaces> contact;
    for (std::size_t c = 0; c < joints.size(); ++c) {
      joints[c].gaps(motion[c], contact);
      for (const ContactState<double>& place : contact)
        if (place.penetration > 0.1 * joints[c].bore_radius) return true;
    }
    return false;
  }

  static void accept_contacts(const std::vector<BodyMotion>& bodies, double t, const ForceElements& forces,
                              std::vector<ContactTracker>& trackers, std::vector<ContactMemory>& memory,
                              std::vector<JournalMotion<double>>& motion) {
    std::array<ContactState<double>, kContactPlaces> contact;
    for (std::size_t c = 0; c < trackers.size(); ++c) {
      motion[c] = forces.journal_motion(static_cast<int>(c), bodies);
      forces.joint(static_cast<int>(c)).gaps(motion[c], contact);
      trackers[c].accept(t, contact);
      memory[c] = trackers[c].memory();
    }
  }

  void record(Formulation& formulation, const VecX& y, double t, std::vector<ContactTracker>& trackers,
              MotionRecorder& recorder) const {
    record_motion(formulation, y, t, recorder);
    for (std::size_t c = 0; c < trackers.size(); ++c)
      trackers[c].observe_forces(formulation.forces().contact(static_cast<int>(c)).contact);
  }

  void record_motion(Formulation& formulation, const VecX& y, double t, MotionRecorder& recorder) const {
    const std::vector<BodyMotion>& bodies = formulation.bodies(t, y);
    const std::vector<BodyAcceleration>& acceleration = formulation.acceleration();
    const int b = mechanism_->boresight_body();
    recorder.accept(t, bodies[b], acceleration[b]);
    if (!recorder.sampling()) return;
    const std::vector<int>& wanted = recorder.bodies_wanted();
    for (std::size_t k = 0; k < wanted.size(); ++k)
      recorder.sample_body(static_cast<int>(k), bodies[wanted[k]], acceleration[wanted[k]]);
    const ForceElements& forces = formulation.forces();
    for (int c = 0; c < forces.clearances(); ++c)
      recorder.sample_clearance(c, forces.motion(c), forces.contact(c).contact);
  }

  static void warn(RunResult& result) {
    for (const ContactSummary& c : result.contact) {
      if (c.impact_speed_above_validity == 0) continue;
      char text[300];
      std::snprintf(text, sizeof text,
                    "%s: %lld of %lld impacts were faster than %.3g m/s, up to which the contact law is valid (Eq. 26); the "
                    "fastest was %.1f times that",
                    c.joint.c_str(), static_cast<long long>(c.impact_speed_above_validity),
                    static_cast<long long>(c.impacts), c.validity_speed, c.max_impact_speed / c.validity_speed);
      result.warnings.push_back(text);
    }
  }

  std::shared_ptr<const Mechanism> mechanism_;
  mutable std::once_flag once_, held_once_;
  mutable std::vector<std::string> held_;
  mutable bool kinematic_ = false;
  mutable std::mutex ideal_mutex_;
  mutable std::shared_ptr<const IdealMotion> ideal_;
  mutable Parameters ideal_parameters_;
};

}  // namespace

std::unique_ptr<Rung> make_multibody(std::shared_ptr<const Mechanism> mechanism) {
  return std::make_unique<Multibody>(std::move(mechanism));
}

}  // namespace boresight
