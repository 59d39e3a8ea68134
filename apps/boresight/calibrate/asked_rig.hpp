// The test rig that --make-data and its options ask for.
#pragma once

#include <cstdint>
#include <filesystem>
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

// Measured data may have taken a year: throws OutputDirectoryError where a file is there that --make-data did not write.
void check_that_data_may_be_written(const std::filesystem::path& file);

}  // namespace boresight::app
