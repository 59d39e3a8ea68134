#include "boresight_analyses/random/read_distribution.hpp"

#include <cmath>
#include <limits>
#include <stdexcept>

#include "boresight/io/value_fault.hpp"
#include "boresight/mechanism/error.hpp"
#include "boresight_analyses/random/csv_column.hpp"
#include "boresight_analyses/random/fit_clearance.hpp"

namespace boresight {
namespace {

// Values of the parameter: with their unit, or pure numbers.
class Values {
 public:
  explicit Values(const SiUnit& unit) : unit_(unit), pure_(std::string(unit.unit) == "1") {}
  bool pure() const { return pure_; }
  const SiUnit& unit() const { return unit_; }
  double one(Cursor& table, const std::string& key) const {
    return pure_ ? table.number(key) : table.quantity(key, unit_);
  }
  double one(Cursor& table, const std::string& key, double otherwise) const {
    return table.has(key) ? one(table, key) : otherwise;
  }
  std::vector<double> many(Cursor& table, const std::string& key) const {
    return pure_ ? table.numbers(key) : table.quantities(key, unit_);
  }

 private:
  const SiUnit& unit_;
  bool pure_;
};

DistributionPtr normal(Cursor& table, const Values& values) {
  table.only({"mean", "sd"});
  const double mean = values.one(table, "mean"), sd = values.one(table, "sd");
  table.require(sd > 0.0, "sd", "more than 0");
  return make_normal(mean, sd);
}

DistributionPtr uniform(Cursor& table, const Values& values) {
  table.only({"min", "max"});
  const double min = values.one(table, "min"), max = values.one(table, "max");
  table.require(max > min, "max", "more than min");
  return make_uniform(min, max);
}

DistributionPtr lognormal(Cursor& table, const Values& values) {
  table.only({"median", "factor"});
  const double median = values.one(table, "median"), factor = table.number("factor");
  table.require(median > 0.0, "median", "more than 0");
  table.require(factor > 1.0, "factor", "more than 1: 68 % lie between median / factor and median * factor");
  return make_lognormal(median, factor);
}

DistributionPtr triangular(Cursor& table, const Values& values) {
  table.only({"min", "mode", "max"});
  const double min = values.one(table, "min"), mode = values.one(table, "mode"), max = values.one(table, "max");
  table.require(max > min, "max", "more than min");
  table.require(mode >= min && mode <= max, "mode", "between min and max");
  return make_triangular(min, mode, max);
}

DistributionPtr beta(Cursor& table, const Values& values) {
  table.only({"alpha", "beta", "min", "max"});
  const double a = table.number("alpha"), b = table.number("beta");
  table.require(a > 0.0, "alpha", "more than 0");
  table.require(b > 0.0, "beta", "more than 0");
  const double min = values.one(table, "min"), max = values.one(table, "max");
  table.require(max > min, "max", "more than min");
  return make_beta(a, b, min, max);
}

DistributionPtr weibull(Cursor& table, const Values& values) {
  table.only({"shape", "scale", "location"});
  const double shape = table.number("shape"), scale = values.one(table, "scale");
  table.require(shape > 0.0, "shape", "more than 0");
  table.require(scale > 0.0, "scale", "more than 0");
  return make_weibull(shape, scale, values.one(table, "location", 0.0));
}

DistributionPtr discrete(Cursor& table, const Values& values) {
  table.only({"values", "probabilities"});
  const std::vector<double> value = values.many(table, "values");
  table.require(!value.empty(), "values", "at least one value");
  std::vector<double> probability(value.size(), 1.0);
  if (table.has("probabilities")) {
    probability = table.numbers("probabilities");
    table.require(probability.size() == value.size(), "probabilities",
                  std::to_string(value.size()) + " of them, as many as values");
    double sum = 0.0;
    for (const double p : probability) {
      table.require(p >= 0.0, "probabilities", "none below 0");
      sum += p;
    }
    table.require(std::abs(sum - 1.0) < 1e-6, "probabilities", "probabilities that add up to 1");
  }
  return make_discrete(value, probability);
}

DistributionPtr empirical(Cursor& table, const Values& values) {
  table.only({"file", "column", "unit"});
  const std::string file = table.text("file"), column = table.text("column");
  double scale = 1.0;
  if (!values.pure() || table.has("unit")) {
    const std::string unit = table.text("unit");
    try {
      scale = scale_of_unit(unit, values.unit());
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
  const ZoneLaw law =
      entry.choice("zone", {"normal", "uniform"}, "normal") == "normal" ? ZoneLaw::normal : ZoneLaw::uniform;
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
  DistributionPtr (*read)(Cursor&, const Values&);
};
constexpr Family kFamilies[] = {{"normal", normal},         {"uniform", uniform},    {"lognormal", lognormal},
                                {"triangular", triangular}, {"beta", beta},          {"weibull", weibull},
                                {"discrete", discrete},     {"empirical", empirical}};

}  // namespace

DistributionPtr read_distribution(Cursor& entry, const SiUnit& unit, const std::vector<JournalSize>& journals) {
  entry.only({"normal", "uniform", "lognormal", "triangular", "beta", "weibull", "discrete", "empirical", "fit", "zone",
              "truncate"});
  const Values values(unit);
  DistributionPtr distribution;
  const char* first = nullptr;
  const auto one_only = [&](const char* name) {
    if (first != nullptr) entry.fail_found(name, std::string(first) + " and " + name, "one distribution");
    first = name;
  };
  for (const Family& family : kFamilies) {
    if (!entry.has(family.name)) continue;
    one_only(family.name);
    if (!entry.is_table(family.name)) entry.fail(family.name, "a table of its numbers, such as { min = .., max = .. }");
    Cursor table = entry.table(family.name);
    distribution = family.read(table, values);
    table.finish();
  }
  if (entry.has("fit")) {
    one_only("fit");
    distribution = fit(entry, journals);
  }
  if (!distribution)
    throw InputError(entry.origin(), entry.path(), "no distribution",
                     "one of normal, uniform, lognormal, triangular, beta, weibull, discrete, empirical, fit");
  if (entry.has("truncate")) {
    const std::vector<double> bounds = values.many(entry, "truncate");
    entry.require(bounds.size() == 2 && bounds[1] > bounds[0], "truncate", "[low, high], the second one larger");
    try {
      distribution = distribution->truncated(bounds[0], bounds[1]);
    } catch (const std::domain_error&) {
      entry.fail("truncate", "bounds between which the distribution has any probability");
    }
  }
  entry.finish();
  return distribution;
}

}  // namespace boresight
