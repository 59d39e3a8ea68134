#include "boresight_analyses/random/random_inputs.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <map>
#include <stdexcept>

#include "boresight/io/tried_value.hpp"
#include "boresight/io/varied_paths.hpp"
#include "boresight/keys/parameter_unit.hpp"
#include "boresight/keys/units.hpp"
#include "boresight/mechanism/error.hpp"
#include "boresight_analyses/random/random_keys.hpp"
#include "boresight_analyses/random/read_distribution.hpp"
#include "boresight_analyses/random/read_rows.hpp"
#include "boresight_analyses/random/read_zone.hpp"

namespace boresight {
namespace {

void check_ends(Cursor& entry, const RandomParameter& random, const std::function<void(const Setting&)>& accepts) {
  constexpr double kRare = 1e-9;
  for (const double value : {random.distribution->quantile(kRare), random.distribution->upper_quantile(kRare)}) {
    const TriedValue tried(value, random.si_unit);
    for (const std::string& path : random.paths) {
      try {
        accepts({path, tried.exact()});
      } catch (const InputError& error) {
        throw InputError(entry.origin("distribution"), path,
                         "a distribution that reaches " + tried.in_message(error.found),
                         error.expected + "; truncate = [low, high] cuts it", error.nearest);
      }
    }
  }
}

// The one value that these have in the mechanism [SI]; where they differ, all.
std::vector<double> values_here(const std::vector<ParameterPath>& places, const Parameters& parameters) {
  std::vector<double> all;
  for (const ParameterPath& place : places)
    for (const double value : place.values(parameters)) all.push_back(value);
  if (std::equal(all.begin() + 1, all.end(), all.begin())) all.resize(1);
  return all;
}

RandomParameter read_parameter(Cursor& entry, const MechanismDescription& mechanism,
                               const std::function<void(const Setting&)>& accepts) {
  RandomParameter random;
  random.paths = entry.one_or_texts("parameter");
  std::vector<JournalSize> journals;
  bool radial = true;
  for (const std::string& path : random.paths) {
    random.places.emplace_back(mechanism, path, entry.origin("parameter"));
    const ParameterPath& place = random.places.back();
    if (random.si_unit.empty()) random.si_unit = place.unit();
    if (place.unit() != random.si_unit)
      entry.fail_found("parameter", "\"" + path + "\" in " + place.unit(),
                       "parameters that take the same values, in " + random.si_unit);
    const std::vector<JournalSize> sizes = journal_sizes(mechanism, path);
    radial = radial && !sizes.empty();
    journals.insert(journals.end(), sizes.begin(), sizes.end());
  }
  if (!radial) journals.clear();
  Cursor distribution = entry.table("distribution");
  const std::vector<double> here = values_here(random.places, nominal_parameters(mechanism));
  if (here.size() > 1 && distribution.has("planes"))
    entry.fail_found("parameter", differing_in_words(here, random.si_unit),
                     "parameters that have one value in the mechanism: the planes lie about it");
  random.distribution = read_distribution(distribution, unit_of_parameters(mechanism, random.paths, random.si_unit),
                                          journals, here.front());
  random.are_scales = are_scales(mechanism, random.paths);
  random.unit = unit_to_say(mechanism, random.paths, unit_as_written_of(distribution));
  check_ends(entry, random, accepts);
  return random;
}

// Of a cylinder: the two parameters, and the disc that their point is of.
void read_drawn_together(Cursor& entry, const MechanismDescription& mechanism,
                         const std::function<void(const Setting&)>& accepts, RandomInputs& inputs) {
  const std::string key = entry.has("parameters") ? "parameters" : "parameter";
  const std::vector<std::string> paths = key == "parameter" ? entry.one_or_texts(key) : entry.texts(key);
  entry.require(paths.size() == 2, key, "two parameters, whose point lies in the cylinder");
  const Parameters nominal = nominal_parameters(mechanism);
  std::array<double, 2> centre{};
  std::vector<RandomParameter> pair(2);
  for (std::size_t k = 0; k < 2; ++k) {
    pair[k].paths = {paths[k]};
    pair[k].places.emplace_back(mechanism, paths[k], entry.origin(key));
    pair[k].si_unit = pair[k].places[0].unit();
    const std::vector<double> here = values_here(pair[k].places, nominal);
    if (here.size() > 1)
      entry.fail_found(key, "\"" + paths[k] + "\" with " + differing_in_words(here, pair[k].si_unit),
                       "parameters that have one value in the mechanism: the cylinder lies about it");
    centre[k] = here.front();
  }
  if (pair[1].si_unit != pair[0].si_unit)
    entry.fail_found(key, "\"" + paths[1] + "\" in " + pair[1].si_unit,
                     "two parameters of one unit, in " + pair[0].si_unit);
  require_perpendicular(entry, key, mechanism, paths);
  Cursor distribution = entry.table("distribution");
  distribution.only(distribution_keys());
  for (const std::string& other : distribution.keys())
    if (other == "truncate" || (other != "cylinder" && other != "zone"))
      distribution.fail_found(other, "cylinder and " + other, "a cylinder alone, and zone");
  if (!distribution.is_table("cylinder")) distribution.fail("cylinder", "a table, such as { diameter = .. }");
  Cursor cylinder = distribution.table("cylinder");
  cylinder.only(cylinder_keys());
  const double radius = read_zone_reach(cylinder, "diameter", unit_called(pair[0].si_unit));
  cylinder.finish();
  const ToleranceDisc disc(radius, centre, read_zone_law(distribution));
  for (std::size_t k = 0; k < 2; ++k) {
    pair[k].distribution = disc.marginal(k);
    pair[k].are_scales = are_scales(mechanism, pair[k].paths);
    pair[k].unit = unit_to_say(mechanism, pair[k].paths, unit_as_written_of(distribution));
    check_ends(entry, pair[k], accepts);
  }
  distribution.finish();
  inputs.zones.push_back({inputs.size(), disc});
  for (RandomParameter& parameter : pair) inputs.parameters.push_back(std::move(parameter));
}

// Of the rows of a table: the parameters, each with its column.
void read_rows_of(Cursor& entry, const MechanismDescription& mechanism,
                  const std::function<void(const Setting&)>& accepts, RandomInputs& inputs) {
  const std::string key = entry.has("parameters") ? "parameters" : "parameter";
  const std::vector<std::string> paths = key == "parameter" ? entry.one_or_texts(key) : entry.texts(key);
  std::vector<RandomParameter> row(paths.size());
  std::vector<std::string> units;
  for (std::size_t k = 0; k < paths.size(); ++k) {
    row[k].paths = {paths[k]};
    row[k].places.emplace_back(mechanism, paths[k], entry.origin(key));
    row[k].are_scales = are_scales(mechanism, row[k].paths);
    row[k].unit = unit_to_say(mechanism, row[k].paths, "");
    units.push_back(row[k].si_unit = row[k].places[0].unit());
  }
  Cursor distribution = entry.table("distribution");
  distribution.only(distribution_keys());
  for (const std::string& other : distribution.keys())
    if (other != "rows") distribution.fail_found(other, "rows and " + other, "rows alone");
  if (!distribution.is_table("rows")) distribution.fail("rows", "a table, such as { file = \"draws.csv\" }");
  Cursor of_rows = distribution.table("rows");
  const auto rows = std::make_shared<const SampleRows>(read_rows(of_rows, paths, units));
  distribution.finish();
  for (std::size_t k = 0; k < row.size(); ++k) {
    row[k].distribution = column_of(rows, static_cast<Eigen::Index>(k));
    check_ends(entry, row[k], accepts);
    inputs.parameters.push_back(std::move(row[k]));
  }
}

double normal_correlation(Cursor& entry) {
  const double coefficient = entry.number("coefficient");
  const std::string measure = entry.choice("measure");
  if (measure == "spearman") return normal_from_spearman(coefficient);
  return measure == "kendall" ? normal_from_kendall(coefficient) : coefficient;
}

void read_correlations(Cursor& root, RandomInputs& inputs) {
  std::vector<Cursor> entries = root.tables("correlation");
  if (entries.empty()) return;
  std::map<std::string, Eigen::Index> index;
  std::vector<std::string> names;
  for (std::size_t k = 0; k < inputs.size(); ++k)
    for (const std::string& path : inputs.parameters[k].paths) {
      index[path] = static_cast<Eigen::Index>(k);
      names.push_back(path);
    }
  Eigen::MatrixXd correlation =
      Eigen::MatrixXd::Identity(static_cast<Eigen::Index>(inputs.size()), static_cast<Eigen::Index>(inputs.size()));
  for (Cursor& entry : entries) {
    entry.only(correlation_keys());
    const std::vector<std::string> pair = entry.texts("parameters");
    for (const std::string& path : pair)
      if (!index.contains(path))
        entry.fail_found("parameters", "\"" + path + "\"", "a parameter of a [[random]] table",
                         nearest_name(path, names));
    const Eigen::Index i = index[pair[0]], j = index[pair[1]];
    if (i == j) entry.fail("parameters", "two different parameters");
    const DrawnTogether* zone = inputs.zone_of(static_cast<std::size_t>(i));
    const DrawnTogether* other = inputs.zone_of(static_cast<std::size_t>(j));
    if (zone != nullptr && zone == other)
      entry.fail_found("parameters", "two parameters of one cylinder",
                       "parameters whose dependence is not given by their zone already");
    for (const Eigen::Index k : {i, j})
      if (rows_with(inputs.parameters[static_cast<std::size_t>(k)].distribution) != nullptr)
        entry.fail_found("parameters", "a parameter of a table's rows", "parameters with distributions of their own");
    if ((zone != nullptr || other != nullptr) && entry.choice("measure") != "normal")
      entry.fail("measure", "\"normal\" for a parameter of a cylinder, of which ranks have no closed form");
    if (correlation(i, j) != 0.0) entry.fail("parameters", "each pair once");
    correlation(i, j) = correlation(j, i) = normal_correlation(entry);
    entry.finish();
    char text[80];
    std::snprintf(text, sizeof text, "correlation %ld %ld %.17g\n", static_cast<long>(i), static_cast<long>(j),
                  correlation(i, j));
    inputs.text += text;
  }
  try {
    inputs.copula = GaussianCopula(correlation);
  } catch (const std::domain_error& error) {
    throw InputError(entries.back().origin(), "correlation", error.what(), "coefficients that can hold together");
  }
}

}  // namespace

std::vector<std::string> RandomInputs::names() const {
  std::vector<std::string> names;
  for (const RandomParameter& p : parameters) names.push_back(p.name());
  return names;
}

void RandomInputs::values(std::span<double> coordinates) const {
  copula.apply(coordinates);
  apply_quantiles(coordinates);
}

void RandomInputs::renewed_values(std::span<const double> a, std::span<const double> b,
                                  const std::vector<bool>& renewed, std::span<double> values) const {
  copula.renew(a, b, renewed, values);
  apply_quantiles(values);
}

std::vector<double> RandomInputs::values_at(double level) const {
  std::vector<double> values(size(), level);
  apply_quantiles(values);
  return values;
}

void RandomInputs::apply_quantiles(std::span<double> coordinates) const {
  auto zone = zones.begin();
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    if (zone != zones.end() && zone->first == i) {
      zone->disc.place(coordinates.subspan(i).first<2>());
      ++zone;
      ++i;
    } else if (const SampleRows* rows = rows_from(parameters[i].distribution)) {
      const Eigen::Index row = rows->row_of(coordinates[i]);
      for (Eigen::Index k = 0; k < rows->columns(); ++k, ++i) coordinates[i] = rows->at(row, k);
      --i;
    } else {
      coordinates[i] = parameters[i].distribution->quantile(coordinates[i]);
    }
  }
}

