// The machine that times were measured on: they mean nothing without it.
#pragma once

#include <string>

namespace boresight {

struct Machine {
  std::string processor;  // as the system names it; "unknown" where it does not
  int cores = 0;
  std::string compiler, build;  // "GCC 12.2.0", "optimised" or "with assertions"
  double load = 0.0;            // runnable processes, mean over the last minute
};

Machine this_machine();

}  // namespace boresight
