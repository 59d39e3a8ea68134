// Integrates y' = f(t, y, memory) from event to event with any method of method.hpp: fixed steps or error control,
// events located inside accepted steps, memory changed at events only.
//
//   Integrator<RosenbrockMethod> integrator({rodas4(), y.size()}, problem.gap_count());
//   IntegrationSummary summary = integrator.run(problem, 0.0, 1.0, y, {.relative_tolerance = 1e-5}, [&](const auto&
//   step) {
//     for (; sample < step.end(); sample += 1e-3) { step.at(sample, state); ... }
//   });
//
// One loop: try a step; reject it if its error is too large; else look for events on its dense output; cut it at the
// first one, let the problem change its memory there, start anew; tell the observer. Room is taken at construction and
// in the first lines of run(), none in a step.
#pragma once

#include <cstdio>
#include <type_traits>
#include <utility>

#include "boresight/integrate/gap_watch.hpp"
#include "boresight/integrate/growth_watch.hpp"
#include "boresight/integrate/step_control.hpp"

namespace boresight {

// A step as the observer sees it, after it was accepted and before the problem's memory changes at its end.
template <typename M>
class AcceptedStep {
 public:
  AcceptedStep(const M& method, double start, double h, double end, const VecX& state)
      : method_(method), start_(start), h_(h), end_(end), state_(state) {}
  double start() const { return start_; }
  double end() const { return end_; }
  const VecX& state() const { return state_; }  // at the end
  // y at a time within the step.
  void at(double t, VecX& y) const { method_.interpolate((t - start_) / h_, y); }

 private:
  const M& method_;
  double start_, h_, end_;
  const VecX& state_;
};

template <typename M>
class Integrator {
 public:
  explicit Integrator(M method, int gaps = 0, int looks_inside_step = IntegrationOptions{}.looks_inside_step)
      : method_(std::move(method)),
        watch_(gaps, method_.size(), looks_inside_step),
        gaps_(gaps),
        looks_(looks_inside_step),
        state_(VecX::Zero(method_.size())),
        probe_(state_),
        probe_slope_(state_) {}

