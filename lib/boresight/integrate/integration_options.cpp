#include "boresight/integrate/integration_options.hpp"

#include <ostream>
#include <sstream>

namespace boresight {
namespace {

struct Check {
  std::string& error;
  bool valid = true;
  void need(bool holds, const char* name, double found, const char* expected) {
    if (holds || !valid) return;
    std::ostringstream text;
    text << name << ": found " << found << ", expected " << expected;
    error = text.str();
    valid = false;
  }
};

}  // namespace

bool IntegrationOptions::is_valid(Eigen::Index size, std::string& error) const {
  Check check{error};
  check.need(step >= 0.0, "step", step, "a positive time, or 0 for error control");
  check.need(most_error > 0.0, "most_error", most_error, "a number above 0");
  check.need(relative_tolerance >= 0.0, "relative_tolerance", relative_tolerance, "a number not below 0");
  check.need(absolute_tolerance >= 0.0, "absolute_tolerance", absolute_tolerance, "a number not below 0");
  check.need(relative_tolerance > 0.0 || absolute_tolerance > 0.0 || absolute_tolerances.size() > 0,
             "relative_tolerance", relative_tolerance, "this or absolute_tolerance above 0");
  check.need(absolute_tolerances.size() == 0 || absolute_tolerances.size() == size, "absolute_tolerances",
             static_cast<double>(absolute_tolerances.size()), "no entries, or one for each unknown");
  check.need(absolute_tolerances.size() == 0 || absolute_tolerances.minCoeff() >= 0.0, "absolute_tolerances",
             absolute_tolerances.size() == 0 ? 0.0 : absolute_tolerances.minCoeff(), "numbers not below 0");
  check.need(first_step >= 0.0, "first_step", first_step, "a positive time, or 0 for an estimate");
  check.need(smallest_step >= 0.0, "smallest_step", smallest_step, "a time not below 0");
  check.need(largest_step > smallest_step, "largest_step", largest_step, "more than smallest_step");
  check.need(most_steps > 0, "most_steps", static_cast<double>(most_steps), "a positive number");
  check.need(safety > 0.0 && safety < 1.0, "safety", safety, "a number between 0 and 1");
  check.need(smallest_factor > 0.0 && smallest_factor < 1.0, "smallest_factor", smallest_factor,
             "a number between 0 and 1");
  check.need(largest_factor > 1.0, "largest_factor", largest_factor, "a number above 1");
  check.need(gain >= 0.0 && gain <= 0.2, "gain", gain, "a number from 0 to 0.2");
  check.need(event_tolerance >= 0.0, "event_tolerance", event_tolerance, "a time not below 0");
  check.need(event_floor >= 0.0, "event_floor", event_floor, "a time not below 0");
  check.need(looks_inside_step >= 0 && looks_inside_step <= 16, "looks_inside_step", looks_inside_step,
             "a number from 0 to 16");
  check.need(grading_time >= 0.0, "grading_time", grading_time, "a time not below 0");
  check.need(grading_time == 0.0 || step > 0.0, "grading_time", grading_time, "0 unless the step is fixed");
  check.need(grading_time == 0.0 || locate_events, "grading_time", grading_time, "0 unless events are located");
  check.need(grading_power >= 1.0, "grading_power", grading_power, "a number not below 1");
  return check.valid;
}

const char* to_string(StopReason reason) {
  switch (reason) {
    case StopReason::reached_end:
      return "reached the end";
    case StopReason::stopped_by_event:
      return "stopped by an event";
    case StopReason::stopped_by_observer:
      return "stopped by the observer";
    case StopReason::invalid_options:
      return "invalid options";
    case StopReason::too_many_steps:
      return "too many steps";
    case StopReason::step_too_small:
      return "step too small";
    case StopReason::not_finite:
      return "state not finite";
    case StopReason::attempt_failed:
      return "step failed";
    case StopReason::error_too_large:
      return "fixed step too large";
  }
  return "?";
}

std::ostream& operator<<(std::ostream& out, const IntegrationOptions& o) {
  if (o.step > 0.0)
    out << "fixed step " << o.step << " s";
  else
    out << "relative tolerance " << o.relative_tolerance << ", absolute " << o.absolute_tolerance;
  if (o.locate_events)
    out << ", events located to " << o.event_tolerance << " s, floor " << o.event_floor << " s";
  else
    out << ", events at the end of steps";
  if (o.grading_time > 0.0) out << ", graded within " << o.grading_time << " s by power " << o.grading_power;
  return out;
}

std::ostream& operator<<(std::ostream& out, const IntegrationSummary& s) {
  out << to_string(s.stop) << " at " << s.t << " s";
  if (!s.message.empty()) out << " (" << s.message << ")";
  out << "; steps " << s.steps << " from " << s.smallest_step << " to " << s.largest_step << " s, last " << s.last_step
      << " s; rejected: error " << s.rejected_by_error << ", not finite " << s.rejected_not_finite << ", singular "
      << s.rejected_singular << ", no convergence " << s.rejected_no_convergence << "; evaluations "
      << s.cost.evaluations << ", Jacobians " << s.cost.jacobians << ", decompositions " << s.cost.decompositions
      << ", iterations " << s.cost.iterations << "; gaps: evaluations " << s.gap_evaluations << ", closed "
      << s.closings << ", opened " << s.openings << ", lasting " << s.lastings << ", released " << s.releases
      << ", below the floor " << s.crossings_below_floor << ", steps cut " << s.cut_by_event << "; stiff steps "
      << s.stiff_steps;
  return out;
}

}  // namespace boresight
