// Entry for libFuzzer (preset fuzz): a table of measured pointing data, as calibrate reads it.
//   build/fuzz/bin/data_fuzzer CORPUS examples/calibration
#include <sys/mman.h>
#include <unistd.h>

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "boresight/mechanism/error.hpp"
#include "boresight_analyses/calibration/measured_data.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const int file = ::memfd_create("table", 0);
  if (::ftruncate(file, 0) != 0 || ::pwrite(file, data, size, 0) != static_cast<ssize_t>(size)) std::abort();
  try {
    const boresight::MeasuredData read = boresight::read_measured_data("/proc/self/fd/" + std::to_string(file));
    for (std::size_t k = 0; k < read.time.size(); ++k)
      if (!std::isfinite(read.time[k]) || (k > 0 && !(read.time[k] > read.time[k - 1]))) {
        std::fprintf(stderr, "let through: time %zu\n", k);
        std::abort();
      }
  } catch (const boresight::InputError&) {
  }
  return 0;
}
