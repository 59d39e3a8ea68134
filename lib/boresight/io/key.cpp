#include "boresight/io/key.hpp"

#include <cmath>
#include <cstdio>
#include <utility>

namespace boresight {
namespace {

std::string shown(double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%.6g", value);
  return text;
}

Key made(const std::string& name, KeyKind kind) {
  Key key;
  key.name = name;
  key.kind = kind;
  return key;
}

Key made(const std::string& name, KeyKind kind, const PhysicalRange& range) {
  Key key = made(name, kind);
  key.range = range;
  return key;
}

// "0.1 mm/s", as text of TOML.
std::string default_quantity(const Key& key, double value) {
  const std::string unit = key.shown_in.empty() ? key.range.unit.unit : key.shown_in;
  return "\"" + shown(value / scale_of_unit(unit, key.range.unit)) + " " + unit + "\"";
}

}  // namespace

bool KeyBound::holds(long double value) const {
  return (above ? value > least : value >= least) && (below ? value < most : value <= most);
}

Key Key::otherwise(double value, const std::string& shown_in_unit) && {
  presence = Presence::has_default;
  number_otherwise = value;
  shown_in = shown_in_unit;
  return std::move(*this);
}
Key Key::otherwise(std::vector<double> values, const std::string& shown_in_unit) && {
  presence = Presence::has_default;
  list_otherwise = std::move(values);
  shown_in = shown_in_unit;
  return std::move(*this);
}
Key Key::otherwise(const char* text) && {
  presence = Presence::has_default;
  text_otherwise = text;
  return std::move(*this);
}
Key Key::usually(const std::string& words) && {
  presence = Presence::computed;
  when = words;
  return std::move(*this);
}
Key Key::sometimes(const std::string& words) && {
  presence = Presence::sometimes;
  when = words;
  return std::move(*this);
}
Key Key::or_word(const std::string& text) && {
  presence = Presence::has_default;
  word = text_otherwise = text;
  return std::move(*this);
}
Key Key::bounded(KeyBound bound) && {
  bounds.push_back(std::move(bound));
  return std::move(*this);
}
Key Key::above(double least, const std::string& expected) && {
  return std::move(*this).bounded({.least = least, .above = true, .expected = expected});
}
Key Key::at_least(double least, const std::string& expected) && {
  return std::move(*this).bounded({.least = least, .expected = expected});
}
Key Key::at_most(double most, const std::string& expected) && {
  return std::move(*this).bounded({.most = most, .expected = expected});
}
Key Key::between(double least, double most, const std::string& expected) && {
  return std::move(*this).bounded({.least = least, .most = most, .expected = expected});
}
Key Key::inside_of(double least, double most, const std::string& expected) && {
  return std::move(*this).bounded({.least = least, .most = most, .above = true, .below = true, .expected = expected});
}
Key Key::counting(double least, double most) && {
  char text[80];
  std::snprintf(text, sizeof text, "%.0f to %.0f", least, most);
  return std::move(*this).between(least, most, text);
}
Key Key::share() && { return std::move(*this).inside_of(0.0, 1.0, "more than 0 and less than 1"); }
Key Key::named(std::vector<std::string> names) && {
  elements = std::move(names);
  return std::move(*this);
}
Key Key::of_length(std::vector<std::size_t> lengths, const std::string& expected) && {
  counts = std::move(lengths);
  list_expected = expected;
  return std::move(*this);
}
Key Key::or_single() && {
  or_one = true;
  return std::move(*this);
}
Key Key::for_verbs(const std::string& names) && {
  verbs = names;
  return std::move(*this);
}
Key Key::says(const std::string& text) && {
  sentence = text;
  return std::move(*this);
}

const Key* KeyTable::find(const std::string& key) const {
  if (any_name) return &keys.front();
  for (const Key& known : keys)
    if (known.name == key) return &known;
  return nullptr;
}

std::vector<std::string> KeyTable::names() const {
  std::vector<std::string> all;
  for (const Key& key : keys) all.push_back(key.name);
  return all;
}

namespace keys {

Key quantity(const std::string& name, const PhysicalRange& range) { return made(name, KeyKind::quantity, range); }
Key quantity(const std::string& name, const SiUnit& unit) { return made(name, KeyKind::quantity, {unit, "", ""}); }
Key quantity_of(const std::string& name, const std::string& unit_is) {
  Key key = made(name, KeyKind::quantity);
  key.unit_is = unit_is;
  return key;
}
Key quantities(const std::string& name, const PhysicalRange& range) { return made(name, KeyKind::quantities, range); }
Key quantities(const std::string& name, const SiUnit& unit) { return made(name, KeyKind::quantities, {unit, "", ""}); }
Key vector(const std::string& name, const PhysicalRange& range) { return made(name, KeyKind::vector, range); }
Key points(const std::string& name, std::size_t count, const PhysicalRange& range) {
  Key key = made(name, KeyKind::points, range);
  key.counts = {count};
  key.list_expected = "a list of " + std::to_string(count) + " points";
  return key;
}
Key number(const std::string& name) { return made(name, KeyKind::number); }
Key numbers(const std::string& name) { return made(name, KeyKind::numbers); }
Key direction(const std::string& name) { return made(name, KeyKind::direction); }
Key integer(const std::string& name) { return made(name, KeyKind::integer); }
Key value(const std::string& name, const std::string& unit_is) {
  Key key = made(name, KeyKind::value);
  key.unit_is = unit_is;
  return key;
}
Key values(const std::string& name, const std::string& unit_is) {
  Key key = made(name, KeyKind::values);
  key.unit_is = unit_is;
  return key;
}
Key boolean(const std::string& name, bool otherwise) {
  return made(name, KeyKind::boolean).otherwise(otherwise ? "true" : "false");
}
Key text(const std::string& name) { return made(name, KeyKind::text); }
Key texts(const std::string& name) { return made(name, KeyKind::texts); }
Key choice(const std::string& name, std::vector<KeyChoice> choices) {
  Key key = made(name, KeyKind::choice);
  key.choices = std::move(choices);
  return key;
}
Key choice(const std::string& name, const std::vector<std::string>& choices) {
  Key key = made(name, KeyKind::choice);
  for (const std::string& word : choices) key.choices.push_back({word, ""});
  return key;
}
Key choices(const std::string& name, const std::vector<std::string>& choices, const std::string& expected) {
  Key key = choice(name, choices);
  key.kind = KeyKind::choices;
  key.list_expected = expected;
  return key;
}
Key expression(const std::string& name, const SiUnit& unit) { return made(name, KeyKind::expression, {unit, "", ""}); }
Key expressions(const std::string& name, const SiUnit& unit) {
  return made(name, KeyKind::expressions, {unit, "", ""});
}
Key table(const std::string& name, const KeyTable& (*inside)()) {
  Key key = made(name, KeyKind::table);
  key.inside = inside;
  return key;
}
Key tables(const std::string& name, const KeyTable& (*inside)()) {
  Key key = made(name, KeyKind::tables);
  key.inside = inside;
  return key;
}

}  // namespace keys

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
      return "direction: three numbers, not all zero, of any length";
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
      return many + " of words";
    case KeyKind::expression:
      return "expression of t in " + unit;
    case KeyKind::expressions:
      return many + " expressions of t in " + unit + one_too;
    case KeyKind::table:
      return "table";
    case KeyKind::tables:
      return "any number of tables";
  }
  return "";
}

}  // namespace boresight
