// boresight stability: where the methods fail, on one mechanism. Maps over step and contact frequency and
// over Baumgarte's gains, theory beside measurement; every case in which a method or a model gives up; how
// long the motion can be foretold.
//
//   StabilityResult result = find_stability(mechanism, {});
#pragma once

#include "boresight_analyses/stability/failure_case.hpp"
#include "boresight_analyses/stability/step_map.hpp"

namespace boresight {

struct StabilityOptions {
  IndexChoice index{"position_error",
                    "rms"};  // whose error the map of steps shows: statistics hold where trajectories part
  int cells = 28;            // of the map of Baumgarte's gains, along each axis
  std::function<void(const Setting&)> reread = {};  // see Scene
  // Called with the share done and what comes next; return false to stop: the result is then marked
  // interrupted.
  std::function<bool(double, const std::string&)> progress = {};
};

// One explicit method on one axis.
struct AxisLimit {
  std::string method, axis;             // "RK4"; "vibration" (imaginary), "damping" (real)
  double theory = 0.0, measured = 0.0;  // step times frequency, or times damping over mass [-]
};

// Growth per step of an undamped contact over frequency and step: rows along the step.
struct GrowthMap {
  std::string method;
  double limit = 0.0;                   // step times frequency, theory [-]
  std::vector<double> frequency, step;  // [rad/s], [s]
  std::vector<std::vector<double>> growth;
};

// Steps of an error-controlled method in lasting contact, against the contact's frequency.
struct SettledStep {
  double frequency = 0.0;  // [rad/s]
  Settling pair, l_stable;
};

struct StabilityResult {
  std::vector<ContactFrequency> contacts;
  std::vector<AxisLimit> limits;
  std::vector<GrowthMap> growth;
  std::vector<SettledStep> settled;
  StepMap steps;
  BaumgarteMap baumgarte;
  std::vector<Separation> separations;
  std::vector<FailureCase> cases;
  std::vector<std::string> warnings;
  bool interrupted = false;

  double largest_difference() const;  // of all measured limits from theory, relative
};

// Never throws for what a mechanism does: what cannot be computed is named in the warnings and the cases.
StabilityResult find_stability(const std::shared_ptr<const Mechanism>& mechanism, const StabilityOptions& options);

}  // namespace boresight
