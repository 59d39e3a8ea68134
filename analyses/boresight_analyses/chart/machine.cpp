#include "boresight_analyses/chart/machine.hpp"

#include <cstdlib>
#include <fstream>
#include <thread>

namespace boresight {

Machine this_machine() {
  Machine machine;
  machine.processor = "unknown";
  machine.cores = static_cast<int>(std::thread::hardware_concurrency());
#if defined(__clang__)
  machine.compiler = "Clang " __clang_version__;
#elif defined(__GNUC__)
  machine.compiler = "GCC " __VERSION__;
#else
  machine.compiler = "unknown";
#endif
#ifdef NDEBUG
  machine.build = "optimised";
#else
  machine.build = "with assertions";
#endif
  std::ifstream cpu("/proc/cpuinfo");
  for (std::string line; std::getline(cpu, line);) {
    if (line.rfind("model name", 0) != 0) continue;
    const std::size_t colon = line.find(": ");
    if (colon != std::string::npos) machine.processor = line.substr(colon + 2);
    break;
  }
  double load[1] = {0.0};
  if (getloadavg(load, 1) == 1) machine.load = load[0];
  return machine;
}

}  // namespace boresight
