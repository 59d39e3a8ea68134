#include "boresight_analyses/study/measurement.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <stdexcept>
#include <vector>

#include "boresight/lanes/perturbation_lanes.hpp"
#include "boresight/mechanism/error.hpp"
#include "boresight/rungs/cpu_clock.hpp"
#include "boresight/rungs/integrator_choice.hpp"

namespace boresight {
namespace {

// Neighbouring steps whose results are as good as the first: impacts fall out differently in each.
constexpr double kBetweenNeighbours = 0.015;

}  // namespace

RunOptions RungSetup::options() const {
  RunOptions options;
  options.sample_spacing = 0.0;
  options.events = false;
  if (stepless()) return options;
  options.step = step;
  options.tolerance = tolerance;
  options.integrator = integrator;
  options.formulation = formulation;
  options.stabilisation = stabilisation;
  return options;
}

RungSetup RungSetup::finer() const {
  RungSetup setup = *this;
  if (lanes)
    setup.tolerance = 0.1 * (tolerance > 0.0 ? tolerance : kLaneTolerance);
  else if (!integrator.empty() && integrator != "rk4" && step == 0.0)
    setup.tolerance = 0.1 * tolerance_of(options(), rung);
  else
    setup.step = 0.5 * step;
  return setup;
}

std::string RungSetup::family() const {
  std::string text = rung;
  for (const std::string& part : {formulation, stabilisation, integrator})
    if (!part.empty() && !stepless()) text += ", " + part;
  return text;
}

double distance_of_target(const Mechanism& mechanism) {
  if (!mechanism.pointing().line_of_sight) return 0.0;
  const BodyDescription& home = mechanism.description().bodies[mechanism.boresight_body()];
  return mechanism.pointing().line_of_sight->line({home.center_of_mass, Quat(home.axes)}).norm();
}

double nothing_of(const IndexChoice& index, const Mechanism& mechanism) {
  if (index.kind() != PointingQuantity::line_of_sight_error) return kNothing;
  return kNothing / std::max(1.0, distance_of_target(mechanism));
}

double relative_error(const Measurement& measured, double reference, double nothing) {
  if (std::abs(reference) <= nothing && std::abs(measured.value) <= nothing) return 0.0;
  return (std::abs(measured.value - reference) + measured.half_spread) / std::max(std::abs(reference), 1e-300);
}

Measurement measure(const Rung& rung, const Parameters& parameters, const RungSetup& setup,
                    const MeasureOptions& options) {
  Measurement out;
  std::vector<double> values;
  try {
    for (int neighbour = 0; neighbour < options.neighbours; ++neighbour) {
      const double share = 1.0 - kBetweenNeighbours * neighbour;
      if (options.advance && !options.advance()) throw MeasurementInterrupted{};
      RunOptions run = setup.options();
      run.model_look = neighbour == 0 ? ModelLook::motions : ModelLook::none;
      run.start = options.index.start;
      // Where another integrator took over, the neighbours are neighbours of that: its mean step is none of rk4's.
      if (!out.integrator.empty()) run.integrator = out.integrator;
      const bool fixed = run.integrator.empty() || run.integrator == "rk4";
      // Once the rung has chosen its own step, the neighbours are neighbours of that.
      if (fixed && run.step == 0.0) run.step = out.step;
      if (!fixed && !setup.stepless() && run.step == 0.0 && run.tolerance == 0.0)
        run.tolerance = tolerance_of(run, setup.rung);
      run.step *= share;
      run.tolerance *= share;
      const double start = thread_cpu_seconds();
      bool too_long = false;
      if (options.most_seconds > 0.0)
        run.progress = [&](const RunProgress&) {
          return !(too_long = thread_cpu_seconds() - start > options.most_seconds);
        };
      const RunResult result = rung.run(parameters, run);
      out.spent_seconds += thread_cpu_seconds() - start;
      if (too_long) {
        char text[120];
        std::snprintf(text, sizeof text, "given up after %.3g s of CPU at t = %.3g s of the motion",
                      options.most_seconds, result.end_time);
        out.refusal = text;
        return out;
      }
      const double value = options.index.of(result.index);
      if (!std::isfinite(value)) {
        out.refusal = "the index is not finite";
        return out;
      }
      values.push_back(value);
      if (out.integrator.empty()) out.integrator = result.integrator_taken;
      out.estimate = std::max(out.estimate, result.error.model_of(options.index.kind()));
      const double cpu = result.cost.cpu_seconds;
      out.cpu_seconds = values.size() == 1 ? cpu : std::min(out.cpu_seconds, cpu);
      if (out.step == 0.0 && result.cost.steps > 0 && !setup.stepless())
        out.step = result.end_time / static_cast<double>(result.cost.steps);
      if (setup.stepless() && values.size() == 2) break;  // the first one may have built the scene
    }
  } catch (const ComputationError& failure) {
    out.refusal = failure.what();
    return out;
  } catch (const std::invalid_argument& failure) {
    out.refusal = failure.what();
    return out;
  }
  out.values = values;
  std::sort(values.begin(), values.end());
  out.value = values[values.size() / 2];
  out.half_spread = 0.5 * (values.back() - values.front());
  return out;
}

}  // namespace boresight
