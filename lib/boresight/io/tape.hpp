// A straight-line program of double operations: what an expression and its two derivatives are once compiled.
//
// Slot k holds the result of operation k; operands are slots of earlier operations. No branches, no allocation per call (up to
// 256 slots on the stack, beyond that a buffer per thread), so `at` may run in many threads at once.
#pragma once

#include <array>
#include <vector>

#include "boresight/math/time_function.hpp"

namespace boresight {

enum class Operation {
  constant,
  time,
  coordinate,
  add,
  multiply,
  reciprocal,
  square,
  power,
  sine,
  cosine,
  tangent,
  arcsine,
  arccosine,
  arctangent,
  arctangent2,
  hyperbolic_sine,
  hyperbolic_cosine,
  hyperbolic_tangent,
  exponential,
  logarithm,
  square_root,
  magnitude,
  sign
};

struct TapeEntry {
  Operation operation = Operation::constant;
  int first = 0, second = 0;  // slots
  double constant = 0.0;
};

class TapeProgram {
 public:
  explicit TapeProgram(std::vector<TapeEntry> entries) : entries_(std::move(entries)) {}

  // The values of some slots at a time, of a coordinate too where there is one.
  template <std::size_t N>
  std::array<double, N> at(double t, double q, const std::array<int, N>& wanted) const {
    constexpr std::size_t kOnStack = 256;
    if (entries_.size() <= kOnStack) {
      double slots[kOnStack];
      slots[0] = 0.0;  // read, though not used, by the first operation
      run(t, q, slots);
      return picked(slots, wanted);
    }
    thread_local std::vector<double> buffer;
    if (buffer.size() < entries_.size()) buffer.resize(entries_.size());
    run(t, q, buffer.data());
    return picked(buffer.data(), wanted);
  }
  std::size_t size() const { return entries_.size(); }

 private:
  void run(double t, double q, double* slots) const;
  template <std::size_t N>
  static std::array<double, N> picked(const double* slots, const std::array<int, N>& wanted) {
    std::array<double, N> values;
    for (std::size_t k = 0; k < N; ++k) values[k] = slots[wanted[k]];
    return values;
  }

  std::vector<TapeEntry> entries_;
};

class Tape final : public TimeFunction {
 public:
  // `results`: the slots of value, rate and acceleration.
  Tape(std::vector<TapeEntry> entries, std::array<int, 3> results) : program_(std::move(entries)), results_(results) {}

  TimeValue at(double t) const override;
  std::size_t size() const { return program_.size(); }

 private:
  TapeProgram program_;
  std::array<int, 3> results_;
};

// f(q, t) along a motion q(t), by the chain rule.
class CoordinateTape final : public CoordinateFunction {
 public:
  // `results`: the slots of f and its derivatives by q, t, q q, q t, t t.
  CoordinateTape(std::vector<TapeEntry> entries, std::array<int, 6> results)
      : program_(std::move(entries)), results_(results) {}

  TimeValue at(const TimeValue& q, double t) const override;

 private:
  TapeProgram program_;
  std::array<int, 6> results_;
};

}  // namespace boresight
