// Text into a GiNaC expression, piece by piece, so that nothing reaches GiNaC whose evaluation could explode (GiNaC computes
// 9^9^9^9 exactly as soon as it sees it) and every fault can be named. Internal to this room; hold `ginac_lock()` throughout.
#pragma once

#include <ginac/ginac.h>

#include <map>
#include <mutex>
#include <string>

namespace boresight {

std::mutex& ginac_lock();  // GiNaC counts references without atomics

// |x| with derivative sign(x); sign has derivative 0. (GiNaC's own abs differentiates through complex conjugates.)
DECLARE_FUNCTION_1P(magnitude)
DECLARE_FUNCTION_1P(sign_of)

// Throws ValueFault.
GiNaC::ex parse_to_ginac(const std::string& text, const std::map<std::string, GiNaC::ex>& names);

}  // namespace boresight
