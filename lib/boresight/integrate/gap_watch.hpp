// Follows the signs of the gaps over accepted steps and finds where they change.
//
// The side that a gap is on is discrete and kept here: at an event it changes by definition, not by the sign of a gap
// that is zero but for rounding. A crossing is bracketed between two looks at the step's dense output and closed in on
// by the Illinois variant of false position (Dowell and Jarratt 1971, BIT 11, 168-174), which evaluates gaps, never the
// right-hand side.
//
// A gap that closes sooner than the event floor after it opened is lasting. Its crossings are found on the dense output
// only to know how long it has been open: longer than the floor, and it is released.
#pragma once

#include <limits>
#include <vector>

#include "boresight/integrate/integration_options.hpp"

namespace boresight {

class GapWatch {
 public:
  GapWatch(int gaps, Eigen::Index size, int looks_inside)
      : gap_(gaps),
        saved_(gap_),
        looks_(looks_inside + 2),
        values_(gaps, looks_),
        now_(VecX::Zero(gaps)),
        state_(VecX::Zero(size)) {
    due_.reserve(static_cast<std::size_t>(gaps));
  }

  // At a start: every gap on the side of its sign.
  template <HasGaps S>
  void start(const S& system, double t, const VecX& y) {
    evaluate(system, t, y);
    for (std::size_t k = 0; k < gap_.size(); ++k) {
      gap_[k] = {};
      gap_[k].closed = now_[static_cast<Eigen::Index>(k)] <= 0.0;
    }
    values_.col(0) = now_;
    evaluations = 0;
  }

  // The gaps at the start of the next step, after y changed or a step was taken.
  template <HasGaps S>
  void restart(const S& system, double t, const VecX& y) {
    evaluate(system, t, y);
    values_.col(0) = now_;
  }

  // Share of the step at which the first event falls, 1 if there is none; due() lists the gaps concerned.
  template <HasGaps S, typename M>
  double first_event(const S& system, const M& method, double t, double h, const IntegrationOptions& options) {
    due_.clear();
    for (int look = 1; look < looks_; ++look) {
      const double share = share_of(look);
      if (look + 1 < looks_)
        method.interpolate(share, state_);
      else
        state_ = method.proposed();
      evaluate(system, t + share * h, state_);
      values_.col(look) = now_;
    }
    const double tolerance =
        std::max(options.event_tolerance, 4.0 * std::numeric_limits<double>::epsilon() * std::abs(t + h)) / h;
    double first = 1.0;
    for (int k = 0; k < static_cast<int>(gap_.size()); ++k) {
      Gap& gap = gap_[k];
      gap.share = std::numeric_limits<double>::infinity();
      const int look = first_look_beyond(k, gap.side_closed());
      if (look == looks_ || (gap.lasting && !gap.chatters_open)) continue;
      double share = 1.0;
      if (options.locate_events) share = locate(system, method, t, h, k, look, tolerance);
      // A lasting contact that was open for long before it closes again is a new contact, even if no step ended in
      // between.
      if (gap.lasting && t + share * h - gap.opened < options.event_floor) continue;
      gap.share = share;
      first = std::min(first, share);
    }
    for (int k = 0; k < static_cast<int>(gap_.size()); ++k)
      if (gap_[k].share <= first + tolerance) due_.push_back(k);
    return first;
  }

  // Gaps whose events fall together at the share that first_event returned.
  const std::vector<int>& due() const { return due_; }

  // After a step of h up to the event that is due: by how much it should have been longer for the gap to be zero; 0 if
  // that is less than the tolerance of its time.
  template <HasGaps S, typename M>
  double missing_time(const S& system, const M& method, double t, double h, const IntegrationOptions& options) {
    const int k = due_.front();
    constexpr double kBack = 0.1;
    method.interpolate(1.0 - kBack, state_);
    evaluate(system, t + (1.0 - kBack) * h, state_);
    const double before = now_[k];
    state_ = method.proposed();
    evaluate(system, t + h, state_);
    const double rate = (now_[k] - before) / (kBack * h);
    const double missing = rate != 0.0 ? std::clamp(-now_[k] / rate, -kBack * h, kBack * h) : 0.0;
    const double rounding = 4.0 * std::numeric_limits<double>::epsilon() * std::abs(t + h);
    return std::abs(missing) > std::max(options.event_tolerance, rounding) ? missing : 0.0;
  }

  // What the crossing of gap k at t is. The gap goes to the other side unless `reflect` follows.
  Crossing cross(int k, double t, double floor) {
    Gap& gap = gap_[k];
    const bool opens = gap.closed && !gap.lasting;
    if (opens) {
      gap.closed = false;
      gap.opened = t;
      return Crossing::opening;
    }
    const bool chatters = !gap.lasting && t - gap.opened < floor;
    gap.lasting = chatters;
    gap.chatters_open = false;
    gap.closed = true;
    gap.began = t;
    return chatters ? Crossing::lasting : Crossing::closing;
  }
  void reflect(int k, double t) {
    Gap& gap = gap_[k];
    gap.closed = !gap.closed;
    gap.lasting = false;
    gap.opened = t;
  }

