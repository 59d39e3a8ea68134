#include "boresight_analyses/calibration/kept_fits.hpp"

namespace boresight {

CalibrationKey::CalibrationKey(const std::string& what, const CalibrationProblem& problem) {
  add(what, problem.sigma, problem.loss.kind, problem.loss.scale, problem.tolerance, problem.derivative_tolerance,
      problem.prior_information());
  for (const Window& w : problem.windows) add(w.run, w.first, w.last, w.start, w.end, w.held_out, w.from_rest);
  for (const CalibrationRun& run : problem.runs)
    for (const ClearanceDescription& c : run.mechanism->description().clearances) add(c.contact_law);
  for (const ModelCorrection& c : problem.corrections) {
    add(c.offset);
    if (c.tangent)
      add(c.tangent->at, c.tangent->time_offset, c.tangent->lag, c.tangent->reading, c.tangent->by_time,
          c.tangent->by_lag, c.tangent->slope);
  }
}

}  // namespace boresight
