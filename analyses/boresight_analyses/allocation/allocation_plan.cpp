#include "boresight_analyses/allocation/allocation_plan.hpp"

#include <algorithm>
#include <cstdio>
#include <set>

#include "boresight/keys/units.hpp"
#include "boresight/keys/value_fault.hpp"
#include "boresight/mechanism/error.hpp"
#include "boresight_analyses/allocation/allocation_keys.hpp"
#include "boresight_analyses/allocation/confirmation.hpp"
#include "boresight_analyses/random/fit_size.hpp"
#include "boresight_analyses/statistics/binomial.hpp"

namespace boresight {
namespace {

// `journals`: those that the fits are for, where they are known yet.
std::vector<AllocationOption> read_fits(Cursor& table, ZoneLaw law, const std::vector<JournalSize>& journals = {}) {
  std::vector<AllocationOption> options;
  for (Cursor& entry : table.tables("fits")) {
    entry.only(allocate_fit_keys());
    AllocationOption option{.name = entry.text("fit"), .price = entry.number("price"), .gap = {}};
    try {
      const Fit fit = parse_fit(option.name);
      entry.require(fit.least_clearance() >= 0.0, "fit", "a fit with clearance");
      for (const JournalSize& journal : journals)
        if (!is_of_size(fit, journal)) entry.fail_found("fit", found_size(fit, journal), expected_size(journal));
      option.gap = make_fit_clearance(fit, law);
    } catch (const ValueFault& fault) {
      entry.fail_found("fit", fault.found, fault.expected, fault.nearest);
    }
    options.push_back(option);
    entry.finish();
  }
  if (options.empty()) table.fail("fits", "at least one { fit = .., price = .. }");
  return options;
}

std::vector<AllocationOption> read_processes(Cursor& joint, double least, ZoneLaw law) {
  std::vector<AllocationOption> options;
  for (Cursor& entry : joint.tables("processes")) {
    entry.only(allocate_process_keys());
    const double tolerance = entry.quantity("tolerance");
    entry.require(!entry.text("name").empty(), "name", "a name");
    options.push_back({entry.text("name"), entry.number("price"), make_zone(least, tolerance, law)});
    entry.finish();
  }
  if (options.empty()) joint.fail("processes", "at least one { name = .., tolerance = .., price = .. }");
  return options;
}

ContinuousJoint read_curve(Cursor& joint) {
  Cursor cost = joint.table("cost");
  cost.only(allocate_cost_keys());
  const std::string law = cost.choice("law");
  const double a = cost.number("a"), b = cost.number("b");
  if (cost.has("k") && law != "reciprocal-power") cost.fail("k", "k with law = \"reciprocal-power\" only");
  const double k = law == "reciprocal-power" ? cost.number("k") : 1.0;
  const std::string unit = cost.text("unit");
  double metres = 1e-3;
  try {
    metres = scale_of_unit(unit, kLength);
  } catch (const ValueFault& fault) {
    cost.fail_found("unit", fault.found, fault.expected, fault.nearest);
  }
  cost.finish();
  const std::vector<double> bounds = joint.quantities("tolerance");
  joint.require(bounds[0] > 0.0 && bounds[0] < bounds[1], "tolerance",
                "two lengths, the tightest and the widest tolerance");
  return {make_cost_curve(law, a, b, k, metres), bounds[0], bounds[1]};
}

void check_gaps(Cursor& entry, const AllocationJoint& joint, const std::function<void(const Setting&)>& accepts) {
  std::vector<double> values;
  for (const AllocationOption& o : joint.options) {
    values.push_back(o.gap->lowest());
    values.push_back(o.gap->highest());
  }
  if (joint.options.empty()) values = {joint.least + joint.curve.lower, joint.least + joint.curve.upper};
  const auto [least, largest] = std::minmax_element(values.begin(), values.end());
  for (const double value : {std::max(*least, 1e-9), *largest}) {
    char text[40];
    std::snprintf(text, sizeof text, "%.17g m", value);
    for (const std::string& path : joint.paths) {
      try {
        accepts({path, text});
      } catch (const InputError& error) {
        throw InputError(entry.origin("parameter"), path, error.found, error.expected, error.nearest);
      }
    }
  }
}

AllocationJoint read_joint(Cursor& entry, const std::vector<AllocationOption>& common, ZoneLaw law,
                           const MechanismDescription& mechanism, const std::function<void(const Setting&)>& accepts) {
  entry.only(allocate_joint_keys());
  AllocationJoint joint;
  joint.paths = entry.one_or_texts("parameter");
  entry.require(!joint.paths.empty(), "parameter", "the path of a radial clearance, or a list of them");
  std::vector<JournalSize> journals;
  for (const std::string& path : joint.paths) {
    joint.places.emplace_back(mechanism, path, entry.origin("parameter"));
    const std::vector<JournalSize> sizes = journal_sizes(mechanism, path);
    journals.insert(journals.end(), sizes.begin(), sizes.end());
    if (!path.starts_with("clearance.") || !path.ends_with(".radial"))
      entry.fail_found("parameter", "\"" + path + "\"", "the path of a radial clearance, clearance.JOINT.radial");
  }
  const int kinds = entry.has("fits") + entry.has("processes") + entry.has("cost");
  if (kinds > 1) entry.fail("parameter", "one of fits, processes and cost");
  if (entry.has("least") && !entry.has("processes") && !entry.has("cost"))
    entry.fail("least", "least with processes or cost only: a fit has its own");
  joint.least = entry.quantity("least");
  if (entry.has("tolerance") && !entry.has("cost")) entry.fail("tolerance", "tolerance with cost only");
  if (entry.has("fits")) {
    joint.options = read_fits(entry, law, journals);
  } else if (entry.has("processes")) {
    joint.options = read_processes(entry, joint.least, law);
  } else if (entry.has("cost")) {
    joint.curve = read_curve(entry);
  } else {
    if (common.empty()) entry.fail("fits", "fits, processes or cost; or fits of all joints, in [allocate]");
    joint.options = common;
    for (const AllocationOption& option : common)
      for (const JournalSize& journal : journals)
        if (const Fit fit = parse_fit(option.name); !is_of_size(fit, journal))
          entry.fail_found("parameter", found_size(fit, journal),
                           expected_size(journal) + ", or fits of this joint's own");
  }
  check_gaps(entry, joint, accepts);
  entry.finish();
  return joint;
}

}  // namespace

DistributionPtr make_zone(double least, double tolerance, ZoneLaw law) {
  if (law == ZoneLaw::uniform) return make_uniform(least, least + tolerance);
  return make_normal(least + 0.5 * tolerance, tolerance / 6.0)->truncated(least, least + tolerance);
}

Parameters AllocationPlan::parameters_with(const Mechanism& mechanism, std::span<const double> values) const {
  Parameters p = inputs ? inputs->parameters_with(mechanism, values.subspan(joints.size())) : mechanism.parameters();
  for (std::size_t j = 0; j < joints.size(); ++j)
    for (const ParameterPath& place : joints[j].places) place.set(p, values[j]);
  return p;
}

std::string AllocationPlan::sample_text(const Study& study) const {
  std::string text =
      "index " + study.index.text() + "\nseed " + std::to_string(seed) + " confirm " + std::to_string(confirm) + "\n";
  for (const AllocationJoint& joint : joints)
    for (const std::string& path : joint.paths) text += path + (&path == &joint.paths.back() ? "\n" : " ");
  return inputs ? text + inputs->text : text;
}

AllocationPlan read_allocation_plan(Cursor& root, const Study& study, const MechanismDescription& mechanism,
                                    const std::function<void(const Setting&)>& accepts) {
  Cursor table = root.table("allocate");
  table.only(allocate_keys());
  AllocationPlan plan;
  Cursor asked = table.table("requirement");
  plan.requirement = read_requirement(asked, study);
  const auto count = [&](const char* key, long long least, long long most, std::size_t otherwise) {
    const long long value = table.integer(key, static_cast<long long>(otherwise));
    table.require(value >= least && value <= most, key, std::to_string(least) + " to " + std::to_string(most));
    return static_cast<std::size_t>(value);
  };
  const std::int64_t fewest = wilks_one_sided(plan.requirement.probability, plan.requirement.confidence);
  plan.samples = count("samples", fewest, 1'000'000, std::max<std::size_t>(1000, static_cast<std::size_t>(4 * fewest)));
  plan.confirm = count("confirm", fewest, 1'000'000, std::max<std::size_t>(120, static_cast<std::size_t>(3 * fewest)));
  const auto shows = static_cast<std::size_t>(
      wilks_one_sided(plan.requirement.probability, confirmation_confidence(plan.requirement)));
  plan.confirm = std::max(plan.confirm, shows);
  plan.seed = static_cast<std::uint64_t>(table.integer("seed"));
  plan.front = static_cast<int>(table.integer("front"));
  plan.zone = table.choice("zone") == "uniform" ? ZoneLaw::uniform : ZoneLaw::normal;
  std::vector<AllocationOption> common;
  if (table.has("fits")) common = read_fits(table, plan.zone);
  std::set<std::string> taken;
  for (Cursor& entry : table.tables("joint")) {
    plan.joints.push_back(read_joint(entry, common, plan.zone, mechanism, accepts));
    for (const std::string& path : plan.joints.back().paths)
      if (!taken.insert(path).second)
        entry.fail_found("parameter", "\"" + path + "\" a second time", "each joint once");
    if (plan.joints.back().options.empty() != plan.joints.front().options.empty())
      entry.fail("cost",
                 "cost curves for all joints or for none: fits and processes are chosen, tolerances are continuous");
  }
  if (plan.joints.empty()) table.fail("joint", "at least one [[allocate.joint]] table");
  table.finish();
  if (root.has("random")) {
    plan.inputs = read_random_inputs(root, mechanism, accepts);
    for (const RandomParameter& p : plan.inputs->parameters)
      for (const std::string& path : p.paths)
        if (taken.contains(path))
          root.fail_found("random", "\"" + path + "\", which [allocate] gives a fit",
                          "parameters other than the clearances to be allocated");
  }
  return plan;
}

}  // namespace boresight
