// A function of a coordinate and of time that hangs on neither: an error that a drive has everywhere.
#pragma once

#include "boresight/math/time_function.hpp"

namespace boresight {

class ConstantLaw final : public CoordinateFunction {
 public:
  explicit ConstantLaw(double value) : value_(value) {}
  TimeValue at(const TimeValue&, double) const override { return {value_, 0.0, 0.0}; }

 private:
  double value_;
};

}  // namespace boresight
