#include "boresight/math/course_search.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace boresight {

double first_time_not_finite(const TimeFunction& function, double duration, int samples) {
  for (int k = 0; k <= samples; ++k) {
    const double t = duration * k / samples;
    const TimeValue v = function.at(t);
    if (!std::isfinite(v.value) || !std::isfinite(v.rate) || !std::isfinite(v.acceleration)) return t;
  }
  return -1.0;
}

namespace {

// Of a course and its derivative at both ends of an interval: what the trapezoidal rule leaves of the course's change. All, where
// there is no number.
struct Unexplained {
  double TimeValue::*course, TimeValue::*derivative;
  double operator()(double h, const TimeValue& a, const TimeValue& b) const {
    const double left = std::abs(b.*course - a.*course - 0.5 * h * (a.*derivative + b.*derivative));
    return std::isfinite(left) ? left : std::numeric_limits<double>::infinity();
  }
};

// Halves an interval towards what is left unexplained until next to nothing is, or no time lies between: then it jumps. largest: of
// the course where it was looked at.
double jump_between(const TimeFunction& function, const Unexplained& unexplained, double from, double to,
                    double& largest) {
  constexpr double kSize = 1e-6;  // of the largest: rounding is far below it, and what moves by it nobody sees
  TimeValue a = function.at(from), b = function.at(to);
  while (unexplained(to - from, a, b) > kSize * largest) {
    const double middle = 0.5 * (from + to);
    if (!(middle > from && middle < to)) return to;
    const TimeValue m = function.at(middle);
    if (std::isfinite(m.*unexplained.course)) largest = std::max(largest, std::abs(m.*unexplained.course));
    if (unexplained(middle - from, a, m) > unexplained(to - middle, m, b)) {
      to = middle;
      b = m;
    } else {
      from = middle;
      a = m;
    }
  }
  return -1.0;
}

}  // namespace

double first_jump(const TimeFunction& function, double duration, int samples, const LeastSizes& least) {
  for (const Unexplained& unexplained :
       {Unexplained{&TimeValue::value, &TimeValue::rate}, {&TimeValue::rate, &TimeValue::acceleration}}) {
    double largest = unexplained.course == &TimeValue::value ? least.value : least.rate;
    for (int k = 0; k <= samples; ++k)
      largest = std::max(largest, std::abs(function.at(duration * k / samples).*unexplained.course));
    for (int k = 1; k <= samples; ++k) {
      const double t =
          jump_between(function, unexplained, duration * (k - 1) / samples, duration * k / samples, largest);
      if (t >= 0.0) return t;
    }
  }
  return -1.0;
}

}  // namespace boresight
