#include "boresight/slopes/sensitive_motion.hpp"

#include <algorithm>

#include "boresight/integrate/explicit_method.hpp"
#include "boresight/integrate/integrator.hpp"
#include "boresight/integrate/rosenbrock_method.hpp"
#include "boresight/mechanism/error.hpp"
#include "boresight/mechanism/load_time.hpp"
#include "boresight/rungs/integrator_choice.hpp"
#include "boresight/slopes/sensitive_system.hpp"
#include "boresight/slopes/shifted_sensitivities.hpp"
#include "boresight/stepping/motion_scales.hpp"

namespace boresight {
namespace {

// As the perturbation rung's own; columns of sensitivity have no say in the step.
IntegrationOptions integration_options(const SceneLayout& at, const Parameters& parameters,
                                       const ContactNumbers& numbers, double asked, double longest_step,
                                       Eigen::Index size, long most_steps) {
  const double clearance = smallest_clearance(parameters);
  const double length = clearance > 0.0 ? clearance : 1e-6;
  VecX tolerance = VecX::Constant(at.n, asked * length);
  for (std::size_t c = 0; c < at.joints.size(); ++c)
    for (int k = 3; k < at.joints[c].offsets; ++k)
      if (at.joints[c].source[k] >= 0) tolerance[at.joints[c].source[k]] = asked * length / numbers.joints[c].lever();
  IntegrationOptions options;
  options.relative_tolerance = 0.0;
  options.absolute_tolerances = VecX::Constant(size, 1e200);
  options.absolute_tolerances.head(2 * at.n) << tolerance, tolerance / kFlightTime;
  // The norm is a mean over all unknowns.
  options.absolute_tolerances.head(2 * at.n) *= std::sqrt(2.0 * at.n / static_cast<double>(size));
  options.largest_step = longest_step;
  if (most_steps > 0) options.most_steps = most_steps;
  return options;
}

template <typename M, typename S, typename Keep>
IntegrationSummary follow_by(M method, S& system, const MotionRequest& request, const IntegrationOptions& options,
                             VecX& Y, Keep&& keep) {
  Integrator<M> integrator(std::move(method), system.gap_count(), options.looks_inside_step);
  std::size_t k = 0;
  for (; k < request.times.size() && request.times[k] <= request.start; ++k) keep(k, Y);
  VecX inside = Y;
  system.start_located(request.start, Y);
  const IntegrationSummary summary =
      integrator.run(system, request.start, request.end, Y, options, [&](const auto& step) {
        if (request.reached) request.reached(step.end());
        for (; k < request.times.size() && request.times[k] <= step.end(); ++k) {
          step.at(request.times[k], inside);
          keep(k, inside);
        }
      });
  if (!summary.completed()) throw ComputationError(summary.message);
  for (; k < request.times.size(); ++k) keep(k, Y);
  return summary;
}

// Shifted: what implicit steps solve with.
template <typename Shifted, typename S, typename Keep>
IntegrationSummary follow(S& system, const MotionRequest& request, const IntegrationOptions& options, VecX& Y,
                          Keep&& keep) {
  if (request.implicit)
    return follow_by(RosenbrockWith<Shifted>(rodas4(), Y.size()), system, request, options, Y, keep);
  return follow_by(ExplicitMethod(dormand_prince54(), Y.size()), system, request, options, Y, keep);
}

struct Follower {
  const Mechanism& mechanism;
  const Parameters& parameters;
  const std::shared_ptr<const SceneTables>& tables;
  const ContactNumbers& numbers;
  const MotionRequest& request;

  IntegrationOptions options(Eigen::Index size) const {
    return integration_options(tables->layout, parameters, numbers, request.tolerance,
                               std::min(mechanism.duration() / 100.0, request.longest_step), size, request.most_steps);
  }

  // W of the directions, from `first` on.
  template <int W>
  void directions(int first, int count, bool parameters_too, SensitiveMotion& out) const {
    const int n2 = 2 * tables->layout.n, by_parameters = parameters_too ? static_cast<int>(numbers.by.size()) : 0;
    ContactNumbers seeded = numbers;
    if (!parameters_too) seeded.by.clear();
    SensitiveSystem<W> system(mechanism, parameters, tables, seeded, first,
                              parameters_too ? request.beside : std::vector<TablesBeside>{});
    VecX Y = VecX::Zero(system.size());
    Y.head(n2) = request.start_state;
    for (int d = 0; d < W; ++d)
      if (const int i = first + d - by_parameters; i >= 0 && i < n2 && first + d < count) Y[n2 + W * i + d] = 1.0;
    if (request.start_by_parameters.size() > 0)
      for (int d = 0; d < W && first + d < by_parameters; ++d)
        for (int i = 0; i < n2; ++i) Y[n2 + W * i + d] = request.start_by_parameters(i, first + d);
    IntegrationOptions held = options(Y.size());
    if (request.derivative_tolerance > 0.0) {
      const double share = request.derivative_tolerance / request.tolerance;
      const auto own = held.absolute_tolerances.head(n2).eval();
      const double length = own[0] / request.tolerance;
      for (int d = 0; d < W && first + d < count; ++d) {
        const int i = first + d - by_parameters;
        const double size = i < 0 ? numbers.values[first + d] : i < n2 / 2 ? length : length / kFlightTime;
        for (int k = 0; k < n2; ++k) held.absolute_tolerances[n2 + W * k + d] = share * own[k] / size;
      }
    }
    out.steps += follow<ShiftedSensitivities<W>>(system, request, held, Y, [&](std::size_t k, const VecX& at) {
                   out.state.col(static_cast<Eigen::Index>(k)) = at.head(n2);
                   for (int d = 0; d < W && first + d < count; ++d)
                     for (int i = 0; i < n2; ++i) out.by[k](i, first + d) = at[n2 + W * i + d];
                 }).steps;
    if (first == 0) note_impacts(system, out);
  }

