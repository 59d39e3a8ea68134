// What is said of a key: its default, its range and its kind, as files write them.
#include <cmath>
#include <cstdio>

#include "boresight/keys/key.hpp"

namespace boresight {
namespace {

std::string shown(double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%.6g", value);
  return text;
}

// "0.1 mm/s", as text of TOML.
std::string default_quantity(const Key& key, double value) {
  const std::string unit = key.shown_in.empty() ? key.range.unit.unit : key.shown_in;
  return "\"" + shown(value / scale_of_unit(unit, key.range.unit)) + " " + unit + "\"";
}

}  // namespace

std::string default_text(const Key& key) {
  if (key.presence != Key::Presence::has_default) return "";
  if (!key.text_otherwise.empty() || key.kind == KeyKind::text)
    return key.kind == KeyKind::boolean ? key.text_otherwise : "\"" + key.text_otherwise + "\"";
  switch (key.kind) {
    case KeyKind::quantity:
      return default_quantity(key, key.number_otherwise);
    case KeyKind::number:
    case KeyKind::integer:
    case KeyKind::value:
      return shown(key.number_otherwise);
    case KeyKind::quantities:
    case KeyKind::numbers: {
      std::string list;
      for (const double value : key.list_otherwise)
        list +=
            (list.empty() ? "[" : ", ") + (key.kind == KeyKind::numbers ? shown(value) : default_quantity(key, value));
      return list + "]";
    }
    default:
      return "";
  }
}

std::string range_text(const Key& key) {
  const std::string unit = key.range.unit.unit, least = key.range.least, most = key.range.most;
  // All bounds together.
  KeyBound all;
  for (const KeyBound& bound : key.bounds) {
    if (bound.least > all.least || (bound.least == all.least && bound.above))
      all.least = bound.least, all.above = bound.above;
    if (bound.most < all.most || (bound.most == all.most && bound.below))
      all.most = bound.most, all.below = bound.below;
  }
  if (!most.empty()) {
    const std::string sizes = least.empty() ? "at most " + most : least + " to " + most;
    if (!std::isfinite(all.least)) return sizes + " in size";
    return !least.empty() && !all.above ? "0, or " + sizes : sizes;
  }
  const auto with_unit = [&](double value) {
    char whole[40];
    std::snprintf(whole, sizeof whole, "%.0f", value);
    return (key.kind == KeyKind::integer ? whole : shown(value)) +
           (unit.empty() || unit == "1" || value == 0.0 ? "" : " " + unit);
  };
  const bool from = std::isfinite(all.least), to = std::isfinite(all.most);
  if (from && to && all.least == all.most) return with_unit(all.least);
  if (from && to && !all.above && !all.below) return with_unit(all.least) + " to " + with_unit(all.most);
  std::string text = !from ? "" : all.above ? "above " + with_unit(all.least) : with_unit(all.least) + " or more";
  if (to) text += (from ? " and " : "") + std::string(all.below ? "below " : "at most ") + with_unit(all.most);
  return text;
}

std::string kind_text(const Key& key) {
  const std::string unit = key.range.unit.unit, what = key.range.unit.what;
  const std::string thing = what.substr(what.find(' ') + 1);  // "a length" without its article
  std::string many = "list";
  for (const std::size_t count : key.counts)
    many += (count == key.counts.front() ? " of " : " or ") + std::to_string(count);
  if (key.fewest > 1) many += " of " + std::to_string(key.fewest) + " or more";
  const std::string one_too = key.or_one ? ", or one of them" : "";
  const auto of_unit = [&](const std::string& name) {
    if (!key.unit_is.empty()) return name + " in the unit of " + key.unit_is;
    return thing + " with its unit, \"" + key.range.unit.example + "\"" +
           (key.word.empty() ? "" : ", or \"" + key.word + "\"");
  };
  switch (key.kind) {
    case KeyKind::quantity:
      return of_unit("quantity");
    case KeyKind::quantities:
      return many + ", each a " + of_unit("quantity");
    case KeyKind::vector:
      return "three along the world's x, y, z, each a " + of_unit("quantity");
    case KeyKind::points:
      return many + " points, each three lengths with their units";
    case KeyKind::number:
      return "number";
    case KeyKind::numbers:
      return many + " numbers";
    case KeyKind::direction:
      return "direction: three numbers, not all zero, of any length" +
             (key.text_form.empty() ? "" : "; or " + key.text_form);
    case KeyKind::integer:
      return "whole number";
    case KeyKind::value:
      return "value in the unit of " + key.unit_is + ", or a number where that is one";
    case KeyKind::values:
      return many + " of values in the unit of " + key.unit_is + ", or of numbers where that is one";
    case KeyKind::boolean:
      return "true or false";
    case KeyKind::text:
      return "text";
    case KeyKind::texts:
      return many + " of texts" + one_too;
    case KeyKind::choice:
      return "word";
    case KeyKind::choices:
      return many + (key.fewest > 1 ? " words" : " of words");
    case KeyKind::expression:
      return unit == "1" ? "expression" : "expression of t in " + unit;
    case KeyKind::expressions:
      return many + " expressions of t in " + unit + one_too;
    case KeyKind::table:
      return "table";
    case KeyKind::tables:
      return key.fewest == 1 ? "one table or more" : "any number of tables";
  }
  return "";
}

}  // namespace boresight
