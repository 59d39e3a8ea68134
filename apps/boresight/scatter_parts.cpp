#include "scatter_parts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "boresight_analyses/random/design.hpp"

namespace boresight::app {

Json number_json(double value) { return std::isfinite(value) ? Json(value) : Json(); }

Json interval_json(const ReportedInterval& i) {
  return {{"value", number_json(i.value)}, {"low", number_json(i.low)},           {"high", number_json(i.high)},
          {"confidence", i.confidence},    {"coverage", number_json(i.coverage)}, {"basis", i.basis}};
}

std::vector<std::string> names_of(const RandomInputs& inputs) {
  std::vector<std::string> names;
  for (const RandomParameter& p : inputs.parameters) names.push_back(p.name());
  return names;
}

std::string first_failure_text(const Failures& failures, const std::string& what) {
  return fmt::format("; the first of them, {} {}: {}", what, failures.first, failures.reason);
}

void add_first_failure(Json& summary, const Failures& failures, const std::string& what) {
  if (failures.count > 0) summary["first_failure"] = {{what, failures.first}, {"reason", failures.reason}};
}

bool scene_varies(const RandomInputs& inputs) {
  return std::any_of(inputs.parameters.begin(), inputs.parameters.end(), [](const RandomParameter& p) {
    return std::any_of(p.paths.begin(), p.paths.end(), [](const std::string& path) { return !path.starts_with("clearance."); });
  });
}

std::vector<Parameters> pilot_samples(const RandomInputs& inputs, const Mechanism& mechanism) {
  std::vector<Parameters> samples;
  for (const double level : {0.5, 0.05, 0.95}) {
    std::vector<double> values;
    for (const RandomParameter& p : inputs.parameters) values.push_back(p.distribution->quantile(level));
    samples.push_back(inputs.parameters_with(mechanism, values));
  }
  return samples;
}

std::vector<Parameters> draws_of_scatter(const RandomInputs& inputs, const Mechanism& mechanism, std::size_t count) {
  if (inputs.size() == 0) return {mechanism.parameters()};  // nothing scatters: one motion says all
  constexpr std::uint64_t kSeedOfPilot = 0x70696c6f74;
  const Design design({.kind = DesignKind::random, .seed = kSeedOfPilot}, static_cast<int>(inputs.size()));
  std::vector<Parameters> samples;
  std::vector<double> values(inputs.size());
  for (std::size_t k = 0; k < count; ++k) {
    design.point(k, values);
    inputs.values(values);
    samples.push_back(inputs.parameters_with(mechanism, values));
  }
  return samples;
}

}  // namespace boresight::app
