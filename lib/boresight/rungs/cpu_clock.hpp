// CPU time of the calling thread: what a run costs, whatever else the machine does.
#pragma once

#include <time.h>

namespace boresight {

inline double thread_cpu_seconds() {
  timespec t;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

}  // namespace boresight
