#include "boresight/perturbation/perturbation.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "boresight/contact_events/damped_contact.hpp"
#include "boresight/integrate/explicit_runge_kutta.hpp"
#include "boresight/mechanism/error.hpp"
#include "boresight/perturbation/perturbation_system.hpp"
#include "boresight/perturbation/pushed_motions.hpp"
#include "boresight/perturbation/second_order.hpp"
#include "boresight/play/play_words.hpp"
#include "boresight/rungs/fast_impacts.hpp"
#include "boresight/rungs/motion_recorder.hpp"
#include "boresight/rungs/option_check.hpp"
#include "boresight/rungs/start_up.hpp"
#include "boresight/scene/scene_rung.hpp"
#include "boresight/stepping/default_integrator.hpp"
#include "boresight/stepping/even_steps.hpp"
#include "boresight/stepping/located_motion.hpp"
#include "boresight/stepping/measured_error.hpp"
#include "boresight/stepping/motion_scales.hpp"
#include "boresight/stepping/own_step.hpp"
#include "boresight/stepping/steps_of_errors.hpp"
#include "boresight/stepping/unstable_step.hpp"

namespace boresight {
namespace {

std::string basis(const Mechanism& mechanism, bool measured) {
  return "the largest deviations made exactly, by closing the joints around them: how their pose, and what pushes "
         "the " +
         parts_in_play(mechanism.description()).inserts + " there, differ from the linear ones" +
         (measured ? "; and the motion again under what its forces miss" : "");
}

class Perturbation final : public SceneRung {
 public:
  explicit Perturbation(std::shared_ptr<const Mechanism> mechanism) : SceneRung(std::move(mechanism)) {}

  std::string name() const override { return "perturbation"; }
  std::string leaves_out() const override {
    return "The deviation from the ideal motion is linear in the joint offsets: how the pose, the masses and the "
           "reactions "
           "change with the offset itself is left out, which grows with clearance over link length and near singular "
           "poses.";
  }

 private:
  RunResult follow(const PreparedScene& prepared, const StandingDisplacement& standing, const Parameters& parameters,
                   const RunOptions& options) const override {
    const std::shared_ptr<const SceneTables> tables = prepared.tables(parameters, standing);
    const bool further = options.model_look == ModelLook::motions;
    LargestDeviations largest(mechanism().duration(), further ? LargestDeviations::kMany : LargestDeviations::kFew);
    RunResult result = follow_on(tables, prepared, standing, parameters, options, largest);
    result.error = {{}, kNotMeasured, "not looked at"};
    if (result.interrupted || options.model_look == ModelLook::none) return result;
    const SecondOrder beyond =
        second_order(mechanism(), prepared, parameters, largest, result.index, result.start, further);
    result.error = {beyond.whole, kNotMeasured, basis(mechanism(), further)};
    if (!further) return result;
    LargestDeviations unused(mechanism().duration(), 1);
    state_what_pushes_move(
        beyond, mechanism(), tables, options, tolerance_of(options, name()),
        [&](const std::shared_ptr<const SceneTables>& on, const RunOptions& beside) {
          return follow_on(on, prepared, standing, parameters, beside, unused);
        },
        result);
    return result;
  }

  // largest: filled anew.
  RunResult follow_on(const std::shared_ptr<const SceneTables>& tables, const PreparedScene& prepared,
                      const StandingDisplacement& standing, const Parameters& parameters, const RunOptions& options,
                      LargestDeviations& largest) const {
    const std::string integrator = integrator_of(options);
    if (integrator != "rk4")
      return integrate_located(tables, prepared, standing, parameters, options, integrator, largest);
    const double of_loads =
        std::min(prepared.load_time(), time_of_errors(mechanism(), prepared.error_times(), parameters));
    const double own =
        options.step > 0.0 ? options.step : own_step(mechanism(), parameters, prepared.ideal(), of_loads);
    return follow_by_default(
        options, own,
        [&](const RunOptions& by_steps, double step, WhereDampedBeyond where_beyond) {
          return naming_springs(mechanism(), parameters, prepared.ideal(), options.step, [&] {
            return integrate(tables, prepared, standing, parameters, by_steps, step, where_beyond, largest);
          });
        },
        [&](const RunOptions& located) {
          check_options(located, name(), mechanism(), parameters);
          return integrate_located(tables, prepared, standing, parameters, located, located.integrator, largest);
        });
  }