  // Follows lasting contacts over an accepted step from t to t + share h without cutting it. Returns the crossings
  // seen.
  template <HasGaps S, typename M>
  long follow_lasting(const S& system, const M& method, double t, double h, double share) {
    long seen = 0;
    for (int k = 0; k < static_cast<int>(gap_.size()); ++k) {
      Gap& gap = gap_[k];
      if (!gap.lasting || gap.share <= share) continue;
      for (int look = 1; look < looks_ && share_of(look) <= share; ++look) {
        if ((values_(k, look) <= 0.0) != gap.chatters_open) continue;
        gap.chatters_open = !gap.chatters_open;
        ++seen;
        if (gap.chatters_open) gap.opened = t + h * locate(system, method, t, h, k, look, 0.01);
      }
    }
    return seen;
  }

  // The sides of all gaps, should the step not be taken after all.
  void save() { saved_ = gap_; }
  void restore() { gap_ = saved_; }

  // The next gap that was lasting and has been open for longer than the floor; -1 if none. It is released by this.
  int release(double t, double floor) {
    for (int k = 0; k < static_cast<int>(gap_.size()); ++k) {
      Gap& gap = gap_[k];
      if (!gap.lasting || !gap.chatters_open || t - gap.opened <= floor) continue;
      gap.lasting = gap.chatters_open = gap.closed = false;
      return k;
    }
    return -1;
  }

  // The step from t that grading allows (IntegrationOptions::grading_time), at most `step`; h_before: the step just
  // taken from the state before, 0 after an event.
  double graded_step(double t, double step, double h_before, const IntegrationOptions& options) {
    const double power = options.grading_power, time = options.grading_time, stride = step / (power * time);
    double h = step;
    for (int k = 0; k < static_cast<int>(gap_.size()); ++k) {
      Gap& gap = gap_[k];
      const double now = values_(k, 0), before = gap.before;
      gap.before = now;
      if (!gap.closed || gap.lasting) continue;
      if (t - gap.began < time) {
        const double from = std::pow((t - gap.began) / time, 1.0 / power);
        h = std::min(h, time * (std::pow(from + stride, power) - std::pow(from, power)));
      }
      if (h_before > 0.0 && now < 0.0 && now > before) {
        const double left = h_before * now / (before - now);
        const double from = std::pow(left / time, 1.0 / power);
        if (left < time && from > stride)
          h = std::min(h, time * (std::pow(from, power) - std::pow(from - stride, power)));
        if (left < time && from <= stride) h = std::min(h, time * std::pow(stride, power));
      }
    }
    return h;
  }

  // The gaps at the end of a step taken whole are those at the start of the next.
  void advance() { values_.col(0) = values_.col(looks_ - 1); }

  bool closed(int k) const { return gap_[k].closed; }
  bool lasting(int k) const { return gap_[k].lasting; }

  long evaluations = 0;

 private:
  static constexpr double kNever = -std::numeric_limits<double>::infinity();
  struct Gap {
    bool closed = false, lasting = false;
    bool chatters_open = false;              // of a lasting contact: where it is in its chatter
    double opened = kNever, began = kNever;  // [s]
    double share = 0.0, before = 0.0;
    bool side_closed() const { return lasting ? !chatters_open : closed; }
  };

  double share_of(int look) const { return static_cast<double>(look) / (looks_ - 1); }

  template <HasGaps S>
  void evaluate(const S& system, double t, const VecX& y) {
    system.gaps(t, y, now_);
    ++evaluations;
  }

  int first_look_beyond(int k, bool closed) const {
    int look = 1;
    while (look < looks_ && (values_(k, look) <= 0.0) == closed) ++look;
    return look;
  }

  // Share at which gap k changes sign between the looks before and at `look`, on the far side of the crossing.
  template <HasGaps S, typename M>
  double locate(const S& system, const M& method, double t, double h, int k, int look, double tolerance) {
    double near = share_of(look - 1), far = share_of(look);
    double at_near = values_(k, look - 1), at_far = values_(k, look);
    const bool far_closed = at_far <= 0.0;
    // At the start of a step that an event began, the gap may be on the wrong side by a rounding.
    if ((at_near <= 0.0) == far_closed) at_near = 0.0;
    int kept = 0;  // how often the same end was kept, in a row: positive for near
    for (int i = 0; i < 100 && far - near > tolerance; ++i) {
      double share = near - (far - near) * at_near / (at_far - at_near);
      if (at_near == 0.0 || !(share > near && share < far)) share = 0.5 * (near + far);
      // Never closer to an end than half the tolerance, so that the bracket closes from both sides.
      share = std::clamp(share, near + 0.5 * tolerance, far - 0.5 * tolerance);
      method.interpolate(share, state_);
      evaluate(system, t + share * h, state_);
      if ((now_[k] <= 0.0) == far_closed) {
        far = share;
        at_far = now_[k];
        kept = std::max(kept, 0) + 1;
        if (kept > 1) at_near *= 0.5;
      } else {
        near = share;
        at_near = now_[k];
        kept = std::min(kept, 0) - 1;
        if (kept < -1) at_far *= 0.5;
      }
    }
    return far;
  }

  std::vector<Gap> gap_, saved_;
  int looks_;
  MatX values_;  // gaps x looks: at the step's start, inside it, at its end
  VecX now_, state_;
  std::vector<int> due_;
};

}  // namespace boresight
