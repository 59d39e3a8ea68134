#include "boresight/stepping/steps_of_errors.hpp"

#include <cstdio>
#include <limits>

#include "boresight/mechanism/load_time.hpp"

namespace boresight {
namespace {

struct FastestError {
  std::size_t error = 0;
  double time = std::numeric_limits<double>::infinity();
};

FastestError fastest_error(const std::vector<double>& times, const Parameters& parameters) {
  FastestError fastest;
  for (std::size_t e = 0; e < times.size(); ++e)
    if (parameters.error[e] != 0.0 && times[e] < fastest.time) fastest = {e, times[e]};
  return fastest;
}

}  // namespace

double time_of_errors(const Mechanism& mechanism, const std::vector<double>& times, const Parameters& parameters) {
  return least_error_time(mechanism, fastest_error(times, parameters).time);
}

std::string errors_not_followed(const Mechanism& mechanism, const std::vector<double>& times,
                                const Parameters& parameters, double step) {
  const FastestError fastest = fastest_error(times, parameters);
  if (!(fastest.time < step)) return "";
  char text[200];
  std::snprintf(
      text, sizeof text,
      ": its law changes by all that it does within %.2g s, faster than steps of %.2g s follow: they may miss it "
      "altogether; a shorter --step follows it",
      fastest.time, step);
  return "error." + mechanism.description().errors[fastest.error].name + text;
}

}  // namespace boresight