  RunResult integrate(const std::shared_ptr<const SceneTables>& tables, const PreparedScene& prepared,
                      const StandingDisplacement& standing, const Parameters& parameters, const RunOptions& options,
                      double wanted, WhereDampedBeyond where_beyond, LargestDeviations& largest) const {
    const Mechanism& mechanism = this->mechanism();
    PerturbationSystem system(mechanism, parameters, tables, options.events, options.start);
    const OffsetLayout& offsets = prepared.scene().offsets();
    const SceneLayout& at = system.layout();
    const double duration = mechanism.duration();
    const auto derivative = [&](double t, const VecX& state, VecX& dy) { system.derivative(t, state, dy); };

    const EvenSteps course(duration, wanted, options.sample_spacing);
    const long steps = course.count();
    const double h = course.h();
    MotionRecorder recorder(mechanism, prepared.ideal(), options, static_cast<double>(steps));
    std::string start_warning;
    VecX y = system.start_state(mechanism, options.start_offset, start_warning);
    ExplicitRungeKutta method(classical_rk4(), system.size());
    system.set_step(h);
    const double limit = classical_rk4().real_limit;
    bool interrupted = false;
    MatX compliance;
    DampingWatch damping(mechanism, h, limit);
    const bool looked_at = options.model_look != ModelLook::none;
    const long damping_every = std::max(1L, steps / 50);
    largest.forget();
    // Not the Integrator's loop, as in multibody/fixed_steps.cpp; that one closes joints and balances energy besides.
    for (long i = 0;; ++i) {
      const double t = course.start(i);
      if (!y.allFinite()) throw UnstableStep("the deviation is not finite", t, h);
      system.accept(t, y);
      derivative(t, y, method.first_slope());
      for (std::size_t c = 0; c < system.trackers().size(); ++c)
        system.trackers()[c].observe_forces(system.wrench()[c]);
      if (system.touching()) {
        offset_compliance(at, offsets, system.row(), compliance);
        const double bound = stiffest_contact_bound(offsets, system.joints(), system.motion(), compliance);
        if (h * h * bound > limit * limit) {
          const StiffestContact stiffest = stiffest_contact(offsets, system.joints(), system.motion(), compliance);
          if (h * stiffest.angular_frequency > limit) throw UnstableStep(mechanism, stiffest, t, h);
        }
        if (i % damping_every == 0) {
          damping.look(t, offsets, system.joints(), system.motion(), system.trackers(), compliance);
          if (where_beyond == WhereDampedBeyond::ends && damping.surely_beyond((steps - i) / damping_every)) break;
        }
      }
      record(prepared, standing, t, y, method.first_slope(), system, looked_at, recorder, largest);
      if (i == steps) break;
      if (options.progress && i % kStepsBetweenLooks == 0 &&
          !options.progress({t, duration, recorder.position_error_max()})) {
        interrupted = true;
        break;
      }
      method.step(t, course.length(i), y, derivative);
    }

    RunResult result = recorder.finish();
    char text[60];
    std::snprintf(text, sizeof text, "RK4, h = %.6g s", h);
    result.integrator = text;
    if (!start_warning.empty()) result.warnings.push_back(start_warning);
    if (const std::string warning = damping.warning(); !warning.empty()) result.warnings.push_back(warning);
    if (std::string missed = errors_not_followed(mechanism, prepared.error_times(), parameters, h); !missed.empty())
      result.warnings.push_back(std::move(missed));
    result.damped_beyond_steps = damping.beyond();
    finish_contacts(system, result);
    result.interrupted = interrupted;
    result.cost.steps = steps;
    result.cost.evaluations = 4 * steps + 1;
    return result;
  }

