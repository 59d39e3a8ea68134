#include "boresight/io/tape.hpp"

#include <cmath>

namespace boresight {

void Tape::run(double t, double* slots) const {
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
  constexpr std::size_t kOnStack = 256;
  if (entries_.size() <= kOnStack) {
    double slots[kOnStack];
    slots[0] = 0.0;  // read, though not used, by the first operation
    run(t, slots);
    return {slots[results_[0]], slots[results_[1]], slots[results_[2]]};
  }
  thread_local std::vector<double> buffer;
  if (buffer.size() < entries_.size()) buffer.resize(entries_.size());
  run(t, buffer.data());
  return {buffer[results_[0]], buffer[results_[1]], buffer[results_[2]]};
}

}  // namespace boresight
