// What makes a one-step method interchangeable in the Integrator, and what it counts.
//
// One step: begin() once after a start or an event; then attempt(), as often as it takes with other h; finish() on the
// attempt that is taken; interpolate() within it; advance(), or begin() again where an event cut the step short.
#pragma once

#include <concepts>

#include "boresight/integrate/system.hpp"

namespace boresight {

enum class Attempt { done, singular_matrix, no_convergence };

struct MethodCost {
  long evaluations = 0;  // of the right-hand side, those for finite differences among them
  long jacobians = 0;
  long decompositions = 0;  // of the iteration matrix
  long iterations = 0;      // of Newton's method
};

template <typename M, typename S>
concept MethodFor = System<S> && requires(M& m, const M& c, const S& system, double t, const VecX& y, VecX& out) {
  { c.name() } -> std::convertible_to<const char*>;
  { c.order() } -> std::convertible_to<int>;
  { c.error_order() } -> std::convertible_to<int>;  // the error estimate is O(h^(error_order + 1)); 0: there is none
  { c.size() } -> std::convertible_to<Eigen::Index>;
  m.begin(system, t, y);
  { m.attempt(system, t, t, y) } -> std::same_as<Attempt>;  // (system, t, h, y)
  { c.proposed() } -> std::convertible_to<const VecX&>;     // y1
  { c.error() } -> std::convertible_to<const VecX&>;        // estimate of the local error of y1
  m.finish(system, t);    // at the end of the step: what dense output and the next step need
  c.interpolate(t, out);  // y at a share of the step in [0, 1]
  { c.start_slope() } -> std::convertible_to<const VecX&>;
  m.advance();
  { c.step_stiffness() } -> std::convertible_to<double>;  // the fastest rate met in the step [1/s]; 0: not measured
  {
    c.stability_limit()
    } -> std::convertible_to<double>;  // of h times a rate, decay or vibration; infinite if A-stable
  { m.cost() } -> std::same_as<MethodCost&>;
};

// The cubic through y0 and y1 with the slopes f0 and f1 there, h apart, at a share of the way.
// Hairer, Norsett, Wanner (1993), equation II.6.7.
inline void hermite(double share, double h, const VecX& y0, const VecX& f0, const VecX& y1, const VecX& f1, VecX& out) {
  const double rest = 1.0 - share;
  const double at0 = rest * rest * (1.0 + 2.0 * share), at1 = share * share * (1.0 + 2.0 * rest);
  out.noalias() = at0 * y0 + at1 * y1 + (h * share * rest * rest) * f0 - (h * share * share * rest) * f1;
}

}  // namespace boresight
