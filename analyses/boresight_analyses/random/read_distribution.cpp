#include "boresight_analyses/random/read_distribution.hpp"

#include <cmath>
#include <limits>
#include <stdexcept>

#include "boresight/keys/value_fault.hpp"
#include "boresight/mechanism/error.hpp"
#include "boresight_analyses/random/csv_column.hpp"
#include "boresight_analyses/random/fit_clearance.hpp"
#include "boresight_analyses/random/random_keys.hpp"
#include "boresight_analyses/random/read_zone.hpp"

namespace boresight {
namespace {

DistributionPtr normal(Cursor& table, const SiUnit& unit) {
  const double mean = table.value("mean", unit), sd = table.value("sd", unit);
  return make_normal(mean, sd);
}

DistributionPtr uniform(Cursor& table, const SiUnit& unit) {
  const double min = table.value("min", unit), max = table.value("max", unit);
  table.require(max > min, "max", "more than min");
  return make_uniform(min, max);
}

DistributionPtr lognormal(Cursor& table, const SiUnit& unit) {
  const double median = table.value("median", unit), factor = table.number("factor");
  return make_lognormal(median, factor);
}

DistributionPtr triangular(Cursor& table, const SiUnit& unit) {
  const double min = table.value("min", unit), mode = table.value("mode", unit), max = table.value("max", unit);
  table.require(max > min, "max", "more than min");
  table.require(mode >= min && mode <= max, "mode", "between min and max");
  return make_triangular(min, mode, max);
}

DistributionPtr beta(Cursor& table, const SiUnit& unit) {
  const double a = table.number("alpha"), b = table.number("beta");
  const double min = table.value("min", unit), max = table.value("max", unit);
  table.require(max > min, "max", "more than min");
  return make_beta(a, b, min, max);
}

DistributionPtr weibull(Cursor& table, const SiUnit& unit) {
  const double shape = table.number("shape"), scale = table.value("scale", unit);
  return make_weibull(shape, scale, table.value("location", unit));
}

DistributionPtr discrete(Cursor& table, const SiUnit& unit) {
  const std::vector<double> value = table.values("values", unit);
  std::vector<double> probability(value.size(), 1.0);
  if (table.has("probabilities")) {
    probability = table.numbers("probabilities");
    table.require(probability.size() == value.size(), "probabilities",
                  std::to_string(value.size()) + " of them, as many as values");
    double sum = 0.0;
    for (const double p : probability) sum += p;
    table.require(std::abs(sum - 1.0) < 1e-6, "probabilities", "probabilities that add up to 1");
  }
  return make_discrete(value, probability);
}

DistributionPtr empirical(Cursor& table, const SiUnit& unit) {
  const std::string file = table.text("file"), column = table.text("column");
  double scale = 1.0;
  if (std::string(unit.unit) != "1" || table.has("unit")) {
    const std::string unit_of_column = table.text("unit");
    try {
      scale = scale_of_unit(unit_of_column, unit);
    } catch (const ValueFault& fault) {
      throw InputError(table.origin("unit"), table.path("unit"), fault.found, fault.expected, fault.nearest);
    }
  }
  try {
    std::vector<double> read = read_csv_column(beside(table.origin().file, file), column);
    for (double& value : read) value *= scale;
    return make_empirical(std::move(read));
  } catch (const ColumnFault& fault) {
    throw InputError(table.origin(fault.about_the_file ? "file" : "column"),
                     table.path(fault.about_the_file ? "file" : "column"), fault.found, fault.expected, fault.nearest);
  }
}

DistributionPtr fit(Cursor& entry, const std::vector<JournalSize>& journals) {
  if (journals.empty()) entry.fail("fit", "a fit for a radial clearance only (parameter = \"clearance.JOINT.radial\")");
  const ZoneLaw law = read_zone_law(entry);
  try {
    const Fit found = parse_fit(entry.text("fit"));
    if (found.least_clearance() < 0.0)
      entry.fail_found("fit",
                       "\"" + found.name + "\", whose shaft may be thicker than its hole by " +
                           std::to_string(std::lround(-1e6 * found.least_clearance())) + " um",
                       "a fit that always has clearance, such as \"20 H7/g6\"");
    for (const JournalSize& journal : journals)
      if (!is_of_size(found, journal)) entry.fail_found("fit", found_size(found, journal), expected_size(journal));
    return make_fit_clearance(found, law);
  } catch (const ValueFault& fault) {
    throw InputError(entry.origin("fit"), entry.path("fit"), fault.found, fault.expected, fault.nearest);
  }
}

struct Family {
  const char* name;
  const KeyTable& (*keys)();
  DistributionPtr (*read)(Cursor&, const SiUnit&);
};
constexpr Family kFamilies[] = {
    {"normal", normal_keys, normal},
    {"uniform", uniform_keys, uniform},
    {"lognormal", lognormal_keys, lognormal},
    {"triangular", triangular_keys, triangular},
    {"beta", beta_keys, beta},
    {"weibull", weibull_keys, weibull},
    {"discrete", discrete_keys, discrete},
    {"empirical", empirical_keys, empirical},
};

}  // namespace

DistributionPtr read_distribution(Cursor& entry, const SiUnit& unit, const std::vector<JournalSize>& journals,
                                  double nominal) {
  entry.only(distribution_keys());
  DistributionPtr distribution;
  for (const Family& family : kFamilies) {
    if (!entry.has(family.name)) continue;
    if (!entry.is_table(family.name)) entry.fail(family.name, "a table of its numbers, such as { min = .., max = .. }");
    Cursor table = entry.table(family.name);
    table.only(family.keys());
    distribution = family.read(table, unit);
    table.finish();
  }
  if (entry.has("fit")) distribution = fit(entry, journals);
  if (entry.has("planes")) {
    Cursor table = entry.table("planes");
    table.only(planes_keys());
    const double reach = read_zone_reach(table, "width", unit);
    table.finish();
    constexpr double kNarrowest = 1e-9;  // what the parameter's own value swallows by rounding is no zone
    table.require(reach > kNarrowest * std::abs(nominal), "width",
                  "more than a billionth of the value that the planes lie about");
    distribution = make_between_planes(nominal, reach, read_zone_law(entry));
  }
  if (entry.has("cylinder"))
    entry.fail_found("cylinder", "a zone that two parameters share", "[[random]] parameters = [..], two of them");
  if (entry.has("rows"))
    entry.fail_found("rows", "the rows of a table",
                     "a distribution of one parameter; [[random]] parameters = [..] take rows");
  if (entry.has("truncate")) {
    const std::vector<double> bounds = entry.values("truncate", unit);
    entry.require(bounds[1] > bounds[0], "truncate", "[low, high], the second one larger");
    try {
      distribution = distribution->truncated(bounds[0], bounds[1]);
    } catch (const std::domain_error&) {
      entry.fail("truncate", "bounds between which the distribution has any probability");
    }
  }
  entry.finish();
  return distribution;
}

std::string unit_as_written_of(Cursor& distribution) {
  static const std::set<std::string> kValues = {"mean",  "median", "mode",     "min",
                                                "scale", "values", "diameter", "width"};
  for (const std::string& name : distribution.keys()) {
    if (!distribution.is_table(name)) continue;
    Cursor kind = distribution.table(name);
    if (kind.has("length")) continue;  // the values are angles, what is written is not
    for (const std::string& key : kind.keys())
      if (kValues.contains(key)) return kind.unit_as_written(key);
  }
  return "";
}

}  // namespace boresight
