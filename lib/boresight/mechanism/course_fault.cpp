#include "boresight/mechanism/course_fault.hpp"

#include <cstdio>

namespace boresight {

std::string at_time(double t) {
  char at[60];
  std::snprintf(at, sizeof at, t == 0.0 || (t >= 1e-3 && t < 1e6) ? " at t = %f s" : " at t = %.6g s", t);
  return at;
}

std::optional<CourseFault> not_finite(const TimeFunction& function, double duration) {
  const double t = first_time_not_finite(function, duration);
  if (t < 0.0) return {};
  return CourseFault{", which is not finite or not smooth" + at_time(t),
                     "an expression that is finite with its first two derivatives during the motion"};
}

std::optional<CourseFault> not_continuous(const TimeFunction& function, double duration, const LeastSizes& least) {
  constexpr double kAtTheStart = 1e-12;  // of the duration: a corner there is found a little later
  constexpr int kSamples = 2000;
  const double t = first_jump(function, duration, kSamples, least);
  if (t < 0.0) return {};
  return CourseFault{", which jumps or has a corner" + at_time(t < kAtTheStart * duration ? 0.0 : t),
                     "a law whose value and rate are continuous: round a corner off, as abs(x) to sqrt(x^2 + e^2)"};
}

}  // namespace boresight
