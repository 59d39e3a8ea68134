// Why a prescribed motion cannot be followed from some pose on.
#pragma once

#include <string>

#include "boresight/mechanism/mechanism.hpp"

namespace boresight {

// step: the shortest that was tried from t on [s]. Part of a sentence: where a law itself moves too far in it, that; else what the pose may be.
std::string why_not_followed(const Mechanism& mechanism, double t, double step);

}  // namespace boresight
