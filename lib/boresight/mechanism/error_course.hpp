// What a drive errs by along a motion: its law of the drive's coordinate and of time, as a function of time.
#pragma once

#include <utility>

#include "boresight/math/time_function.hpp"
#include "boresight/mechanism/ideal_motion.hpp"

namespace boresight {

class ErrorAlongDrive final : public TimeFunction {
 public:
  ErrorAlongDrive(CoordinateFunctionPtr law, TimeFunctionPtr drive) : law_(std::move(law)), drive_(std::move(drive)) {}
  TimeValue at(double t) const override { return law_->at(drive_->at(t), t); }

 private:
  CoordinateFunctionPtr law_;
  TimeFunctionPtr drive_;
};

// Throws InputError, with the line of the law, where one has no value, jumps or has a corner along the course that its drive takes in
// `motion`: a motion by poses tells its drives' courses only when it is known.
void require_laws_along(const Mechanism& mechanism, const IdealMotion& motion);

}  // namespace boresight
