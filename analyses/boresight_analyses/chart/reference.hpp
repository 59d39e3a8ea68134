// The reference that errors are measured against, refined until its own uncertainty is known.
//
// Multibody in joint coordinates, RK4, at half its own step, a quarter, an eighth, ...: each the median over
// neighbouring steps. A refinement is wrong by about what the one before it differs from it, and by what
// chance leaves in a median of three (half of the half spread). Refined until that falls below a target, or
// until the time given is spent; where impacts scatter the index, no refinement brings it lower, and that is
// the floor that the chart draws.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "boresight_analyses/study/measurement.hpp"

namespace boresight {

struct Refinement {
  double step = 0.0;  // [s]
  double value = 0.0, half_spread = 0.0;
};

struct Reference {
  double value = 0.0;
  double uncertainty = 0.0;  // relative
  double own_step = 0.0;     // of multibody, RK4 [s]
  std::vector<Refinement> refinements;
  double cpu_seconds = 0.0;
};

struct ReferenceOptions {
  double target = 1e-5;        // relative uncertainty that is good enough
  double most_seconds = 20.0;  // of CPU, beyond which no finer step is begun
  MeasureOptions measure = {};
  // In place of measure(), for one who keeps what was measured; none: measure().
  std::function<Measurement(const RungSetup&)> measured = {};
};

// Throws ComputationError where multibody cannot follow the motion, MeasurementInterrupted.
Reference find_reference(const Rung& multibody, const Parameters& parameters, const ReferenceOptions& options);

}  // namespace boresight
