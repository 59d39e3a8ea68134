#include "boresight/stepping/located_motion.hpp"

#include <cstdio>

namespace boresight {

ComputationError misleading_step(const std::string& method, const IntegrationSummary& summary,
                                 const IntegrationOptions& options) {
  char text[300];
  std::snprintf(text, sizeof text,
                "step too large: at t = %.6g s one step of %.4g s errs by %.3g times the smallest clearance (the "
                "estimate of %s), "
                "and what follows would mislead; take a smaller step, or none, so that steps follow the error estimate",
                summary.t, options.step, kMisleadingError * summary.largest_error / options.most_error, method.c_str());
  return ComputationError(text);
}

void report_integration(const RunOptions& run, const std::string& rung, const std::string& integrator,
                        const IntegrationSummary& summary, RunResult& result) {
  const char* name = integrator == "dopri5"       ? "Dormand-Prince 5(4)"
                     : integrator == "rosenbrock" ? "RODAS4"
                                                  : "generalized-alpha";
  char text[160];
  if (run.step > 0.0)
    std::snprintf(text, sizeof text, "%s, h = %.6g s, contacts located", name, run.step);
  else
    std::snprintf(text, sizeof text, "%s, tolerance %.3g, contacts located", name, tolerance_of(run, rung));
  result.integrator = text;
  result.cost.steps = summary.steps;
  result.cost.rejected_steps = summary.rejected();
  result.cost.evaluations = summary.cost.evaluations;
  // Beyond the stability limit a fixed step does not always blow up: a contact's force is bounded by its own depth.
  if (run.step > 0.0 && 50 * summary.stiff_steps > summary.steps) {
    std::snprintf(text, sizeof text, "%ld of %ld steps were beyond the method's stability limit in contact",
                  summary.stiff_steps, summary.steps);
    result.warnings.push_back(text);
  }
}

}  // namespace boresight
