// How refusals of what is no deviation of the ideal motion end. Whoever gives such a refusal as the reason for something else, the multibody
// rung among them, leaves the advice away.
#pragma once

#include <string>

namespace boresight {

inline constexpr char kUseMultibody[] = "; use the multibody rung";

inline std::string without_advice(const std::string& refusal) { return refusal.substr(0, refusal.find(kUseMultibody)); }

}  // namespace boresight
