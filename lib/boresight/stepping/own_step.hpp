// The step that a rung takes with RK4 where nobody asks for one: the paper's, shortened to what the contacts and the
// mechanism's own springs and dampers leave stable.
#pragma once

#include <utility>

#include "boresight/contact_events/contact_report.hpp"
#include "boresight/stepping/unstable_step.hpp"

namespace boresight {

// [s]. of_loads: load_time() of the mechanism, where the caller has it.
double own_step(const Mechanism& mechanism, const Parameters& parameters, const IdealMotion& ideal, double of_loads);
double own_step(const Mechanism& mechanism, const Parameters& parameters, const IdealMotion& ideal);

// The largest step of RK4 that is stable for springs and dampers alone, contacts left out [s]; 0 where there are none.
double largest_step_of_springs(const Mechanism& mechanism, const Parameters& parameters, const IdealMotion& ideal);

// integrate(), and where the motion blows up with a step that was asked for, and springs or dampers alone ask for a shorter one, that said.
template <typename Integrate>
auto naming_springs(const Mechanism& mechanism, const Parameters& parameters, const IdealMotion& ideal, double asked,
                    Integrate&& integrate) {
  try {
    return integrate();
  } catch (const UnstableStep& failed) {
    if (asked <= 0.0 || failed.largest_step > 0.0) throw;
    const double stable = largest_step_of_springs(mechanism, parameters, ideal);
    if (!(stable > 0.0 && stable < asked)) throw;
    throw UnstableStep(failed, stable, asked);
  }
}

}  // namespace boresight
