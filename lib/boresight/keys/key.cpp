#include "boresight/keys/key.hpp"

#include <cstdio>
#include <utility>

namespace boresight {
namespace {

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
Key Key::or_text(const std::string& form) && {
  text_form = form;
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
Key Key::at_least_of(std::size_t count, const std::string& expected) && {
  fewest = count;
  fewest_expected = expected;
  return std::move(*this);
}
Key Key::all_different() && {
  distinct = true;
  return std::move(*this);
}
Key Key::with_some_not_zero() && {
  not_all_zero = true;
  return std::move(*this);
}
Key Key::filled(const std::string& expected) && {
  filled_expected = expected;
  return std::move(*this);
}
Key Key::except(std::vector<double> refused, const std::string& expected) && {
  but_not = std::move(refused);
  but_not_expected = expected;
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

}  // namespace boresight