  // From t0 to t_end > t0. y: the state at t0, replaced by that where the run stopped; always finite if it was at the
  // start. observe(const AcceptedStep<M>&): returns nothing, or whether to go on.
  template <typename S, typename Observer>
  requires MethodFor<M, S> IntegrationSummary run(S& system, double t0, double t_end, VecX& y,
                                                  const IntegrationOptions& options, Observer&& observe) {
    start_run(t0);
    std::string fault;
    if (!options.is_valid(y.size(), fault) || !fits(system, y, t0, t_end, options, fault))
      return ended(StopReason::invalid_options, fault);
    const bool fixed = options.step > 0.0;
    StepControl control(options, method_.error_order());
    method_.begin(std::as_const(system), t0, y);
    if constexpr (HasGaps<S>) watch_.start(std::as_const(system), t0, y);
    double h = options.first_step;
    if (!fixed && h == 0.0) h = first_step(std::as_const(system), t0, y, options, t_end - t0);
    double h_before = 0.0;
    for (long attempts = 0; t_ < t_end; ++attempts) {
      if (attempts == options.most_steps) return ended(StopReason::too_many_steps, "more steps than most_steps");
      if (fixed) h = fixed_step(t_end, h_before, options);
      const double remaining = t_end - t_;
      double wanted = std::min(h, options.largest_step);
      if constexpr (requires { method_.jacobian(std::as_const(system), t_, y); })
        if (!fixed && options.follow_growth) {
          if (t_ >= next_look_at_growth_) {
            look_at_growth(std::as_const(system), y, options, remaining);
            next_look_at_growth_ = t_ + (t_end - t0) / kLooksAtGrowth;
          }
          wanted = std::min(wanted, growth_step_);
        }
      // A last step that would leave a crumb is stretched or halved.
      if (!fixed && wanted > 0.99 * remaining)
        wanted = remaining;
      else if (!fixed && wanted > 0.5 * remaining)
        wanted = 0.5 * remaining;
      const double smallest =
          std::max(options.smallest_step, 8.0 * std::numeric_limits<double>::epsilon() * std::abs(t_));
      if (wanted < std::min(smallest, remaining)) return ended(StopReason::step_too_small, "");
      h = wanted;

      // Try.
      const Attempt attempt = method_.attempt(std::as_const(system), t_, h, y);
      const bool finite = attempt == Attempt::done && method_.proposed().allFinite();
      if (!finite) {
        count_failure(attempt);
        if (fixed) return ended(attempt == Attempt::done ? StopReason::not_finite : StopReason::attempt_failed, "");
        h *= control.reject(std::numeric_limits<double>::infinity());
        continue;
      }
      const bool estimates = method_.error_order() > 0;
      double error = estimates ? error_norm(method_.error(), y, method_.proposed(), options) : 0.0;
      if (!fixed && !(error <= 1.0)) {
        ++summary_.rejected_by_error;
        h *= control.reject(error);
        continue;
      }

      // Take it, whole or up to its first event.
      method_.finish(std::as_const(system), t_ + h);
      double share = 1.0;
      bool events = false;
      long below_floor = 0;
      if constexpr (HasGaps<S>) {
        share = watch_.first_event(std::as_const(system), method_, t_, h, options);
        events = !watch_.due().empty();
        watch_.save();
        below_floor = watch_.follow_lasting(std::as_const(system), method_, t_, h, share);
      }
      const bool cut = share < 1.0;
      double length = cut ? share * h : h;
      if (cut) {
        const Attempt shorter = stop_at_event(std::as_const(system), y, options, length);
        if (shorter != Attempt::done) {
          count_failure(shorter);
          if (fixed) return ended(StopReason::attempt_failed, "");
          if constexpr (HasGaps<S>) watch_.restore();
          h = std::min(h, length) * control.reject(std::numeric_limits<double>::infinity());
          continue;
        }
        // The whole step may have passed by luck, with a contact begun and ended inside it.
        const double cut_error = estimates ? error_norm(method_.error(), y, method_.proposed(), options) : 0.0;
        if (!fixed && !(cut_error <= 1.0)) {
          ++summary_.rejected_by_error;
          if constexpr (HasGaps<S>) watch_.restore();
          // Mended, it may be longer than the step that found it: that one again would find it for ever.
          h = std::min(h, length) * control.reject(cut_error);
          continue;
        }
        // A fixed step is judged by what is taken of it; under error control the whole step's error sets the next one.
        if (fixed) error = cut_error;
      }
      summary_.largest_error = std::max(summary_.largest_error, error);
      if (fixed && error > options.most_error) return ended(StopReason::error_too_large, "");
      summary_.crossings_below_floor += below_floor;
      const double end = cut ? t_ + length : (remaining <= h * (1.0 + 1e-12) ? t_end : t_ + h);
      state_ = method_.proposed();
      bool goes_on = true;
      const AcceptedStep<M> step(method_, t_, length, end, std::as_const(state_));
      if constexpr (std::is_same_v<decltype(observe(step)), bool>)
        goes_on = observe(step);
      else
        observe(step);
      count_step(h, cut);
      y = state_;
      t_ = end;
      if (!goes_on) return ended(StopReason::stopped_by_observer, "");
      if constexpr (Stabilises<S>) system.stabilise(t_, y);

      // Let the problem change its memory, and start anew where it did.
      bool changed = false, stop = false;
      if constexpr (HasGaps<S>) changed = report_events(system, y, options, stop) || events;
      if (stop) return ended(StopReason::stopped_by_event, "");
      const double factor = fixed ? 1.0 : control.accept(error);
      h_before = h;
      if (changed) {
        method_.begin(std::as_const(system), t_, y);
        if constexpr (HasGaps<S>) watch_.restart(std::as_const(system), t_, y);
        control.restart();
        if (!fixed) h = restart_step(std::as_const(system), t_, y, options, std::max(h * factor, cut ? h : 0.0));
        h_before = 0.0;
      } else {
        method_.advance();
        // A settled state has moved away from where the end slope belongs: too far for a Jacobian by differences from
        // it.
        if constexpr (Stabilises<S> && requires { method_.refresh(std::as_const(system), t_, y); })
          method_.refresh(std::as_const(system), t_, y);
        if constexpr (HasGaps<S>) watch_.advance();
        h *= factor;
      }
    }
    return ended(StopReason::reached_end, "");
  }

