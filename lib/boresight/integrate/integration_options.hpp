// Options of an integration and what it reports: plain structs; both print themselves.
#pragma once

#include <iosfwd>
#include <limits>
#include <string>

#include "boresight/integrate/method.hpp"

namespace boresight {

struct IntegrationOptions {
  // --- step size ---
  // Fixed step [s]; shortened evenly so that whole steps reach the end. 0: chosen by the error estimate.
  double step = 0.0;
  // A step is taken if the root mean square of error_i / (absolute_i + relative max(|y0_i|, |y1_i|)) is at most 1. This
  // bounds the error of one step; the error at the end of the run is some factor of it, which the problem decides.
  // A fixed step is not rejected, but where its error estimate exceeds most_error tolerances the run stops and says so: its
  // result would mislead. Infinite: whatever the estimate says.
  double most_error = std::numeric_limits<double>::infinity();
  double relative_tolerance = 1e-6;
  double absolute_tolerance = 1e-9;  // in the units of y; choose it well below a penetration
  VecX absolute_tolerances{};        // one for each y, in place of the one above; empty: all alike
  double first_step = 0.0;           // [s]; 0: estimated from two slopes
  double smallest_step = 0.0;        // [s]; below it the run stops. 0: some roundings of t
  double largest_step = std::numeric_limits<double>::infinity();  // [s]
  long most_steps = 10'000'000;                                   // attempts, rejected ones included
  // Methods that take df/dy, under error control: no step is too long for a vibration that grows (growth_watch.hpp), which starts
  // as large as the tolerance lets it go unseen. Costs the steps, and the eigenvalues of df/dy now and then.
  bool follow_growth = false;
  // Proportional-integral control: h_new = h safety error^-(1/k - 3/4 gain) error_before^gain, kept between smallest
  // and largest factor, k = order of the error estimate. Hairer and Wanner (1996), equation IV.2.43.
  double safety = 0.9, smallest_factor = 0.2, largest_factor = 5.0, gain = 0.04;

  // --- events ---
  // Off: a gap's change of sign is reported at the end of the step that it is found in.
  bool locate_events = true;
  double event_tolerance = 1e-13;  // [s], of the time of an event; never finer than some roundings of t
  // A gap that closes again sooner than this after it opened [s] chatters: lasting contact, not located until it is
  // released. A flight this long under the acceleration a ends at the speed a floor/2: with floor = 2 minimum impact
  // speed / a, nothing is lost, for the speed that would have been latched lies below the minimum.
  double event_floor = 1e-5;
  // Times inside a step at which gaps are looked at, besides its end: finds a contact that opens and closes within one
  // step.
  int looks_inside_step = 1;

  // --- fixed steps beside a rough point ---
  // A force K d^1.5 is itself rough where it begins: 1.5 powers of the time since the contact began, which hold any method to order 2.5
  // even if a step starts exactly there. Within this time [s] of a closing or an opening, as long as the gap is closed,
  // steps are graded so that t - t_event = time (k step / (power time))^power, which gives the order back (2: up to 4;
  // 3: up to 5). 0: no grading. Steps that follow an error estimate need none.
  double grading_time = 0.0;
  double grading_power = 2.0;

  // False and a sentence with what was found and expected, if a value makes no sense; for a system of `size` unknowns.
  bool is_valid(Eigen::Index size, std::string& error) const;
};
std::ostream& operator<<(std::ostream& out, const IntegrationOptions& options);

enum class StopReason {
  reached_end,
  stopped_by_event,
  stopped_by_observer,
  invalid_options,
  too_many_steps,
  step_too_small,   // the error estimate, or attempts that failed, asked for less than smallest_step
  not_finite,       // with a fixed step: y1 overflowed; y is left at the last finite state
  attempt_failed,   // with a fixed step: singular matrix or no convergence
  error_too_large,  // with a fixed step: its error estimate exceeds most_error
};
const char* to_string(StopReason reason);

struct IntegrationSummary {
  StopReason stop = StopReason::reached_end;
  std::string message;  // for a reader; empty if the end was reached
  double t = 0.0;       // where it stopped [s]
  long steps = 0;       // accepted, those cut short by an event included
  long rejected_by_error = 0, rejected_not_finite = 0, rejected_singular = 0, rejected_no_convergence = 0;
  long cut_by_event = 0;
  MethodCost cost;
  long gap_evaluations = 0;
  long closings = 0, openings = 0;  // reported to the problem as closing and opening
  long lastings = 0, releases = 0;  // reported as lasting and released
  long crossings_below_floor = 0;   // of lasting contacts: seen, neither located nor reported
  // Of explicit methods: accepted steps longer than stability on both axes allows for the fastest rate met. Many of
  // them mean that stability, not accuracy, sets the step.
  long stiff_steps = 0;
  double smallest_step = 0.0, largest_step = 0.0, last_step = 0.0;  // accepted and not cut short [s]
  double largest_error = 0.0;  // estimated, of the steps taken, in tolerances; 0 for a method without an estimate

  long rejected() const {
    return rejected_by_error + rejected_not_finite + rejected_singular + rejected_no_convergence;
  }
  bool completed() const {
    return stop == StopReason::reached_end || stop == StopReason::stopped_by_event ||
           stop == StopReason::stopped_by_observer;
  }
};
std::ostream& operator<<(std::ostream& out, const IntegrationSummary& summary);

}  // namespace boresight
