#include "boresight_analyses/function/function_input.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <set>

#include "boresight/keys/mechanism_keys.hpp"
#include "boresight/keys/value_fault.hpp"
#include "boresight/mechanism/error.hpp"

namespace boresight {
namespace {

std::string number_text(double value, const std::string& si_unit) {
  char text[60];
  std::snprintf(text, sizeof text, "%.9g%s%s", value, si_unit == "1" ? "" : " ", si_unit == "1" ? "" : si_unit.c_str());
  return text;
}

PhysicalRange range_of_error(const std::string& si_unit) {
  return si_unit == "rad" ? kFrameTurnRange : si_unit == "K" ? kWarmingRange : kCoordinateRange;
}

}  // namespace

std::vector<FunctionInput> inputs_named(const Mechanism& mechanism, const std::vector<std::string>& paths) {
  std::vector<FunctionInput> inputs;
  std::set<std::string> seen;
  for (const std::string& path : paths) {
    const ParameterPath place(mechanism.description(), path);
    if (!seen.insert(path).second) throw InputError({}, path, "it a second time", "each input once");
    inputs.push_back({{path},
                      place.unit(),
                      place.values(mechanism.parameters()),
                      {place},
                      names_scales(mechanism.description(), path)});
  }
  return inputs;
}

std::vector<FunctionInput> inputs_of(const RandomInputs& random) {
  const std::vector<double> medians = random.values_at(0.5);
  std::vector<FunctionInput> inputs;
  for (std::size_t i = 0; i < random.size(); ++i) {
    const RandomParameter& p = random.parameters[i];
    inputs.push_back({p.paths, p.si_unit, {medians[i]}, p.places, p.are_scales});
  }
  return inputs;
}

const Key* key_of_path(const std::string& path) {
  // Names may have dots in them: a key is known by how the path ends, and by the table that it begins with.
  const auto last = [&](std::size_t from) {
    return path.substr(path.rfind('.', from) + 1, from - path.rfind('.', from));
  };
  const std::string key = last(path.size());
  const std::size_t dot = path.rfind('.');
  const std::string before = dot == std::string::npos ? "" : last(dot - 1);
  const auto begins = [&](const char* table) { return path.starts_with(table); };
  if (begins("error.")) return nullptr;
  if (begins("gravity.")) return mechanism_keys().find("gravity");
  if (before == "center_of_mass") return (begins("payload.") ? payload_keys() : body_keys()).find(before);
  if (begins("payload.")) return payload_keys().find(key);
  if (begins("body.")) return body_keys().find(key);
  if (begins("spring.")) return spring_keys().find(key);
  if (before == "contact")
    if (const Key* found = contact_keys().find(key)) return found;
  if (before == "friction")
    if (const Key* found = friction_keys().find(key)) return found;
  return clearance_keys().find(key);
}

void check_value(const FunctionInput& input, double value) {
  if (!std::isfinite(value)) throw ValueFault(std::isnan(value) ? "not a number" : "infinity", "a finite number");
  for (const std::string& path : input.paths) {
    const Key* key = key_of_path(path);
    const PhysicalRange range = key != nullptr ? key->range : range_of_error(input.si_unit);
    if (!holds(range, value)) throw ValueFault(number_text(value, input.si_unit), in_words(range));
    if (key == nullptr) continue;
    for (const KeyBound& bound : key->bounds)
      if (!bound.holds(value)) throw ValueFault(number_text(value, input.si_unit), bound.expected);
  }
}

}  // namespace boresight