const DrawnTogether* RandomInputs::zone_of(std::size_t i) const {
  for (const DrawnTogether& zone : zones)
    if (i == zone.first || i == zone.first + 1) return &zone;
  return nullptr;
}

std::string RandomInputs::text_of(std::size_t i) const {
  const DrawnTogether* zone = zone_of(i);
  return zone == nullptr ? parameters[i].distribution->text() : zone->disc.text();
}

Parameters RandomInputs::parameters_with(const Mechanism& mechanism, std::span<const double> values) const {
  Parameters out = mechanism.parameters();
  for (std::size_t i = 0; i < parameters.size(); ++i)
    for (const ParameterPath& place : parameters[i].places) place.set(out, values[i]);
  return out;
}

RandomInputs read_random_inputs(Cursor& root, const MechanismDescription& mechanism,
                                const std::function<void(const Setting&)>& accepts) {
  RandomInputs inputs;
  VariedPaths taken(mechanism);
  for (Cursor& entry : root.tables("random")) {
    entry.only(random_keys());
    if (entry.has("parameter") && entry.has("parameters"))
      entry.fail_found("parameters", "parameter and parameters", "one of the two");
    const std::size_t before = inputs.size();
    if (entry.table("distribution").has("cylinder")) {
      read_drawn_together(entry, mechanism, accepts, inputs);
    } else if (entry.table("distribution").has("rows")) {
      read_rows_of(entry, mechanism, accepts, inputs);
    } else {
      if (entry.has("parameters"))
        entry.fail(
            "parameters",
            "a cylinder, of which two parameters are a point, or rows; parameter = [..] gives several one value");
      inputs.parameters.push_back(read_parameter(entry, mechanism, accepts));
    }
    // A tolerance zone lies around what the mechanism says.
    Cursor distribution = entry.table("distribution");
    const OwnValue own = distribution.has("cylinder") || distribution.has("planes") ? OwnValue::read : OwnValue::unread;
    const std::string key = entry.has("parameters") ? "parameters" : "parameter";
    entry.finish();
    for (std::size_t i = before; i < inputs.size(); ++i) {
      taken.take(entry.origin(key), entry.path(key), inputs.parameters[i].paths, own);
      for (const std::string& path : inputs.parameters[i].paths) inputs.text += path + " ";
    }
    inputs.text += "~ " + inputs.text_of(before) + "\n";
  }
  if (inputs.parameters.empty()) root.fail("random", "at least one [[random]] table: what scatters, and how");
  read_correlations(root, inputs);
  return inputs;
}

}  // namespace boresight
