#include "boresight/contact_events/contact_tracker.hpp"

#include <algorithm>
#include <cmath>

namespace boresight {
namespace {

struct ZeroOfGap {
  double share;  // of the step, in [0, 1]
  double rate;   // slope of the gap there
};

// Zero of the cubic through (gap0, rate0) and (gap1, rate1) over a step h, the gaps of opposite sign: Newton kept inside a
// shrinking bracket.
ZeroOfGap cubic_crossing(double gap0, double rate0, double gap1, double rate1, double h) {
  const double c1 = h * rate0, c2 = 3.0 * (gap1 - gap0) - h * (2.0 * rate0 + rate1),
               c3 = 2.0 * (gap0 - gap1) + h * (rate0 + rate1);
  const auto value = [&](double s) { return gap0 + s * (c1 + s * (c2 + s * c3)); };
  const auto slope = [&](double s) { return c1 + s * (2.0 * c2 + s * 3.0 * c3); };
  double low = 0.0, high = 1.0, s = gap0 / (gap0 - gap1);
  for (int k = 0; k < 60; ++k) {
    const double f = value(s);
    if ((f > 0.0) == (gap1 > 0.0))
      high = s;
    else
      low = s;
    double next = s - f / slope(s);
    if (!(next > low && next < high)) next = 0.5 * (low + high);
    if (std::abs(next - s) < 1e-14) break;
    s = next;
  }
  return {s, slope(s) / h};
}

// Where a free flight, carried on with a parabola for its rate, closes the gap within a step h after its newest value.
template <typename FreeFlight>
ZeroOfGap flight_crossing(const FreeFlight& f, double h, double secant_share) {
  // Newton's divided differences of the rate about the newest time.
  const double d1 = f.count > 1 ? (f.rate[0] - f.rate[1]) / (f.t[0] - f.t[1]) : 0.0;
  const double d1_before = f.count > 2 ? (f.rate[1] - f.rate[2]) / (f.t[1] - f.t[2]) : d1;
  const double d2 = f.count > 2 ? (d1 - d1_before) / (f.t[0] - f.t[2]) : 0.0;
  const double back = f.count > 2 ? f.t[0] - f.t[1] : 0.0;
  const auto rate = [&](double s) { return f.rate[0] + s * (d1 + d2 * (s + back)); };
  const auto penetration = [&](double s) {
    return f.penetration + s * (f.rate[0] + s * (0.5 * (d1 + d2 * back) + s * d2 / 3.0));
  };
  double low = 0.0, high = h, s = secant_share * h;
  if (!(penetration(h) > 0.0))
    return {1.0, rate(h)};  // the contact force, not the flight, closed it: at the step's end
  for (int k = 0; k < 60; ++k) {
    const double value = penetration(s);
    (value > 0.0 ? high : low) = s;
    double next = s - value / rate(s);
    if (!(next > low && next < high)) next = 0.5 * (low + high);
    if (std::abs(next - s) < 1e-14 * h) break;
    s = next;
  }
  return {s / h, rate(s)};
}

}  // namespace

ContactTracker::ContactTracker(int clearance, std::string joint_name, const JointPlay& law, bool keep_events,
                               double start)
    : clearance_(clearance),
      places_(law.places()),
      minimum_impact_speed_(law.minimum_impact_speed),
      keep_events_(keep_events),
      start_(start) {
  summary_.joint = std::move(joint_name);
  summary_.validity_speed = law.validity_speed;
  memory_.impact_speed.fill(minimum_impact_speed_);
}

bool ContactTracker::touching() const {
  return std::any_of(memory_.touching.begin(), memory_.touching.end(), [](bool b) { return b; });
}

bool ContactTracker::accept(double t, const std::array<ContactState<double>, kContactPlaces>& contact) {
  bool changed = false;
  const bool touched = touching();
  const double h = t - t_;
  double began = t, ended = t_;
  for (ContactPlace place : places_) {
    const int k = static_cast<int>(place);
    const ContactState<double>& now = contact[k];
    ContactEvent& event = open_[k];
    if (now.penetration > 0.0 && !memory_.touching[k]) {
      ZeroOfGap at{1.0, now.rate};
      if (started_ && last_[k].penetration < 0.0)
        at = flight_crossing(flight_[k], h, last_[k].penetration / (last_[k].penetration - now.penetration));
      flight_[k].count = 0;
      if (started_)
        begin(place, t_ + at.share * h, at.rate);
      else
        begin_at_start(place, t, at.rate);
      began = std::min(began, event.start);
      changed = true;
    } else if (now.penetration <= 0.0 && memory_.touching[k]) {
      const ZeroOfGap at = cubic_crossing(last_[k].penetration, last_[k].rate, now.penetration, now.rate, h);
      end(place, t_ + at.share * h, -at.rate);
      ended = std::max(ended, t_ + at.share * h);
      changed = true;
    }
    if (memory_.touching[k]) {
      deepen(event, t, now.penetration);
    } else {
      memory_.impact_speed[k] = std::max(minimum_impact_speed_, now.rate);
      FreeFlight& f = flight_[k];
      f.t = {t, f.t[0], f.t[1]};
      f.rate = {now.rate, f.rate[0], f.rate[1]};
      f.penetration = now.penetration;
      f.count = std::min(f.count + 1, 3);
    }
  }
  if (started_) {
    const bool touches = touching();
    if (touched && touches) add_touching(t_, t);
    if (!touched && touches) add_touching(began, t);
    if (touched && !touches) add_touching(t_, ended);
  }
  last_ = contact;
  t_ = t;
  started_ = true;
  return changed;
}

void ContactTracker::deepen(ContactEvent& event, double t, double penetration) {
  event.max_penetration = std::max(event.max_penetration, penetration);
  if (counts(t)) summary_.max_penetration = std::max(summary_.max_penetration, penetration);
}

void ContactTracker::add_touching(double from, double to) {
  touching_time_ += std::max(0.0, to - std::max(from, start_));
}

void ContactTracker::note_first_rest(double from, double to) {
  if (settled_ < 0.0 && to - from >= first_touched_) settled_ = from + first_touched_;
}

void ContactTracker::open(ContactPlace place, double t, double speed) {
  const int k = static_cast<int>(place);
  open_[k] = {clearance_, place, t, std::max(speed, 0.0), 0.0, 0.0, 0.0, 0.0};
  if (!touching()) touched_since_ = t;
  memory_.touching[k] = true;
  memory_.impact_speed[k] = std::max(minimum_impact_speed_, speed);
}

void ContactTracker::begin_at_start(ContactPlace place, double t, double speed) {
  first_touched_ = 0.0;
  open(place, t, speed);
}

void ContactTracker::begin(ContactPlace place, double t, double speed) {
  if (first_touched_ < 0.0) first_touched_ = t;
  open(place, t, speed);
  if (!counts(t)) return;
  ++summary_.impacts;
  summary_.max_impact_speed = std::max(summary_.max_impact_speed, speed);
  summary_.impact_speed_above_validity += speed > summary_.validity_speed;
}

void ContactTracker::end(ContactPlace place, double t, double speed) {
  const int k = static_cast<int>(place);
  open_[k].duration = t - open_[k].start;
  open_[k].end_speed = speed;
  if (keep_events_) closed_.push_back(open_[k]);
  memory_.touching[k] = false;
  if (touching()) return;
  if (first_parted_ < 0.0) first_parted_ = t;
  note_first_rest(touched_since_, t);
}

void ContactTracker::observe(double t, const std::array<ContactState<double>, kContactPlaces>& contact) {
  if (touching()) add_touching(t_, t);
  t_ = t;
  for (ContactPlace place : places_) {
    const int k = static_cast<int>(place);
    if (memory_.touching[k])
      deepen(open_[k], t, contact[k].penetration);
    else
      memory_.impact_speed[k] = std::max(minimum_impact_speed_, contact[k].rate);
  }
}

void ContactTracker::observe_forces(const PlayWrench<double>& wrench) {
  const ContactStates<double>& contact = wrench.contact;
  if (counts(t_) && touching()) summary_.max_load = std::max(summary_.max_load, wrench.force.norm());
  for (ContactPlace place : places_) {
    const int k = static_cast<int>(place);
    if (!memory_.touching[k]) continue;
    open_[k].max_force = std::max(open_[k].max_force, contact[k].normal_force);
    if (!counts(t_)) continue;
    summary_.max_force = std::max(summary_.max_force, contact[k].normal_force);
    if (!is_axial(place)) summary_.max_radial_force = std::max(summary_.max_radial_force, contact[k].normal_force);
  }
}

ContactSummary ContactTracker::finish(double t_end, std::vector<ContactEvent>& events) {
  for (ContactPlace place : places_) {
    const int k = static_cast<int>(place);
    if (!memory_.touching[k] || !keep_events_) continue;
    open_[k].duration = t_end - open_[k].start;
    closed_.push_back(open_[k]);
  }
  events.insert(events.end(), closed_.begin(), closed_.end());
  if (touching()) note_first_rest(touched_since_, t_end);
  summary_.contact_fraction = t_end > start_ ? touching_time_ / (t_end - start_) : 0.0;
  if (first_touched_ > 0.0)
    summary_.settled_from = settled_ >= 0.0 ? settled_ : first_parted_ >= 0.0 ? first_parted_ : t_end;
  return summary_;
}

}  // namespace boresight
