#include "boresight_analyses/runs/scatter_draws.hpp"

#include <algorithm>

#include "boresight_analyses/random/contact_path.hpp"
#include "boresight_analyses/random/sampling_design.hpp"

namespace boresight {

bool scene_varies(const std::vector<std::string>& paths) {
  return std::any_of(paths.begin(), paths.end(),
                     [](const std::string& path) { return !is_contact_path(path) && !path.starts_with("error."); });
}

bool scene_varies(const RandomInputs& inputs) {
  return std::any_of(inputs.parameters.begin(), inputs.parameters.end(),
                     [](const RandomParameter& p) { return scene_varies(p.paths); });
}

std::vector<Parameters> pilot_samples(const RandomInputs& inputs, const Mechanism& mechanism) {
  std::vector<Parameters> samples;
  for (const double level : {0.5, 0.05, 0.95})
    samples.push_back(inputs.parameters_with(mechanism, inputs.values_at(level)));
  return samples;
}

std::vector<std::vector<double>> drawn_values(const RandomInputs& inputs, std::size_t count) {
  if (inputs.size() == 0) return {{}};  // nothing scatters: one motion says all
  constexpr std::uint64_t kSeedOfPilot = 0x70696c6f74;
  const SamplingDesign design({.kind = SamplingKind::random, .seed = kSeedOfPilot}, static_cast<int>(inputs.size()));
  std::vector<std::vector<double>> draws(count, std::vector<double>(inputs.size()));
  for (std::size_t k = 0; k < count; ++k) {
    design.point(k, draws[k]);
    inputs.values(draws[k]);
  }
  return draws;
}

std::vector<Parameters> draws_of_scatter(const RandomInputs& inputs, const Mechanism& mechanism, std::size_t count) {
  std::vector<Parameters> samples;
  for (const std::vector<double>& values : drawn_values(inputs, count))
    samples.push_back(inputs.parameters_with(mechanism, values));
  return samples;
}

}  // namespace boresight
