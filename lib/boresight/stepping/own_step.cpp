#include "boresight/stepping/own_step.hpp"

#include <algorithm>

#include "boresight/formulations/own_modes.hpp"
#include "boresight/integrate/explicit_runge_kutta.hpp"
#include "boresight/mechanism/load_time.hpp"
#include "boresight/stepping/motion_scales.hpp"
#include "boresight/stepping/unstable_step.hpp"

namespace boresight {

double own_step(const Mechanism& mechanism, const Parameters& parameters, const IdealMotion& ideal) {
  return own_step(mechanism, parameters, ideal, load_time(mechanism));
}

double own_step(const Mechanism& mechanism, const Parameters& parameters, const IdealMotion& ideal, double of_loads) {
  double step = longest_step(mechanism.duration());
  // A motion that is fast for a moment is not stepped over.
  step = std::min(step, kTurnOfAStep * own_time(ideal, mechanism.bodies(), mechanism.characteristic_length()));
  step = std::min(step, kStepOfLoads * of_loads);
  // The joints' contacts taken together, at twice the largest ideal reaction: what a load suddenly applied to an elastic
  // contact reaches.
  for (const ContactFrequency& c : analyse_contacts(mechanism, parameters, ideal))
    if (c.largest_stable_step > 0.0) step = std::min(step, kShareOfStableStep * c.largest_stable_step);
  if (const double stable = largest_step_of_springs(mechanism, parameters, ideal); stable > 0.0)
    step = std::min(step, kShareOfStableStep * stable);
  return step;
}

double largest_step_of_springs(const Mechanism& mechanism, const Parameters& parameters, const IdealMotion& ideal) {
  const double rate = fastest_own_rate(mechanism, parameters, ideal);
  return rate > 0.0 ? classical_rk4().real_limit / rate : 0.0;
}

}  // namespace boresight