  template <typename S>
  IntegrationSummary run(S& system, double t0, double t_end, VecX& y, const IntegrationOptions& options) {
    return run(system, t0, t_end, y, options, [](const auto&) {});
  }

  const M& method() const { return method_; }
  const GapWatch& watch() const { return watch_; }

 private:
  void start_run(double t0) {
    summary_ = {};
    summary_.smallest_step = std::numeric_limits<double>::infinity();
    method_.cost() = {};
    t_ = t0;
    growth_step_ = std::numeric_limits<double>::infinity();
    next_look_at_growth_ = t0;
  }

  template <typename S>
  bool fits(const S& system, const VecX& y, double t0, double t_end, const IntegrationOptions& options,
            std::string& fault) const {
    if (y.size() != method_.size()) fault = "y: its size is not that of the method";
    if (!y.allFinite()) fault = "y: not finite at the start";
    if (!(t_end >= t0)) fault = "t_end: before t0";
    if (options.step == 0.0 && method_.error_order() == 0)
      fault = std::string("step: found 0, expected a step, for ") + method_.name() + " has no error estimate";
    if (options.looks_inside_step != looks_) fault = "looks_inside_step: not that of the Integrator's construction";
    if constexpr (HasGaps<S>) {
      if (system.gap_count() != gaps_) fault = "gap_count: not that of the Integrator's construction";
    }
    (void)system;
    return fault.empty();
  }

  IntegrationSummary ended(StopReason reason, const std::string& message) {
    summary_.stop = reason;
    summary_.message = message;
    summary_.t = t_;
    summary_.cost = method_.cost();
    summary_.gap_evaluations = watch_.evaluations;
    if (summary_.smallest_step > summary_.largest_step) summary_.smallest_step = summary_.largest_step;
    if (message.empty() && reason != StopReason::reached_end) {
      char text[96];
      std::snprintf(text, sizeof text, "%s at t = %.9g s", to_string(reason), t_);
      summary_.message = text;
    }
    return summary_;
  }

  void count_failure(Attempt attempt) {
    if (attempt == Attempt::done) ++summary_.rejected_not_finite;
    if (attempt == Attempt::singular_matrix) ++summary_.rejected_singular;
    if (attempt == Attempt::no_convergence) ++summary_.rejected_no_convergence;
  }

  void count_step(double h, bool cut) {
    ++summary_.steps;
    summary_.cut_by_event += cut;
    summary_.stiff_steps += h * method_.step_stiffness() > method_.stability_limit();
    if (cut) return;
    summary_.smallest_step = std::min(summary_.smallest_step, h);
    summary_.largest_step = std::max(summary_.largest_step, h);
    summary_.last_step = h;
  }

  // The step up to an event is taken anew: its dense output found the event, but may have bent where the force ends
  // behind it, and is of lower order than the step. Where the gap is not yet zero, or no longer, the length is mended:
  // a contact whose memory and gap disagree by more than rounding would open and close once more at once.
  template <typename S>
  Attempt stop_at_event(const S& system, const VecX& y, const IntegrationOptions& options, double& length) {
    for (int attempt = 0;; ++attempt) {
      const Attempt done = method_.attempt(system, t_, length, y);
      if (done != Attempt::done) return done;
      if (!method_.proposed().allFinite()) return Attempt::no_convergence;
      method_.finish(system, t_ + length);
      double missing = 0.0;
      if constexpr (HasGaps<S>) missing = watch_.missing_time(system, method_, t_, length, options);
      if (missing == 0.0 || attempt == kMendings) return Attempt::done;
      length += missing;
    }
  }
  static constexpr int kMendings = 3;

  // Whole steps to the end, all alike; shorter beside a rough point.
  double fixed_step(double t_end, double h_before, const IntegrationOptions& options) {
    const double remaining = t_end - t_;
    const double step = remaining / std::max(1.0, std::ceil(remaining / options.step - 1e-9));
    if (options.grading_time == 0.0 || gaps_ == 0) return step;
    return std::min(step, watch_.graded_step(t_, options.step, h_before, options));
  }

