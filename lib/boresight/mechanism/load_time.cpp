#include "boresight/mechanism/load_time.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace boresight {

double load_time(const Mechanism& mechanism) {
  constexpr double kFewest = 1024.0, kMost = 65536.0;
  const double duration = mechanism.duration();
  const int looks = static_cast<int>(std::clamp(std::ceil(duration / kLookedAt), kFewest, kMost));
  double shortest = std::numeric_limits<double>::infinity();
  const auto look = [&](const TimeFunctionPtr& load) {
    if (!load) return;
    double least = std::numeric_limits<double>::infinity(), largest = -least, rate = 0.0;
    for (int i = 0; i <= looks; ++i) {
      const TimeValue f = load->at(duration * i / looks);
      least = std::min(least, f.value);
      largest = std::max(largest, f.value);
      rate = std::max(rate, std::abs(f.rate));
    }
    if (rate > 0.0 && largest > least) shortest = std::min(shortest, (largest - least) / rate);
  };
  for (const LoadDescription& load : mechanism.description().loads) {
    look(load.along_joint);
    for (const TimeFunctionPtr& f : load.force) look(f);
  }
  return shortest;
}

}  // namespace boresight
