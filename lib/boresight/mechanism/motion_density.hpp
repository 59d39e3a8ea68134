// A motion that would take more memory than there is to hold, as a table of states: thousands of turns.
#pragma once

#include "boresight/mechanism/error.hpp"

namespace boresight {

class MotionTooDense : public ComputationError {
 public:
  using ComputationError::ComputationError;
};

// What a table may take [bytes], of the ideal motion as of what is derived from it.
inline constexpr double kMostTableBytes = 2e9;

}  // namespace boresight