  // Hairer, Norsett, Wanner (1993), section II.4: a step whose explicit Euler would err by 1 % of the tolerance's
  // scale.
  template <typename S>
  double first_step(const S& system, double t, const VecX& y, const IntegrationOptions& options, double longest) {
    const VecX& slope = method_.start_slope();
    const double d0 = error_norm(y, y, y, options), d1 = error_norm(slope, y, y, options);
    const double h = std::min(longest, d0 < 1e-5 || d1 < 1e-5 ? 1e-6 : 0.01 * d0 / d1);
    return std::min({longest, 100.0 * h, step_by_curvature(system, t, y, options, h)});
  }

  // After an event: the step that was going to follow, unless the slope at its end says that it is too long.
  template <typename S>
  double restart_step(const S& system, double t, const VecX& y, const IntegrationOptions& options, double h) {
    return std::min(h, std::max(step_by_curvature(system, t, y, options, h),
                                options.smallest_factor * options.smallest_factor * h));
  }

  template <typename S>
  double step_by_curvature(const S& system, double t, const VecX& y, const IntegrationOptions& options, double h) {
    const VecX& slope = method_.start_slope();
    probe_ = y + h * slope;
    system.derivative(t + h, probe_, probe_slope_);
    ++method_.cost().evaluations;
    probe_ = probe_slope_ - slope;
    const double d1 = error_norm(slope, y, y, options), d2 = error_norm(probe_, y, y, options) / h;
    const double largest = std::max(d1, d2);
    if (!(largest < std::numeric_limits<double>::infinity())) return 1e-3 * h;
    if (largest <= 1e-15) return std::max(1e-6, 1e-3 * h);
    return std::pow(0.01 / largest, 1.0 / (method_.error_order() + 1.0));
  }

  // Steps up to here may have damped what now grows, down from any size that the tolerance does not see: it starts from that.
  template <typename S>
  void look_at_growth(const S& system, VecX& y, const IntegrationOptions& options, double rest) {
    const bool followed = std::isfinite(growth_step_);
    const GrowingVibration grows = growing_vibration(method_.jacobian(system, t_, y), rest);
    growth_step_ = grows.step;
    if (followed || !std::isfinite(grows.step) || !(grows.step < options.largest_step)) return;
    y += grows.shape / error_norm(grows.shape, y, y, options);
    method_.begin(system, t_, y);
    if constexpr (HasGaps<S>) watch_.restart(system, t_, y);
  }

  // Returns whether the problem was told of anything.
  template <HasGaps S>
  bool report_events(S& system, VecX& y, const IntegrationOptions& options, bool& stop) {
    bool told = false;
    const auto tell = [&](int k, Crossing crossing) {
      told = true;
      switch (crossing) {
        case Crossing::closing:
          ++summary_.closings;
          break;
        case Crossing::opening:
          ++summary_.openings;
          break;
        case Crossing::lasting:
          ++summary_.lastings;
          break;
        case Crossing::released:
          ++summary_.releases;
          break;
      }
      const AfterEvent after = system.on_event({k, t_, crossing}, y);
      stop = stop || after == AfterEvent::stop;
      return after;
    };
    for (int k : watch_.due()) {
      if (watch_.lasting(k)) tell(k, Crossing::released);
      if (tell(k, watch_.cross(k, t_, options.event_floor)) == AfterEvent::reflected) watch_.reflect(k, t_);
    }
    for (int k = watch_.release(t_, options.event_floor); k >= 0; k = watch_.release(t_, options.event_floor))
      tell(k, Crossing::released);
    return told;
  }

  M method_;
  GapWatch watch_;
  int gaps_, looks_;
  VecX state_, probe_, probe_slope_;
  double t_ = 0.0;
  // The longest step that follows what grows [s]. It is looked for so often in a run: eigenvalues are dear.
  static constexpr double kLooksAtGrowth = 64.0;
  double growth_step_ = 0.0, next_look_at_growth_ = 0.0;
  IntegrationSummary summary_;
};

}  // namespace boresight
