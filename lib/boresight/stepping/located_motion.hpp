// Follows a motion with an integrator that locates its contacts, and shows it to a recorder often enough for its
// statistics.
//
// Steps under error control are long where little happens. Maxima and means are taken over the ends of all steps and,
// between them, over the method's dense output on a fixed grid of at most kPaperStep, or a ten thousandth of a motion that
// is longer than a second, which also holds the times of the samples; so they do not depend on how long the steps are.
#pragma once

#include "boresight/integrate/explicit_method.hpp"
#include "boresight/integrate/generalized_alpha.hpp"
#include "boresight/integrate/integrator.hpp"
#include "boresight/integrate/rosenbrock_method.hpp"
#include "boresight/mechanism/error.hpp"
#include "boresight/rungs/integrator_choice.hpp"
#include "boresight/stepping/unstable_step.hpp"

namespace boresight {

// Error of one fixed step, as its method estimates it, over the smallest clearance, from which on a motion is refused: no
// chart and no pilot asks for steps under error control to be worse.
inline constexpr double kMisleadingError = 0.1;
// For IntegrationOptions::most_error. tolerance: share of the smallest clearance that the options' tolerances stand for.
inline double most_error(double tolerance) { return kMisleadingError / tolerance; }
ComputationError misleading_step(const std::string& method, const IntegrationSummary& summary,
                                 const IntegrationOptions& options);

// After so many steps a rung asks whether to go on: implicit ones of many coordinates take a millisecond each.
inline constexpr int kEndsBetweenLooks = 64;

// The finest grid that long motions are looked at on, as a share of them.
inline constexpr double kFinestGrid = 1e-4;

// record(t, y, at_end): shows a state, at the end of a step or inside it; returns whether to go on. Called at the start
// too. taken(step): shows an AcceptedStep, before its end is recorded.
template <typename M, typename S, typename Record, typename Taken>
IntegrationSummary follow_located(M method, S& system, double duration, double sample_spacing, VecX& y,
                                  const IntegrationOptions& options, Record&& record, Taken&& taken) {
  Integrator<M> integrator(std::move(method), system.gap_count(), options.looks_inside_step);
  const double grid =
      step_on_grid(std::min(std::max(kPaperStep, kFinestGrid * duration), duration / 100.0), sample_spacing);
  VecX inside = y;
  record(0.0, y, false);
  long point = 1;
  IntegrationSummary summary = integrator.run(system, 0.0, duration, y, options, [&](const AcceptedStep<M>& step) {
    for (; grid * point < step.end() - 1e-6 * grid; ++point) {
      step.at(grid * point, inside);
      if (!record(grid * point, inside, false)) return false;
    }
    if (grid * point <= step.end() + 1e-6 * grid) ++point;
    taken(step);
    return record(step.end(), step.state(), true);
  });
  if (summary.stop == StopReason::error_too_large) throw misleading_step(integrator.method().name(), summary, options);
  if (!summary.completed())
    throw StepFailed(summary.message + " (" + integrator.method().name() +
                     "): the motion cannot be followed further at this step or tolerance");
  return summary;
}

template <typename S, typename Record, typename Taken>
IntegrationSummary follow_located(const std::string& integrator, S& system, double duration, double sample_spacing,
                                  VecX& y, const IntegrationOptions& options, Record&& record, Taken&& taken) {
  const auto go = [&](auto method) {
    return follow_located(std::move(method), system, duration, sample_spacing, y, options, record, taken);
  };
  if (integrator == "dopri5") return go(ExplicitMethod(dormand_prince54(), y.size()));
  if (integrator == "rosenbrock") return go(RosenbrockMethod(rodas4(), y.size()));
  return go(GeneralizedAlpha(kSpectralRadius, y.size()));
}

// For RunResult: the method with its setting, and its counts.
void report_integration(const RunOptions& run, const std::string& rung, const std::string& integrator,
                        const IntegrationSummary& summary, RunResult& result);

}  // namespace boresight
