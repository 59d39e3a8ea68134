#include "boresight/io/tape.hpp"

#include <cmath>

namespace boresight {

void TapeProgram::run(double t, double q, double* slots) const {
  double* result = slots;
  for (const TapeEntry& entry : entries_) {
    const double a = slots[entry.first], b = slots[entry.second];
    switch (entry.operation) {
      case Operation::constant:
        *result = entry.constant;
        break;
      case Operation::time:
        *result = t;
        break;
      case Operation::coordinate:
        *result = q;
        break;
      case Operation::add:
        *result = a + b;
        break;
      case Operation::multiply:
        *result = a * b;
        break;
      case Operation::reciprocal:
        *result = 1.0 / a;
        break;
      case Operation::square:
        *result = a * a;
        break;
      case Operation::power:
        *result = std::pow(a, b);
        break;
      case Operation::sine:
        *result = std::sin(a);
        break;
      case Operation::cosine:
        *result = std::cos(a);
        break;
      case Operation::tangent:
        *result = std::tan(a);
        break;
      case Operation::arcsine:
        *result = std::asin(a);
        break;
      case Operation::arccosine:
        *result = std::acos(a);
        break;
      case Operation::arctangent:
        *result = std::atan(a);
        break;
      case Operation::arctangent2:
        *result = std::atan2(a, b);
        break;
      case Operation::hyperbolic_sine:
        *result = std::sinh(a);
        break;
      case Operation::hyperbolic_cosine:
        *result = std::cosh(a);
        break;
      case Operation::hyperbolic_tangent:
        *result = std::tanh(a);
        break;
      case Operation::exponential:
        *result = std::exp(a);
        break;
      case Operation::logarithm:
        *result = std::log(a);
        break;
      case Operation::square_root:
        *result = std::sqrt(a);
        break;
      case Operation::magnitude:
        *result = std::abs(a);
        break;
      case Operation::sign:
        *result = a > 0.0 ? 1.0 : a < 0.0 ? -1.0 : 0.0;
        break;
    }
    ++result;
  }
}

TimeValue Tape::at(double t) const {
  const auto [value, rate, acceleration] = program_.at(t, 0.0, results_);
  return {value, rate, acceleration};
}

TimeValue CoordinateTape::at(const TimeValue& q, double t) const {
  const auto [f, by_q, by_t, by_qq, by_qt, by_tt] = program_.at(t, q.value, results_);
  return {f, by_q * q.rate + by_t, by_q * q.acceleration + (by_qq * q.rate + 2.0 * by_qt) * q.rate + by_tt};
}

}  // namespace boresight
