#include "boresight_analyses/runs/counted_cost.hpp"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <stdexcept>

#include "boresight/keys/numbers_together.hpp"
#include "boresight_analyses/runs/model_samples.hpp"
#include "boresight_analyses/runs/scatter_draws.hpp"
#include "boresight_analyses/runs/scene_cost.hpp"
#include "boresight_analyses/study/geometric_sample_model.hpp"

namespace boresight {

double nominal_seconds_an_evaluation(const std::string& rung, bool on_lanes, std::size_t bodies,
                                     std::size_t clearances) {
  const auto b = static_cast<double>(bodies), c = std::max(1.0, static_cast<double>(clearances));
  if (rung == "envelope") return 5e-6 * c;
  if (rung == "quasistatic") return 1e-6 * c;
  if (rung == "perturbation") return on_lanes ? 0.15e-6 * c : 0.12e-6 * b + 0.32e-6 * c;
  if (rung == "multibody") return 0.3e-6 * b + 0.9e-6 * c;
  throw std::invalid_argument("no speed is known of the rung " + rung);
}

double counted_cost(const SampleModel& model, const Mechanism& mechanism, const RandomInputs& inputs,
                    const SamplingDesign& design) {
  constexpr std::size_t kCounted = 8;
  std::vector<std::vector<double>> values(kCounted, std::vector<double>(inputs.size()));
  std::vector<Sample> samples;
  for (std::size_t k = 0; k < kCounted; ++k) {
    design.point(k, values[k]);
    inputs.values(values[k]);
    samples.push_back({k, values[k]});
  }
  std::vector<Outcome> outcomes(kCounted);
  const std::atomic<bool> stop{false};
  model.evaluate(samples, outcomes, stop);
  std::vector<double> evaluations;
  for (const Outcome& outcome : outcomes)
    if (outcome.evaluations > 0.0) evaluations.push_back(outcome.evaluations);
  const double count = evaluations.empty() ? 1.0 : median(std::move(evaluations));
  constexpr double kLeast = 1e-7;
  // Where errors alone deviate: what a core of 2023 takes for eight samples side by side, and to draw and to store one.
  constexpr double kGeometricOperation = 6e-11, kGeometricSample = 3e-6;
  if (GeometricSampleModel::serve(model.rung(), mechanism)) return kGeometricSample + count * kGeometricOperation;
  const double motion =
      std::max(kLeast, count * nominal_seconds_an_evaluation(model.rung(), model.batch() > 1,
                                                             mechanism.description().bodies.size(),
                                                             mechanism.description().clearances.size()));
  if (!scene_varies(inputs)) return motion;
  std::vector<Parameters> drawn;
  for (const std::vector<double>& sample : values)
    if (Parameters own = inputs.parameters_with(mechanism, sample); !impossible_numbers(mechanism.description(), own))
      drawn.push_back(std::move(own));
  return motion + counted_scene_cost(model.rung(), model.batch() > 1, mechanism, drawn);
}

double kept_counted_cost(const SampleModel& model, const Mechanism& mechanism, const RandomInputs& inputs,
                         const SamplingDesign& design, SampleStore& store) {
  std::string kept = store.fact("counted_cost");
  if (kept.empty()) {
    char text[40];
    std::snprintf(text, sizeof text, "%.17g", counted_cost(model, mechanism, inputs, design));
    store.note("counted_cost", kept = text);
  }
  return std::strtod(kept.c_str(), nullptr);
}

}  // namespace boresight
