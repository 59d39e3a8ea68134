// What the integrators ask of a problem y' = f(t, y, memory): an initial value problem whose right-hand side also
// depends on a discrete memory (which contacts are closed, at what speed each began) that changes at events only.
//
//   class BouncingMass {
//    public:
//     void derivative(double t, const VecX& y, VecX& dy) const;      // f; smooth as long as the memory stays
//     void jacobian(double t, const VecX& y, MatX& J) const;         // df/dy; left out: by finite differences
//     void time_derivative(double t, const VecX& y, VecX& ft) const; // df/dt; left out: by finite differences
//     static constexpr bool autonomous = true;                       // f has no t of its own: df/dt = 0
//     int gap_count() const;                                         // events, where there are any:
//     void gaps(double t, const VecX& y, VecX& g) const;             // open while g > 0
//     AfterEvent on_event(const GapEvent& event, VecX& y);           // the only place where the memory may change
//     void settle(double t, VecX& y);                                // after an accepted step, where there are
//     constraints to keep
//   };
//
// Integrators see the problem as const while they try a step, so a rejected step cannot leave a trace in it.
// A right-hand side that changes its form at a gap should follow the memory and not the sign of the gap: a contact that
// the memory calls open gives no force, even where a trial step dips below zero. The step is then smooth up to the
// event and the event is found on the free flight itself.
#pragma once

#include <concepts>

#include "boresight/math/types.hpp"

namespace boresight {

enum class Crossing {
  closing,  // from g > 0 to g <= 0: a contact begins
  opening,  // back
  lasting,  // closed again sooner than the event floor after it opened: from here on the gap chatters, and crossings of
            // it are neither located nor reported, until it is
  released,  // open for longer than the event floor
};

struct GapEvent {
  int gap;
  double t;  // [s]
  Crossing crossing;
};

enum class AfterEvent {
  crossed,    // the gap goes on to the other side
  reflected,  // y was changed so that the gap returns to the side it came from (an instantaneous impact)
  stop,       // end the integration here
};

template <typename S>
concept System = requires(const S& s, double t, const VecX& y, VecX& dy) {
  s.derivative(t, y, dy);
};

template <typename S>
concept HasGaps = System<S> && requires(S& s, const S& c, const GapEvent& event, double t, VecX& y) {
  { c.gap_count() } -> std::convertible_to<int>;
  c.gaps(t, y, y);
  { s.on_event(event, y) } -> std::same_as<AfterEvent>;
};

template <typename S>
concept GivesJacobian = requires(const S& s, double t, const VecX& y, MatX& jacobian) {
  s.jacobian(t, y, jacobian);
};

template <typename S>
concept GivesTimeDerivative = requires(const S& s, double t, const VecX& y, VecX& ft) {
  s.time_derivative(t, y, ft);
};

// What keeps an accepted state on its constraints, by a change far below the tolerance of a step.
template <typename S>
concept Stabilises = requires(S& s, double t, VecX& y) {
  s.stabilise(t, y);
};

template <typename S>
concept Autonomous = requires {
  requires S::autonomous;
};

}  // namespace boresight
