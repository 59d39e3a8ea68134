// The step that a rung takes with RK4 where nobody asks for one: the paper's, shortened to what the contacts and the
// mechanism's own springs and dampers leave stable.
#pragma once

#include "boresight/contact_events/contact_report.hpp"

namespace boresight {

// [s]. of_loads: load_time() of the mechanism, where the caller has it.
double own_step(const Mechanism& mechanism, const Parameters& parameters, const IdealMotion& ideal, double of_loads);
double own_step(const Mechanism& mechanism, const Parameters& parameters, const IdealMotion& ideal);

}  // namespace boresight
