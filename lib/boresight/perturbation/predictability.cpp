#include "boresight/perturbation/predictability.hpp"

#include <algorithm>
#include <cmath>

#include "boresight/mechanism/error.hpp"
#include "boresight/mechanism/interruption.hpp"
#include "boresight/perturbation/perturbation.hpp"

namespace boresight {
namespace {

constexpr int kLooks = 2000;  // at the twins' offsets, along the motion

double relative_difference(double a, double b) { return b > 0.0 ? std::abs(a / b - 1.0) : 0.0; }

}  // namespace

Predictability measure_predictability(std::shared_ptr<const Mechanism> mechanism, const Parameters& parameters) {
  Predictability found;
  if (mechanism->clearances() == 0) {
    found.refusal = "no joint has clearance";
    return found;
  }
  RunOptions options;
  options.sample_spacing = mechanism->duration() / kLooks;
  options.events = false;
  options.integrator = "rk4";
  options.model_look = ModelLook::none;
  options.progress = [](const RunProgress& p) {
    work_reached("comparing with a motion that starts a little off", p.t / p.duration);
    return true;
  };
  RunResult run, twin;
  try {
    const auto rung = make_perturbation(mechanism);
    run = rung->run(parameters, options);
    options.step = run.end_time / static_cast<double>(run.cost.steps);
    options.start_offset = kStartOffset;
    twin = rung->run(parameters, options);
  } catch (const ComputationError& failure) {
    found.refusal = failure.what();
    return found;
  }
  found.measured = true;
  found.horizon = run.end_time;
  double apart = 0.0;  // largest, of all journals, up to the horizon
  for (std::size_t k = 0; k < std::min(run.time.size(), twin.time.size()) && !found.parted; ++k)
    for (std::size_t c = 0; c < run.clearances.size(); ++c) {
      const double difference = (run.clearances[c][k].offset - twin.clearances[c][k].offset).norm();
      apart = std::max(apart, difference);
      const ClearanceParameters& gap = parameters.clearance[c];
      if (found.parted || !(difference > kPartedShare * gap.*carrying_gap(gap))) continue;
      found.parted = true;
      found.horizon = run.time[k];
    }
  if (found.horizon > 0.0 && apart > kStartOffset) found.growth = std::log(apart / kStartOffset) / found.horizon;
  found.max_difference = relative_difference(twin.index.position_error.max, run.index.position_error.max);
  found.rms_difference = relative_difference(twin.index.position_error.rms, run.index.position_error.rms);
  return found;
}

}  // namespace boresight
