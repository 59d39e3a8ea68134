// The test rig that --make-data and its options ask for.
#pragma once

#include <cstdint>
#include <string>

#include "boresight_analyses/calibration/rig.hpp"

namespace boresight::app {

struct AskedRig {
  std::string noise, offset, channels;  // as typed; "": not given
  std::uint64_t seed = 1;
  std::uint64_t samples = 0;

  // Throws InputError naming the option.
  SyntheticRig rig() const;
};

}  // namespace boresight::app
