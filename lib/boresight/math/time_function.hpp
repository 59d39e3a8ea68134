// A scalar function of time known together with its first two derivatives: the law of a drive, a pose angle, a load.
#pragma once

#include <memory>

namespace boresight {

// Value and exact derivatives at one time. Units: u, u/s, u/s^2 where u is the unit of the function.
struct TimeValue {
  double value = 0.0;
  double rate = 0.0;
  double acceleration = 0.0;
};

class TimeFunction {
 public:
  virtual ~TimeFunction() = default;
  // t in s. Reentrant: called from many threads at once.
  virtual TimeValue at(double t) const = 0;
};

using TimeFunctionPtr = std::shared_ptr<const TimeFunction>;

// A scalar function of a coordinate and of time, such as the error of a drive: a screw's ripple hangs on where the drive stands.
class CoordinateFunction {
 public:
  virtual ~CoordinateFunction() = default;
  // At time t [s], along a motion whose coordinate, with its derivatives, is q there. Reentrant.
  virtual TimeValue at(const TimeValue& q, double t) const = 0;
};

using CoordinateFunctionPtr = std::shared_ptr<const CoordinateFunction>;

// A function that does not change: value everywhere, derivatives zero.
class ConstantFunction final : public TimeFunction {
 public:
  explicit ConstantFunction(double value) : value_(value) {}
  TimeValue at(double) const override { return {value_, 0.0, 0.0}; }

 private:
  double value_;
};

}  // namespace boresight
