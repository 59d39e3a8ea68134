#include "boresight_analyses/sensitivity/sensitivity_plan.hpp"

#include <algorithm>
#include <bit>

#include "boresight_analyses/sensitivity/sensitivity_keys.hpp"

namespace boresight {
namespace {

bool power_of_two(std::uint64_t n) { return std::has_single_bit(n); }

}  // namespace

const char* to_string(SensitivityMethod method) {
  switch (method) {
    case SensitivityMethod::sobol:
      return "sobol";
    case SensitivityMethod::morris:
      return "morris";
    case SensitivityMethod::shapley:
      return "shapley";
  }
  return "";
}

std::uint64_t SensitivityPlan::runs_per_row() const {
  switch (method) {
    case SensitivityMethod::sobol:
      return groups.size() + 2;
    case SensitivityMethod::morris:
      return trajectories->points();
    case SensitivityMethod::shapley:
      return shapley->points();
  }
  return 0;
}

std::vector<double> SensitivityPlan::sobol_coordinates(std::uint64_t row, std::uint64_t slot) const {
  const std::size_t d = inputs.size();
  Point ab(2 * d);
  points->point(row, ab);
  const auto from = ab.begin() + static_cast<std::ptrdiff_t>(slot == 1 ? d : 0);
  std::vector<double> coordinates(from, from + static_cast<std::ptrdiff_t>(d));
  if (slot >= 2)
    for (const int i : groups[slot - 2]) coordinates[static_cast<std::size_t>(i)] = ab[d + static_cast<std::size_t>(i)];
  return coordinates;
}

void SensitivityPlan::values(std::uint64_t number, std::span<double> values) const {
  const std::uint64_t row = number / runs_per_row(), slot = number % runs_per_row();
  const std::size_t d = inputs.size();
  if (method == SensitivityMethod::shapley) {
    Point ab(2 * d);
    points->point(row, ab);
    const std::span<const double> both(ab);
    inputs.renewed_values(both.first(d), both.last(d), shapley->renewed(row, slot, d), values);
    return;
  }
  if (method == SensitivityMethod::morris) {
    points->point(row, values);
    trajectories->place(row, slot, values);
  } else {
    const std::vector<double> coordinates = sobol_coordinates(row, slot);
    std::copy(coordinates.begin(), coordinates.end(), values.begin());
  }
  inputs.values(values);
}

std::string SensitivityPlan::text(const Study& study) const {
  std::string text = inputs.text + design.text() + "\nindex " + study.index.text() + "\n";
  for (const auto& group : groups) {
    text += "group";
    for (const int i : group) text += " " + std::to_string(i);
    text += "\n";
  }
  if (method == SensitivityMethod::morris) text += "morris, levels " + std::to_string(trajectories->levels()) + "\n";
  if (method == SensitivityMethod::shapley)
    text += std::string("shapley, ") + (shapley->orders() == ShapleyOrders::all ? "all" : "random") + " orders\n";
  return text;
}

namespace {

// A key that one method alone takes.
void only_with(Cursor& table, const char* key, const char* method, SensitivityMethod chosen) {
  if (table.has(key) && to_string(chosen) != std::string(method))
    table.fail(key, std::string(key) + " with method = \"" + method + "\" only");
}

ShapleyOrders read_orders(Cursor& table, std::size_t groups) {
  // Beyond four groups a row of all orders is dearer than what it gains: with normal inputs of which some are correlated, and with
  // equal numbers of runs, the effects scatter by 0.2, 0.4 and 1.6 times that of random orders for 3, 4 and 5 groups.
  constexpr std::size_t kFew = 4;
  if (!table.has("orders")) return groups <= kFew ? ShapleyOrders::all : ShapleyOrders::random;
  if (table.choice("orders") == "random") return ShapleyOrders::random;
  if (groups > ShapleyRows::kMostForAllOrders)
    table.fail("orders",
               "\"random\" for more than " + std::to_string(ShapleyRows::kMostForAllOrders) + " parameters or groups");
  return ShapleyOrders::all;
}

void read_method(Cursor& table, SensitivityPlan& plan) {
  only_with(table, "levels", "morris", plan.method);
  only_with(table, "negligible", "morris", plan.method);
  only_with(table, "orders", "shapley", plan.method);
  const long long levels = table.integer("levels");
  plan.negligible = table.number("negligible");
  if (plan.method == SensitivityMethod::morris) {
    plan.trajectories =
        std::make_shared<const MorrisTrajectories>(plan.groups, static_cast<int>(levels), plan.design.seed);
  }
  if (plan.method != SensitivityMethod::shapley) return;
  for (std::size_t i = 0; i < plan.inputs.size(); ++i)
    if (plan.inputs.parameters[i].distribution->is_discrete() && plan.inputs.copula.correlated(i))
      table.fail_found("method",
                       "\"shapley\", where " + plan.inputs.parameters[i].name() + " is discrete and correlated",
                       "continuous distributions for correlated parameters: values given a discrete one are not drawn");
  plan.shapley =
      std::make_shared<const ShapleyRows>(plan.groups, read_orders(table, plan.groups.size()), plan.design.seed);
}

}  // namespace

SensitivityPlan read_sensitivity_plan(Cursor& root, const Study&, const MechanismDescription& mechanism,
                                      const std::function<void(const Setting&)>& accepts) {
  Cursor table = root.table("sensitivity");
  table.only(sensitivity_keys());
  SensitivityPlan plan;
  const std::string method = table.choice("method");
  plan.method = method == "morris"    ? SensitivityMethod::morris
                : method == "shapley" ? SensitivityMethod::shapley
                                      : SensitivityMethod::sobol;
  const bool shapley = plan.method == SensitivityMethod::shapley;
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
  NamedGroups groups =
      read_parameter_groups(table, plan.inputs, {.correlated_apart = shapley, .instead = ", or method = \"shapley\""});
  plan.groups = std::move(groups.members);
  plan.names = std::move(groups.names);
  read_method(table, plan);
  table.finish();
  const std::size_t points = plan.method == SensitivityMethod::morris ? 1 : 2;  // a row
  plan.points = std::make_shared<const SamplingDesign>(plan.design, static_cast<int>(points * plan.inputs.size()));
  return plan;
}

}  // namespace boresight
