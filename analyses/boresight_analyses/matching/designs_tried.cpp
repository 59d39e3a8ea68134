#include "boresight_analyses/matching/designs_tried.hpp"

#include "boresight_analyses/runs/scatter_draws.hpp"

namespace boresight {
namespace {

std::vector<std::vector<double>> designs_of_box(const MatchingPlan& plan) {
  std::vector<std::vector<double>> designs;
  for (const double share : {0.5, 0.0, 1.0}) {
    std::vector<double>& design = designs.emplace_back();
    for (const DesignVariable& v : plan.variables)
      design.push_back(v.from_search(v.to_search(v.from) + share * (v.to_search(v.to) - v.to_search(v.from))));
  }
  return designs;
}

Parameters with(const MatchingPlan& plan, const Mechanism& mechanism, std::vector<double> design,
                const std::vector<double>& scattered) {
  design.insert(design.end(), scattered.begin(), scattered.end());
  return plan.parameters_with(mechanism, design);
}

}  // namespace

std::vector<Parameters> median_motions(const MatchingPlan& plan, const Mechanism& mechanism) {
  const std::vector<double> medians = plan.inputs ? plan.inputs->values_at(0.5) : std::vector<double>{};
  std::vector<Parameters> motions;
  for (const std::vector<double>& design : designs_of_box(plan))
    motions.push_back(with(plan, mechanism, design, medians));
  return motions;
}

DesignsTried designs_tried(const MatchingPlan& plan, const Mechanism& mechanism, double designs) {
  DesignsTried tried;
  const bool scatters = plan.inputs && plan.inputs->size() > 0;
  const std::vector<std::vector<double>> draws =
      scatters ? drawn_values(*plan.inputs, kDrawsForPilot) : std::vector<std::vector<double>>{{}};
  for (const std::vector<double>& design : designs_of_box(plan)) {
    std::vector<Parameters>& samples = tried.samples.emplace_back();
    for (const std::vector<double>& draw : draws) samples.push_back(with(plan, mechanism, design, draw));
  }
  if (!scatters) return tried;
  tried.statistic = plan.objective.statistic_of(plan.samples);
  tried.scene_varies = scene_varies(*plan.inputs);
  tried.lanes = !asks_peak_acceleration(plan);
  tried.runs = static_cast<std::uint64_t>(designs * static_cast<double>(plan.samples));
  return tried;
}

}  // namespace boresight