  RunResult integrate_located(const std::shared_ptr<const SceneTables>& tables, const PreparedScene& prepared,
                              const StandingDisplacement& standing, const Parameters& parameters,
                              const RunOptions& options, const std::string& integrator,
                              LargestDeviations& largest) const {
    const double duration = mechanism().duration();
    PerturbationSystem system(mechanism(), parameters, tables, options.events, options.start);
    MotionRecorder recorder(mechanism(), prepared.ideal(), options, 2.0 * duration / kPaperStep);
    std::string start_warning;
    VecX y = system.start_state(mechanism(), options.start_offset, start_warning), slope = y;
    largest.forget();
    bool interrupted = false;
    long ends = 0;  // of steps
    const bool looked_at = options.model_look != ModelLook::none;
    system.start_located(0.0, y);
    const IntegrationSummary summary = follow_located(
        integrator, system, duration, options.sample_spacing, y,
        integration_options(prepared, system, parameters, options),
        [&](double t, const VecX& state, bool at_end) {
          system.derivative(t, state, slope);
          system.observe(t);
          record(prepared, standing, t, state, slope, system, looked_at, recorder, largest);
          interrupted = at_end && ++ends % kEndsBetweenLooks == 0 && options.progress &&
                        !options.progress({t, duration, recorder.position_error_max()});
          return !interrupted;
        },
        [](const auto&) {});
    RunResult result = recorder.finish();
    report_integration(options, name(), integrator, summary, result);
    if (!start_warning.empty()) result.warnings.push_back(start_warning);
    finish_contacts(system, result);
    result.interrupted = interrupted;
    return result;
  }

  void finish_contacts(PerturbationSystem& system, RunResult& result) const {
    for (ContactTracker& tracker : system.trackers())
      result.contact.push_back(tracker.finish(result.end_time, result.events));
    std::stable_sort(result.events.begin(), result.events.end(),
                     [](const ContactEvent& a, const ContactEvent& b) { return a.start < b.start; });
    note_fast_impacts(result);
    note_start_up(mechanism(), result);
  }

  // Coordinates are offsets, or slopes of journals: these are held to the tolerance at the sleeve's ends.
  IntegrationOptions integration_options(const PreparedScene& prepared, const PerturbationSystem& system,
                                         const Parameters& parameters, const RunOptions& options) const {
    const SceneLayout& at = system.layout();
    const double asked = tolerance_of(options, name());
    const double clearance = smallest_clearance(parameters);
    const double length = clearance > 0.0 ? clearance : 1e-6 * mechanism().characteristic_length();
    VecX tolerance = VecX::Constant(at.n, asked * length);
    for (std::size_t c = 0; c < at.joints.size(); ++c)
      for (int k = 3; k < at.joints[c].offsets; ++k)
        if (at.joints[c].source[k] >= 0)
          tolerance[at.joints[c].source[k]] = asked * length / system.joints()[c].lever();
    double slowest_impact = std::numeric_limits<double>::infinity();
    for (const JointPlay& joint : system.joints())
      slowest_impact = std::min(slowest_impact, joint.minimum_impact_speed);
    const MotionScales scales = scales_of(prepared, system, parameters);
    IntegrationOptions integration;
    integration.step = options.step;
    if (clearance > 0.0) integration.most_error = most_error(asked);
    integration.relative_tolerance = 0.0;
    integration.absolute_tolerances.resize(system.size());
    integration.absolute_tolerances.head(2 * at.n) << tolerance, tolerance / scales.flight_time;
    system.elements().tolerances(asked, integration.absolute_tolerances.tail(system.elements().size()));
    scales.apply(mechanism().duration(), slowest_impact, integration);
    integration.largest_step *= options.share_of_longest_step;
    integration.follow_growth = options.follow_growth;
    return integration;
  }

  MotionScales scales_of(const PreparedScene& prepared, const PerturbationSystem& system,
                         const Parameters& parameters) const {
    constexpr int kInstants = 41;
    const SceneLayout& at = system.layout();
    const std::size_t n = at.joints.size();
    std::vector<double> square(n, 0.0), largest(n, 0.0), row(system.tables().dynamics.width());
    for (int i = 0; i < kInstants; ++i) {
      system.tables().at(mechanism().duration() * i / (kInstants - 1), row.data());
      for (std::size_t c = 0; c < n; ++c) {
        double sum = 0.0;
        for (int k = 0; k < std::min(3, at.joints[c].offsets); ++k)
          if (const int source = at.joints[c].source[k]; source >= 0) sum += row[at.Ar + source] * row[at.Ar + source];
        square[c] += sum / kInstants;
        largest[c] = std::max(largest[c], std::sqrt(sum));
      }
    }
    MotionScales scales;
    for (std::size_t c = 0; c < n; ++c) scales.add_joint(parameters.clearance[c], std::sqrt(square[c]), largest[c]);
    scales.own_time = prepared.own_time();
    scales.load_time = prepared.load_time();
    scales.close(mechanism().duration());
    return scales;
  }

