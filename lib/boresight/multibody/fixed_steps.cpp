#include <algorithm>
#include <cmath>
#include <cstdio>

#include "boresight/contact_events/damped_contact.hpp"
#include "boresight/contact_events/stiffest_contact.hpp"
#include "boresight/elements/bristle_state.hpp"
#include "boresight/formulations/energy_balance.hpp"
#include "boresight/integrate/explicit_runge_kutta.hpp"
#include "boresight/mechanism/error.hpp"
#include "boresight/mechanism/offset_layout.hpp"
#include "boresight/multibody/multibody_motion.hpp"
#include "boresight/multibody/multibody_start.hpp"
#include "boresight/stepping/even_steps.hpp"
#include "boresight/stepping/measured_error.hpp"
#include "boresight/stepping/unstable_step.hpp"

namespace boresight {
namespace {

// Into how many a failed step is divided, to see whether it was too long.
constexpr int kShorter = 64;

// The joint in which a contact is deeper than solids are pressed into each other, a tenth of the seat's radius; null: none.
const JointPlay* sunk(const std::vector<JointPlay>& joints, const std::vector<PlayMotion<double>>& motion) {
  std::array<ContactState<double>, kContactPlaces> contact;
  for (std::size_t c = 0; c < joints.size(); ++c) {
    joints[c].penetrations(motion[c], contact);
    for (const ContactState<double>& place : contact)
      if (place.penetration > 0.1 * joints[c].size()) return &joints[c];
  }
  return nullptr;
}

void accept_contacts(const std::vector<BodyMotion>& bodies, double t, const ForceElements& forces,
                     std::vector<ContactTracker>& trackers, std::vector<ContactMemory>& memory,
                     std::vector<PlayMotion<double>>& motion) {
  std::array<ContactState<double>, kContactPlaces> contact;
  for (std::size_t c = 0; c < trackers.size(); ++c) {
    motion[c] = forces.play_motion(static_cast<int>(c), bodies);
    forces.joint(static_cast<int>(c)).penetrations(motion[c], contact);
    trackers[c].accept(t, contact);
    memory[c] = trackers[c].memory();
  }
}

void record(const MultibodyMotion& run, Formulation& formulation, const VecX& y, double t,
            std::vector<ContactTracker>& trackers, MotionRecorder& recorder) {
  run.record(formulation, y, t, recorder);
  for (std::size_t c = 0; c < trackers.size(); ++c)
    trackers[c].observe_forces(formulation.forces().contact(static_cast<int>(c)));
}

}  // namespace

RunResult follow_in_fixed_steps(const MultibodyMotion& run, double wanted_step, WhereDampedBeyond where_beyond) {
  const Mechanism& mechanism = run.mechanism;
  const Parameters& parameters = run.parameters;
  const RunOptions& options = run.options;
  const IdealMotion& ideal = run.ideal;
  const double duration = mechanism.duration();
  const EvenSteps course(duration, wanted_step, options.sample_spacing);
  const long steps = course.count();
  const double h = course.h();
  const auto formulation = run.make_formulation();
  const ForceElements& forces = formulation->forces();

  const OffsetLayout layout(mechanism);
  std::vector<JointPlay> joints;
  for (int c = 0; c < forces.clearances(); ++c) joints.push_back(forces.joint(c));
  std::vector<ContactTracker> trackers = run.make_trackers(forces);
  std::vector<ContactMemory> memory(trackers.size());
  std::vector<PlayMotion<double>> motion(trackers.size());
  MotionRecorder recorder(mechanism, run.commanded, options, static_cast<double>(steps));

  std::string start_warning;
  VecX y = multibody_start(mechanism, parameters, ideal, *formulation, start_warning);
  ElementStates elements;
  elements.add(std::make_unique<BristleState>(
      joints, memory, [&forces](int c) -> const Bristles<double>& { return forces.bristle_rate(c); }));
  // Where elements have states these follow the bodies', which then are a copy of the head of the whole.
  const Eigen::Index n = y.size();
  VecX head, head_dot(n);
  if (!elements.empty()) y.conservativeResizeLike(VecX::Zero(n + elements.size()));
  const auto bodies_of = [&](const VecX& state) -> const VecX& {
    if (elements.empty()) return state;
    head = state.head(n);
    return head;
  };
  ExplicitRungeKutta method(classical_rk4(), y.size());
  // The energy's balance, by the weights of the method: a step's work is that of its stages.
  EnergyBalance energy(mechanism, parameters, formulation->bodies(0.0, bodies_of(y)));
  std::size_t stage = 0;
  double work = 0.0, step = h;
  const auto add_power = [&](double t, const VecX& state) {
    // Steps tried again for a diagnosis have no weight.
    if (stage < classical_rk4().b.size())
      work += step * classical_rk4().b[stage++] * energy.power(*formulation, formulation->bodies(t, bodies_of(state)));
  };
  const auto derivative = [&](double t, const VecX& state, VecX& dy) {
    if (elements.empty()) {
      formulation->derivative(t, state, memory, dy);
      return add_power(t, state);
    }
    elements.take(state.tail(elements.size()), h);
    formulation->derivative(t, bodies_of(state), memory, head_dot);
    dy.head(n) = head_dot;
    elements.rates(dy.tail(elements.size()));
    add_power(t, state);
  };

  const auto advance = [&](double t, double by, VecX& state) {
    method.step(t, by, state, derivative);
    if (elements.empty()) return formulation->stabilise(t + by, state);
    head = state.head(n);
    formulation->stabilise(t + by, head);
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
  // Not the Integrator's loop (explicit_runge_kutta.hpp): between the accepted state and its first slope stand the contacts'
  // memory and the look at their stability, and a step that fails is taken anew in shorter ones to say why.
  for (long i = 0;; ++i) {
    const double t = course.start(i);
    step = course.length(i);
    if (!y.allFinite()) throw UnstableStep("the state is not finite", t, h);
    accept_contacts(formulation->bodies(t, bodies_of(y)), t, forces, trackers, memory, motion);
    elements.accept(y.tail(elements.size()));
    energy.add_work(work);
    work = 0.0;
    stage = 0;
    derivative(t, y, method.first_slope());
    energy.look(formulation->bodies(t, bodies_of(y)));
    drift = std::max(drift, formulation->violation());
    record(run, *formulation, bodies_of(y), t, trackers, recorder);
    if (std::any_of(trackers.begin(), trackers.end(), [](const ContactTracker& c) { return c.touching(); })) {
      if (compliance.size() == 0 || i - compliance_age >= compliance_every) {
        compliance = formulation->offset_compliance();
        compliance_age = i;
        damping.look(t, layout, joints, motion, trackers, compliance);
        if (where_beyond == WhereDampedBeyond::ends && damping.surely_beyond((steps - i) / compliance_every)) break;
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
      advance(t, step, y);
    } catch (const ComputationError&) {
      // A pose that short steps from the same state pass as well, or one that is met with journals deep in their sleeves,
      // comes of the step.
      if (const JointPlay* joint = sunk(joints, motion))
        throw UnstableStep(std::string("a ") + joint->words().insert + " deep in its " + joint->words().seat, t, h);
      for (int k = 0; k < kShorter; ++k) {
        const double within = t + k * step / kShorter;
        derivative(within, before, method.first_slope());
        advance(within, step / kShorter, before);
      }
      throw UnstableStep("shorter steps go on from there", t, h);
    }
  }

  RunResult result = recorder.finish();
  if (!start_warning.empty()) result.warnings.push_back(start_warning);
  if (const std::string warning = damping.warning(); !warning.empty()) result.warnings.push_back(warning);
  result.damped_beyond_steps = damping.beyond();
  result.energy_error = energy.error();
  run.complete(result, trackers);
  char text[60];
  std::snprintf(text, sizeof text, "RK4, h = %.6g s", h);
  result.integrator = text;
  result.constraint_drift = drift;
  result.error = {{}, kNotMeasured, ""};
  result.interrupted = interrupted;
  result.cost.steps = steps;
  result.cost.evaluations = 4 * steps + 1;
  return result;
}

}  // namespace boresight
