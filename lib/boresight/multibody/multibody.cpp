#include "boresight/multibody/multibody.hpp"

#include <algorithm>
#include <chrono>
#include <mutex>
#include <optional>
#include <utility>

#include "boresight/formulations/ideal_simulation.hpp"
#include "boresight/mechanism/built_mechanism.hpp"
#include "boresight/mechanism/error.hpp"
#include "boresight/mechanism/load_time.hpp"
#include "boresight/multibody/multibody_motion.hpp"
#include "boresight/rungs/cpu_clock.hpp"
#include "boresight/rungs/integrator_choice.hpp"
#include "boresight/rungs/option_check.hpp"
#include "boresight/scene/held_play.hpp"
#include "boresight/scene/scene_rung.hpp"
#include "boresight/stepping/default_integrator.hpp"
#include "boresight/stepping/own_step.hpp"
#include "boresight/stepping/steps_of_errors.hpp"

namespace boresight {
namespace {

class Multibody final : public Rung {
 public:
  explicit Multibody(std::shared_ptr<const Mechanism> mechanism) : mechanism_(std::move(mechanism)) {}

  std::string name() const override { return kMultibody; }
  std::string leaves_out() const override {
    return "Bodies are rigid and joints without clearance are perfect; contacts are points with a dissipative Hertz "
           "law.";
  }

  RunResult run(const Parameters& parameters, const RunOptions& options) const override {
    check_options(options, name(), *mechanism_, parameters);
    const auto wall = std::chrono::steady_clock::now();
    const double cpu = thread_cpu_seconds();
    const std::shared_ptr<const IdealMotion> commanded = ideal_for(parameters);
    if (options.sample_spacing == 0.0 && mechanism_->clearances() == 0 && kinematic_ && has_errors(parameters))
      if (std::optional<RunResult> closed = closed_at_instants(*commanded, parameters, options)) {
        closed->cost.cpu_seconds = thread_cpu_seconds() - cpu;
        closed->cost.wall_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - wall).count();
        return *std::move(closed);
      }
    const BuiltMotion built = built_for(parameters, commanded);
    const Mechanism& mechanism = *built.mechanism;
    const IdealMotion& ideal = *built.motion;

    const std::string integrator = integrator_of(options);
    RunResult result;
    if (MultibodyMotion{mechanism, parameters, options, ideal, *commanded}.make_formulation()->state_size() == 0) {
      result = motion_without_play(mechanism, ideal, *commanded, parameters, options);
      result.rung = name();
      result.formulation = "tree";
    } else if (integrator != "rk4") {
      result = follow_locating_contacts({mechanism, parameters, options, ideal, *commanded}, integrator);
    } else {
      const std::vector<double>& of_errors = error_times_along(*commanded);
      const double own =
          options.step > 0.0
              ? options.step
              : own_step(mechanism, parameters, ideal,
                         std::min(load_time(mechanism), time_of_errors(mechanism, of_errors, parameters)));
      result = follow_by_default(
          options, own,
          [&](const RunOptions& by_steps, double step, WhereDampedBeyond where_beyond) {
            RunResult stepped = naming_springs(mechanism, parameters, ideal, options.step, [&] {
              return follow_in_fixed_steps({mechanism, parameters, by_steps, ideal, *commanded}, step, where_beyond);
            });
            if (std::string missed = errors_not_followed(mechanism, of_errors, parameters, step); !missed.empty())
              stepped.warnings.push_back(std::move(missed));
            return stepped;
          },
          [&](const RunOptions& located) {
            check_options(located, name(), mechanism, parameters);
            return follow_locating_contacts({mechanism, parameters, located, ideal, *commanded}, located.integrator);
          });
    }
    const std::vector<std::string>& held = held_by_others(*commanded);
    result.warnings.insert(result.warnings.begin(), held.begin(), held.end());
    if (const std::string doubt = doubt_of(*commanded, ideal.error()); !doubt.empty()) result.warnings.push_back(doubt);
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

  // Where only indices are asked for: the built mechanism's joints closed at instants, one after the other, in place of a motion fitted to
  // rounding between them. Nothing where Newton's method does not lead from one to the next.
  std::optional<RunResult> closed_at_instants(const IdealMotion& commanded, const Parameters& parameters,
                                              const RunOptions& options) const {
    struct NotReached {};
    try {
      const auto built = built_mechanism(*mechanism_, parameters,
                                         std::shared_ptr<const IdealMotion>(std::shared_ptr<void>(), &commanded));
      IdealSolver solver(*built);
      IdealState at;
      solver.start(at);
      RunResult result = motion_without_play(
          *built,
          [&](double t, IdealState& state) {
            if (t < at.t) solver.start(at);
            if (t > at.t && !solver.solve(t, at)) throw NotReached{};
            state = at;
          },
          commanded, parameters, options);
      result.error = {{}, 0.0, "no play can move: the built mechanism's joints are closed exactly"};
      result.rung = name();
      result.formulation = "tree";
      return result;
    } catch (const NotReached&) {
      return {};
    }
  }

  // The last one is kept likewise.
  BuiltMotion built_for(const Parameters& parameters, const std::shared_ptr<const IdealMotion>& commanded) const {
    if (!has_errors(parameters)) return {mechanism_, commanded};
    {
      const std::lock_guard lock(ideal_mutex_);
      if (built_.mechanism && built_parameters_.error == parameters.error &&
          (kinematic_ || same_scene(built_parameters_, parameters)))
        return built_;
    }
    const BuiltMotion built = built_motion(mechanism_, commanded, parameters);
    const std::lock_guard lock(ideal_mutex_);
    built_parameters_ = parameters;
    return built_ = built;
  }

  // Of the drives' laws, which no parameter changes.
  const std::vector<double>& error_times_along(const IdealMotion& commanded) const {
    std::call_once(error_times_once_, [&] {
      const std::vector<bool> all(mechanism_->description().errors.size(), true);
      error_times_ = error_times(*mechanism_, commanded, all);
    });
    return error_times_;
  }

  // Sentences on plays that cannot move: of the mechanism, whatever the parameters.
  const std::vector<std::string>& held_by_others(const IdealMotion& ideal) const {
    std::call_once(held_once_, [&] { held_ = held_plays(*mechanism_, ideal); });
    return held_;
  }

  std::shared_ptr<const Mechanism> mechanism_;
  mutable std::once_flag once_, held_once_, error_times_once_;
  mutable std::vector<double> error_times_;
  mutable std::vector<std::string> held_;
  mutable bool kinematic_ = false;
  mutable std::mutex ideal_mutex_;
  mutable std::shared_ptr<const IdealMotion> ideal_;
  mutable BuiltMotion built_;
  mutable Parameters ideal_parameters_, built_parameters_;
};

}  // namespace

std::unique_ptr<Rung> make_multibody(std::shared_ptr<const Mechanism> mechanism) {
  return std::make_unique<Multibody>(std::move(mechanism));
}

}  // namespace boresight
