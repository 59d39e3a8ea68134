#include "boresight/rungs/fast_impacts.hpp"

#include <cstdio>

namespace boresight {

void note_fast_impacts(RunResult& result) {
  for (const ContactSummary& c : result.contact) {
    if (c.impact_speed_above_validity == 0) continue;
    char text[300];
    std::snprintf(
        text, sizeof text,
        ": %lld of %lld impacts were faster than %.3g m/s, up to which the contact law is valid (Love 1944); the "
        "fastest was %.1f times that",
        static_cast<long long>(c.impact_speed_above_validity), static_cast<long long>(c.impacts), c.validity_speed,
        c.max_impact_speed / c.validity_speed);
    result.warnings.push_back(c.joint + text);
  }
}

}  // namespace boresight
