#include "boresight_analyses/sensitivity/sensitivity_plan.hpp"

#include <algorithm>
#include <bit>

#include "boresight_analyses/sensitivity/sensitivity_keys.hpp"

namespace boresight {
namespace {

bool power_of_two(std::uint64_t n) { return std::has_single_bit(n); }

}  // namespace

void SensitivityPlan::values(std::uint64_t number, std::span<double> values) const {
  const std::uint64_t row = number / runs_per_row(), slot = number % runs_per_row();
  const std::size_t d = inputs.size();
  Point ab(2 * d);
  points->point(row, ab);
  std::copy_n(ab.begin() + static_cast<std::ptrdiff_t>(slot == 1 ? d : 0), d, values.begin());
  if (slot >= 2)
    for (const int i : groups[slot - 2]) values[static_cast<std::size_t>(i)] = ab[d + static_cast<std::size_t>(i)];
  inputs.values(values);
}

std::string SensitivityPlan::text(const Study& study) const {
  std::string text = inputs.text + design.text() + "\nindex " + study.index.text() + "\n";
  for (const auto& group : groups) {
    text += "group";
    for (const int i : group) text += " " + std::to_string(i);
    text += "\n";
  }
  return text;
}

SensitivityPlan read_sensitivity_plan(Cursor& root, const Study&, const MechanismDescription& mechanism,
                                      const std::function<void(const Setting&)>& accepts) {
  Cursor table = root.table("sensitivity");
  table.only(sensitivity_keys());
  SensitivityPlan plan;
  const long long rows = table.integer("samples");
  plan.rows = static_cast<std::uint64_t>(rows);
  plan.design.seed = static_cast<std::uint64_t>(table.integer("seed"));
  const bool net = table.choice("design") == "sobol";
  plan.design.kind = net ? SamplingKind::sobol : SamplingKind::random;
  if (table.has("replicates") && !net) table.fail("replicates", "replicates with design = \"sobol\" only");
  const long long replicates = table.integer("replicates");
  plan.design.replicates = static_cast<std::uint64_t>(replicates);
  if (net && (plan.rows % plan.design.replicates != 0 || !power_of_two(plan.rows / plan.design.replicates))) {
    const std::uint64_t size = std::bit_ceil((plan.rows + plan.design.replicates - 1) / plan.design.replicates);
    table.fail("samples", "replicates (" + std::to_string(replicates) + ") times a power of two, for example " +
                              std::to_string(size * plan.design.replicates));
  }
  plan.confidence = table.number("confidence");
  plan.inputs = read_random_inputs(root, mechanism, accepts);
  if (net && 2 * plan.inputs.size() > static_cast<std::size_t>(SobolNet::kMostDimensions))
    table.fail("design",
               "\"random\" for more than " + std::to_string(SobolNet::kMostDimensions / 2) + " random parameters");
  NamedGroups groups = read_parameter_groups(table, plan.inputs);
  plan.groups = std::move(groups.members);
  plan.names = std::move(groups.names);
  table.finish();
  plan.points = std::make_shared<const SamplingDesign>(plan.design, static_cast<int>(2 * plan.inputs.size()));
  return plan;
}

}  // namespace boresight
