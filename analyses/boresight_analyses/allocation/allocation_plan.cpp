#include "boresight_analyses/allocation/allocation_plan.hpp"

#include <algorithm>
#include <cmath>

#include "boresight/io/tried_value.hpp"
#include "boresight/io/varied_paths.hpp"
#include "boresight/keys/parameter_unit.hpp"
#include "boresight/keys/units.hpp"
#include "boresight/keys/value_fault.hpp"
#include "boresight/mechanism/error.hpp"
#include "boresight/mechanism/parameter_path.hpp"
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
  return options;
}

// A zone that its place swallows by rounding is none.
void require_wide(Cursor& table, const AllocationEntry& of, double tolerance) {
  constexpr double kNarrowest = 1e-9;
  table.require(tolerance > kNarrowest * std::abs(of.least), "tolerance",
                "more than a billionth of the value that its zone lies at");
}

std::vector<AllocationOption> read_processes(Cursor& table, const AllocationEntry& of, const SiUnit& unit,
                                             ZoneLaw law) {
  std::vector<AllocationOption> options;
  for (Cursor& entry : table.tables("processes")) {
    entry.only(of.is_error ? allocate_error_process_keys() : allocate_process_keys());
    const double tolerance = of.is_error ? entry.value("tolerance", unit) : entry.quantity("tolerance");
    require_wide(entry, of, tolerance);
    const std::string name = entry.text("name");
    for (const AllocationOption& other : options)
      if (other.name == name) entry.fail_found("name", in_quotes(name) + " a second time", "a name of its own");
    options.push_back({name, entry.number("price"), of.zone(tolerance, law)});
    entry.finish();
  }
  return options;
}

// In which unit b is meant where the file does not say.
const char* usual_unit(const std::string& si_unit) {
  return si_unit == "m" ? "mm" : si_unit == "rad" ? "mrad" : si_unit.c_str();
}

ContinuousTolerance read_curve(Cursor& table, const AllocationEntry& of, const SiUnit& written_in) {
  Cursor cost = table.table("cost");
  cost.only(allocate_cost_keys());
  const std::string law = cost.choice("law");
  const double a = cost.number("a"), b = cost.number("b");
  if (cost.has("k") && law != "reciprocal-power") cost.fail("k", "k with law = \"reciprocal-power\" only");
  const double k = law == "reciprocal-power" ? cost.number("k") : 1.0;
  const std::string unit = cost.has("unit") ? cost.text("unit") : usual_unit(of.unit());
  double si = 1.0;
  try {
    si = scale_of_unit(unit, written_in);
  } catch (const ValueFault& fault) {
    cost.fail_found("unit", fault.found, fault.expected, fault.nearest);
  }
  cost.finish();
  const std::vector<double> bounds =
      of.is_error ? table.values("tolerance", written_in) : table.quantities("tolerance");
  table.require(bounds.size() == 2 && bounds[0] > 0.0 && bounds[0] < bounds[1], "tolerance",
                of.is_error ? "two values, the tightest and the widest tolerance"
                            : "two lengths, the tightest and the widest tolerance");
  require_wide(table, of, bounds[0]);
  return {make_cost_curve(law, a, b, k, si), bounds[0], bounds[1]};
}

void check_gaps(Cursor& entry, const AllocationEntry& joint, const std::function<void(const Setting&)>& accepts) {
  std::vector<double> values;
  for (const AllocationOption& o : joint.options) {
    values.push_back(o.gap->lowest());
    values.push_back(o.gap->highest());
  }
  if (joint.is_continuous())
    for (const double tolerance : {joint.curve.lower, joint.curve.upper}) {
      const DistributionPtr zone = joint.zone(tolerance, ZoneLaw::uniform);
      values.insert(values.end(), {zone->lowest(), zone->highest()});
    }
  const auto [least, largest] = std::minmax_element(values.begin(), values.end());
  for (const double value : {joint.is_error ? *least : std::max(*least, 1e-9), *largest}) {
    const TriedValue tried(value, joint.unit());
    for (const std::string& path : joint.paths) {
      try {
        accepts({path, tried.exact()});
      } catch (const InputError& error) {
        throw InputError(entry.origin("parameter"), path, tried.in_message(error.found), error.expected, error.nearest);
      }
    }
  }
}