  // How forces on the offsets accelerate the offsets: B A B^T, with B picking coordinates where offsets are such.
  static void offset_compliance(const SceneLayout& at, const OffsetLayout& offsets, const double* row,
                                MatX& compliance) {
    compliance.setZero(offsets.size(), offsets.size());
    bool dependent = false;
    for (int c = 0; c < offsets.clearances(); ++c) dependent = dependent || at.joints[c].has_dependent;
    if (!dependent) {
      for (int c = 0; c < offsets.clearances(); ++c)
        for (int i = 0; i < at.joints[c].offsets; ++i)
          for (int d = 0; d < offsets.clearances(); ++d)
            for (int j = 0; j < at.joints[d].offsets; ++j)
              if (at.joints[c].source[i] >= 0 && at.joints[d].source[j] >= 0)
                compliance(offsets.joint(c).first + i, offsets.joint(d).first + j) =
                    row[at.inverse_mass(at.joints[c].source[i], at.joints[d].source[j])];
      return;
    }
    MatX B = MatX::Zero(offsets.size(), at.n);
    for (int c = 0; c < offsets.clearances(); ++c)
      for (int i = 0; i < at.joints[c].offsets; ++i) {
        const int source = at.joints[c].source[i], to = offsets.joint(c).first + i;
        if (source >= 0) B(to, source) = 1.0;
        if (source == DeviationCoordinates::kDependent)
          B.row(to) = Eigen::Map<const Eigen::RowVectorXd>(row + at.joints[c].dependent + i * at.n, at.n);
      }
    MatX A;
    at.inverse_mass(row, A);
    compliance = B * A * B.transpose();
  }

  // On all offsets, in the order of `offsets`: forces, and couples on slopes and roll.
  static VecX contact_loads(const OffsetLayout& offsets, const PerturbationSystem& system) {
    VecX load = VecX::Zero(offsets.size());
    for (int c = 0; c < offsets.clearances(); ++c) {
      const PlayWrench<double>& wrench = system.wrench()[c];
      if (std::none_of(wrench.contact.begin(), wrench.contact.end(),
                       [](const ContactState<double>& contact) { return contact.penetration > 0.0; }))
        continue;  // what the wrench holds may be of a contact that is over
      const Vec3 couple = wrench.moment - system.motion()[c].e.cross(wrench.force);
      PlayOffsets on;
      on << wrench.force, -couple.z(), couple.x(), couple.y();
      load.segment(offsets.joint(c).first, offsets.joint(c).count()) = on.head(offsets.joint(c).count());
    }
    return load;
  }

  void record(const PreparedScene& prepared, const StandingDisplacement& standing, double t, const VecX& y,
              const VecX& slope, const PerturbationSystem& system, bool looked_at, MotionRecorder& recorder,
              LargestDeviations& largest) const {
    const Eigen::Index n = system.layout().n;
    const DisplacedBodies displaced(prepared, standing, t, y.head(n));
    BodyAcceleration a;
    BodyMotion body = displaced.moving(mechanism().boresight_body(), y.segment(n, n), slope.segment(n, n), a);
    const PoseError& error = recorder.accept(t, body, a);
    largest.add(t, std::max(error.position / mechanism().characteristic_length(), error.orientation), y.head(n),
                y.segment(n, n), looked_at ? contact_loads(prepared.scene().offsets(), system) : VecX());
    if (!recorder.sampling()) return;
    for (std::size_t k = 0; k < recorder.bodies_wanted().size(); ++k) {
      body = displaced.moving(recorder.bodies_wanted()[k], y.segment(n, n), slope.segment(n, n), a);
      recorder.sample_body(static_cast<int>(k), body, a);
    }
    for (std::size_t c = 0; c < system.motion().size(); ++c)
      recorder.sample_clearance(static_cast<int>(c), system.motion()[c], system.wrench()[c].contact);
  }
};

}  // namespace

std::unique_ptr<Rung> make_perturbation(std::shared_ptr<const Mechanism> mechanism) {
  return std::make_unique<Perturbation>(std::move(mechanism));
}

}  // namespace boresight
