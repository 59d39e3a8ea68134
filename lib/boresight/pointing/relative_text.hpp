// A relative error as people read it: "0.23 %", "350 %"; beyond that no percentage tells anything ("1e+11 %"), and it is "35 times
// the value itself", or "over 10000 times the value itself" where the value is next to nothing.
#pragma once

#include <string>

namespace boresight {

// From here on a relative error is said as a multiple.
inline constexpr double kSaidAsMultiple = 10.0;

// digits: significant ones of a percentage. "not known" of what is not finite.
std::string relative_text(double relative, int digits = 2, const std::string& of = "the value itself");

}  // namespace boresight