AllocationEntry read_joint(Cursor& entry, const std::vector<AllocationOption>& common, ZoneLaw law,
                           const MechanismDescription& mechanism, const std::function<void(const Setting&)>& accepts) {
  entry.only(allocate_joint_keys());
  AllocationEntry joint;
  joint.paths = entry.one_or_texts("parameter");
  std::vector<JournalSize> journals;
  for (const std::string& path : joint.paths) {
    joint.places.emplace_back(mechanism, path, entry.origin("parameter"));
    const std::vector<JournalSize> sizes = journal_sizes(mechanism, path);
    journals.insert(journals.end(), sizes.begin(), sizes.end());
    if (sizes.empty())
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
    joint.options = read_processes(entry, joint, kLength, law);
  } else if (entry.has("cost")) {
    joint.curve = read_curve(entry, joint, kLength);
    joint.said_in = entry.unit_as_written("tolerance");
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

// One table, of as many errors as it names.
std::vector<AllocationEntry> read_errors_of(Cursor& table, ZoneLaw law, const MechanismDescription& mechanism,
                                            const std::function<void(const Setting&)>& accepts) {
  table.only(allocate_error_keys());
  const std::vector<std::string> paths = table.one_or_texts("parameter");
  if (table.has("processes") == table.has("cost")) table.fail("processes", "one of processes and cost");
  if (table.has("tolerance") && !table.has("cost")) table.fail("tolerance", "tolerance with cost only");
  std::vector<AllocationEntry> entries;
  for (const std::string& path : paths) {
    AllocationEntry entry;
    entry.is_error = true;
    entry.paths = {path};
    entry.places.emplace_back(mechanism, path, table.origin("parameter"));
    if (!path.starts_with("error.") || path.find('*') != std::string::npos)
      table.fail_found("parameter", in_quotes(path), "the path of one error, error.NAME");
    entry.least = entry.places.front().get(nominal_parameters(mechanism));
    if (!entries.empty() && entry.unit() != entries.front().unit())
      table.fail_found(
          "parameter", in_quotes(path) + ", which is measured in " + entry.unit(),
          "errors of one kind in a table: " + in_quotes(paths.front()) + " is measured in " + entries.front().unit());
    const SiUnit unit = unit_of_parameters(mechanism, entry.paths, entry.unit());
    if (table.has("processes"))
      entry.options = read_processes(table, entry, unit, law);
    else
      entry.curve = read_curve(table, entry, unit);
    entry.said_in = unit_to_say(mechanism, entry.paths, table.unit_as_written("tolerance"));
    check_gaps(table, entry, accepts);
    entries.push_back(std::move(entry));
  }
  table.finish();
  return entries;
}

}  // namespace

DistributionPtr make_zone(double least, double tolerance, ZoneLaw law) {
  if (law == ZoneLaw::uniform) return make_uniform(least, least + tolerance);
  return make_normal(least + 0.5 * tolerance, tolerance / 6.0)->truncated(least, least + tolerance);
}

DistributionPtr AllocationEntry::zone(double tolerance, ZoneLaw law) const {
  return make_zone(is_error ? least - 0.5 * tolerance : least, tolerance, law);
}

bool AllocationPlan::is_continuous() const {
  return std::all_of(entries.begin(), entries.end(), [](const AllocationEntry& e) { return e.is_continuous(); });
}

bool AllocationPlan::has_curves() const {
  return std::any_of(entries.begin(), entries.end(), [](const AllocationEntry& e) { return e.is_continuous(); });
}

ZonePlaces AllocationPlan::zone_places() const {
  ZonePlaces places;
  for (const AllocationEntry& entry : entries) {
    places.least.push_back(entry.least);
    places.centred.push_back(entry.is_error);
  }
  return places;
}

std::vector<std::size_t> AllocationPlan::inputs_to_be_linear_in() const {
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < scattered(); ++i) {
    const std::vector<std::string>& paths = inputs->parameters[i].paths;
    const auto are = [&](auto&& of_kind) { return std::all_of(paths.begin(), paths.end(), of_kind); };
    if (are([](const std::string& path) { return path.starts_with("error."); }) ||
        are([](const std::string& path) { return path.starts_with("clearance.") && path.ends_with(".radial"); }))
      found.push_back(i);
  }
  return found;
}

Parameters AllocationPlan::parameters_with(const Mechanism& mechanism, std::span<const double> values) const {
  Parameters p = inputs ? inputs->parameters_with(mechanism, values.subspan(entries.size())) : mechanism.parameters();
  for (std::size_t j = 0; j < entries.size(); ++j)
    for (const ParameterPath& place : entries[j].places) place.set(p, values[j]);
  return p;
}

std::string AllocationPlan::sample_text(const Study& study) const {
  std::string text =
      "index " + study.index.text() + "\nseed " + std::to_string(seed) + " confirm " + std::to_string(confirm) + "\n";
  for (const AllocationEntry& joint : entries)
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
  VariedPaths taken(mechanism);
  const auto take = [&](const Cursor& table_of, AllocationEntry entry) {
    // An error's tolerance lies around what the mechanism says of it.
    taken.take(table_of.origin("parameter"), table_of.path("parameter"), entry.paths,
               entry.is_error ? OwnValue::read : OwnValue::unread,
               entry.is_error ? "each error once" : "each joint once");
    plan.entries.push_back(std::move(entry));
  };
  for (Cursor& entry : table.tables("joint")) take(entry, read_joint(entry, common, plan.zone, mechanism, accepts));
  for (Cursor& error : table.tables("error"))
    for (AllocationEntry& entry : read_errors_of(error, plan.zone, mechanism, accepts)) take(error, std::move(entry));
  if (plan.entries.empty()) table.fail("joint", "at least one [[allocate.joint]] or [[allocate.error]] table");
  table.finish();
  if (root.has("random")) {
    plan.inputs = read_random_inputs(root, mechanism, accepts);
    for (const RandomParameter& p : plan.inputs->parameters)
      for (const std::string& path : p.paths)
        for (const std::string& single : single_paths(mechanism, path))
          if (taken.contains(single))
            root.fail_found("random", "\"" + single + "\", which [allocate] gives a fit or a tolerance",
                            "parameters other than those to be allocated");
  }
  return plan;
}

}  // namespace boresight