  template <typename S>
  void note_impacts(const S& system, SensitiveMotion& out) const {
    for (std::size_t k = 0; k < system.approach_speed.size(); ++k) {
      const int c = system.approach_joint[k];
      const double speed = system.approach_speed[k], least = numbers.joints[c].minimum_impact_speed;
      if (speed > least) {
        out.impact_speed.push_back(speed);
        out.impact_joint.push_back(c);
      }
      if (speed < (request.grazing_speed > 0.0 ? request.grazing_speed : 2.0 * least))
        out.grazing.push_back({system.approach_time[k], c, speed});
    }
  }
};

}  // namespace

double longest_step_of(const PreparedScene& scene) {
  return std::min(kTurnOfAStep * scene.own_time(), kStepOfLoads * scene.load_time());
}

SensitiveMotion follow_with_sensitivity(const Mechanism& mechanism, const Parameters& parameters,
                                        const std::shared_ptr<const SceneTables>& tables, const ContactNumbers& numbers,
                                        const MotionRequest& request) {
  const int n2 = 2 * tables->layout.n;
  if (n2 == 0)
    throw ComputationError("no play of this mechanism can move: nothing deviates, so there are no slopes to follow");
  const int count =
      (request.by_parameters ? static_cast<int>(numbers.by.size()) : 0) + (request.by_start_state ? n2 : 0);
  SensitiveMotion out;
  out.state.resize(n2, static_cast<Eigen::Index>(request.times.size()));
  const Follower follower{mechanism, parameters, tables, numbers, request};
  if (count == 0) {
    PerturbationSystem system(mechanism, parameters, tables, false);
    VecX y = request.start_state;
    out.steps = follow<ShiftedJacobian>(system, request, follower.options(n2), y, [&](std::size_t k, const VecX& at) {
                  out.state.col(static_cast<Eigen::Index>(k)) = at;
                }).steps;
    return out;
  }
  out.by.assign(request.times.size(), MatX::Zero(n2, count));
  // Directions in batches of a width that is compiled in.
  for (int first = 0; first < count;) {
    const int left = count - first;
    const bool parameters_too = request.by_parameters;
    if (left <= 4) {
      follower.directions<4>(first, count, parameters_too, out);
      first += 4;
    } else if (left <= 6) {
      follower.directions<6>(first, count, parameters_too, out);
      first += 6;
    } else if (left <= 10) {
      follower.directions<10>(first, count, parameters_too, out);
      first += 10;
    } else {
      follower.directions<12>(first, count, parameters_too, out);
      first += 12;
    }
  }
  return out;
}

bool implicit_steps_pay(const Mechanism& mechanism, const Parameters& parameters,
                        const std::shared_ptr<const SceneTables>& tables, const ContactNumbers& numbers,
                        const MotionRequest& request) {
  const int n2 = 2 * tables->layout.n;
  if (n2 == 0) return false;
  const Follower follower{mechanism, parameters, tables, numbers, request};
  const auto followed = [&](bool implicit, long most_steps) {
    MotionRequest plain = request;
    plain.implicit = implicit;
    plain.times.clear();
    IntegrationOptions options = follower.options(n2);
    options.most_steps = most_steps;
    PerturbationSystem system(mechanism, parameters, tables, false);
    VecX y = request.start_state;
    return follow<ShiftedJacobian>(system, plain, options, y, [](std::size_t, const VecX&) {});
  };
  // With directions an implicit step evaluates all of it once a coordinate more. Where so many are needed, it is not damping that keeps steps
  // short.
  constexpr double kOthers = 8.0, kExplicit = 6.0;
  constexpr long kMany = 200'000;
  long most = 0;
  try {
    most = static_cast<long>((kOthers + n2) / kExplicit * static_cast<double>(followed(true, kMany).steps));
  } catch (const ComputationError&) {
    return false;
  }
  try {
    followed(false, std::max(most, 1L));
  } catch (const ComputationError&) {
    return true;
  }
  return false;
}

}  // namespace boresight
