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

class Tape final : public TimeFunction {
 public:
  // `results`: the slots of value, rate and acceleration.
  Tape(std::vector<TapeEntry> entries, std::array<int, 3> results) : entries_(std::move(entries)), results_(results) {}

  TimeValue at(double t) const override;
  std::size_t size() const { return entries_.size(); }

 private:
  void run(double t, double* slots) const;

  std::vector<TapeEntry> entries_;
  std::array<int, 3> results_;
};

}  // namespace boresight
