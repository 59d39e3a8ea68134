// The test rig that --make-data and its options ask for.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "boresight_analyses/calibration/rig.hpp"

namespace boresight::app {

struct AskedRig {
  std::string noise, offset, channels, seed, samples;  // as typed; "": not given

  // Throws InputError naming the option.
  SyntheticRig rig() const;
  // Throws InputError for what is said of a rig where none is asked for.
  void refuse_without_noise() const;
};

// Measured data may have taken a year: throws OutputDirectoryError where a file is there that --make-data did not write.
void check_that_data_may_be_written(const std::filesystem::path& file);

}  // namespace boresight::app
