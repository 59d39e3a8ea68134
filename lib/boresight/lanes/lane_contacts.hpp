// Which contacts touch, how fast each began, and where in a step the next one begins, one sample a lane.
//
// The memory changes at accepted steps only, and a contact begins where a step ends: a step that starts open and would end
// closed is cut at the crossing of the cubic through the gap and its rate at both ends. Within a step what was open at its start
// does not act, so that the motion goes smoothly through where it would begin, and one cubic finds that place: with the force of
// the new contact in the same step it took three. (A journal that tilts shares one clearance between both its ends: there all act.)
#pragma once

#include <vector>

#include "boresight/lanes/lane_dynamics.hpp"

namespace boresight {

template <typename T>
class LaneContacts {
 public:
  using Mask = typename T::Mask;
  using States = std::vector<std::array<ContactState<T>, kContactPlaces>>;

  LaneContacts(std::size_t joints, const LanePlaces* places)
      : start(joints),
        end(joints),
        tolerance(joints, T(0.0)),
        slowest(joints, T(1e-3)),
        touching_(joints),
        places_(places) {
    for (auto& joint : touching_) joint.fill(Mask::all(false));
  }

  // Share of the step after which the first contact begins that the step must not run into; 1 where there is none.
  T first_beginning(const T& h) const {
    T share(1.0);
    for (std::size_t c = 0; c < start.size(); ++c)
      for (ContactPlace place : places_[c]) {
        const int k = static_cast<int>(place);
        const ContactState<T>&a = start[c][k], &b = end[c][k];
        const Mask open = a.penetration<-tolerance[c], closes = b.penetration> tolerance[c];
        const Mask begins = open & closes, passes = open & !closes & (middle(a, b, h) > tolerance[c]);
        if (any(begins)) share = select(begins, smaller(share, crossing(a, b, h, T(0.5) * tolerance[c])), share);
        if (any(passes))
          share = select(passes, smaller(share, T(0.5)), share);  // through and back: looked at more closely
      }
    return share;
  }

  // Takes the step's end for the start of the next one in these lanes. Returns where a contact has begun.
  Mask accept(const Mask& accepted, std::vector<std::array<T, kContactPlaces>>& impact_speed, T& impacts) {
    Mask began = Mask::all(false);
    for (std::size_t c = 0; c < start.size(); ++c)
      for (ContactPlace place : places_[c]) {
        const int k = static_cast<int>(place);
        const ContactState<T>& now = end[c][k];
        Mask& touching = touching_[c][k];
        // While a contact is open the speed at which it would begin follows the journal.
        impact_speed[c][k] = select(accepted & !touching, larger(slowest[c], now.rate), impact_speed[c][k]);
        const Mask touches = now.penetration > -tolerance[c], begins = accepted & touches & !touching;
        impacts = select(begins, impacts + T(1.0), impacts);
        began = began | begins;
        touching = select(accepted, touches, touching);
        start[c][k].penetration = select(accepted, now.penetration, start[c][k].penetration);
        start[c][k].rate = select(accepted, now.rate, start[c][k].rate);
      }
    return began;
  }

  // What touches acts, at the clearances of `own`; the rest is a metre away.
  template <typename Laws>
  void act(const Laws& own, Laws& acting) const {
    const T here(0.0), away(1.0);
    for (std::size_t c = 0; c < touching_.size(); ++c) {
      if (own[c].tilts) continue;
      const auto& touches = touching_[c];
      const Mask face =
          touches[static_cast<int>(ContactPlace::axial_minus)] | touches[static_cast<int>(ContactPlace::axial_plus)];
      acting[c].radial_clearance =
          own[c].radial_clearance + select(touches[static_cast<int>(ContactPlace::radial)], here, away);
      acting[c].axial_clearance = own[c].axial_clearance + select(face, here, away);
    }
  }

  Mask touching(std::size_t joint) const {
    Mask some = Mask::all(false);
    for (ContactPlace place : places_[joint]) some = some | touching_[joint][static_cast<int>(place)];
    return some;
  }
  Mask touching() const {
    Mask some = Mask::all(false);
    for (std::size_t c = 0; c < touching_.size(); ++c) some = some | touching(c);
    return some;
  }

  // Of the step's middle and end.
  T deepest(const T& h) const {
    T depth(0.0);
    for (std::size_t c = 0; c < start.size(); ++c)
      for (ContactPlace place : places_[c]) {
        const ContactState<T>&a = start[c][static_cast<int>(place)], &b = end[c][static_cast<int>(place)];
        depth = larger(depth, larger(middle(a, b, h), b.penetration));
      }
    return depth;
  }

  // A lane starts anew from end's states. What rests there has not struck: it counts as no impact, and has the least speed.
  void restart(int lane, std::vector<std::array<T, kContactPlaces>>& impact_speed) {
    for (std::size_t c = 0; c < start.size(); ++c)
      for (ContactPlace place : places_[c]) {
        const int k = static_cast<int>(place);
        touching_[c][k].set(lane, end[c][k].penetration.lane(lane) > -tolerance[c].lane(lane));
        impact_speed[c][k].set(lane, slowest[c].lane(lane));
        start[c][k].penetration.set(lane, end[c][k].penetration.lane(lane));
        start[c][k].rate.set(lane, end[c][k].rate.lane(lane));
      }
  }

  States start, end;         // of the step at hand
  std::vector<T> tolerance;  // [m]
  std::vector<T> slowest;    // minimum impact speed [m/s]

 private:
  // Penetration halfway, by the cubic through both ends.
  static T middle(const ContactState<T>& a, const ContactState<T>& b, const T& h) {
    return T(0.5) * (a.penetration + b.penetration) + T(0.125) * h * (a.rate - b.rate);
  }
  // Newton's method kept inside a shrinking bracket; four rounds leave less of the step than the tolerance is worth.
  static T crossing(const ContactState<T>& a, const ContactState<T>& b, const T& h, const T& wanted) {
    const T g0 = a.penetration - wanted, g1 = b.penetration - wanted, d0 = h * a.rate, d1 = h * b.rate;
    const T c2 = T(3.0) * (g1 - g0) - T(2.0) * d0 - d1, c3 = T(2.0) * (g0 - g1) + d0 + d1;
    T low(0.0), high(1.0), s = g0 / (g0 - g1);
    for (int round = 0; round < 4; ++round) {
      const T value = g0 + s * (d0 + s * (c2 + s * c3)), slope = d0 + s * (T(2.0) * c2 + s * T(3.0) * c3);
      const Mask beyond = value > T(0.0);
      high = select(beyond, s, high);
      low = select(beyond, low, s);
      const T newton = s - value / slope;
      s = select((newton > low) & (newton < high), newton, T(0.5) * (low + high));
    }
    return s;
  }

  std::vector<std::array<Mask, kContactPlaces>> touching_;
  const LanePlaces* places_;
};

}  // namespace boresight
