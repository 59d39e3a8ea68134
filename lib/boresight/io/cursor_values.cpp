// Single values of a table.
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "boresight/io/cursor.hpp"
#include "boresight/io/cursor_texts.hpp"
#include "boresight/keys/value_fault.hpp"
#include "boresight/mechanism/error.hpp"

namespace boresight {

using namespace cursor;

double Cursor::set_value(const Setting& set, const std::string& where, const SiUnit* unit) const {
  document_->record_written(where, set.value);
  try {
    double value = 0.0;
    if (unit != nullptr && takes_numbers(*unit) && parse_number(set.value, value)) return value;
    if (unit != nullptr) return parse_quantity(set.value, *unit);
    if (!parse_number(set.value, value)) throw ValueFault(in_quotes(set.value), expected_value(unit));
    return value;
  } catch (const ValueFault& fault) {
    throw InputError(origin_of(set), where, fault.found, fault.expected, fault.nearest);
  }
}

// One number out of a node; `unit` null: a pure number.
double Cursor::element(const Node& node, const std::string& where, const SiUnit* unit) const {
  const Origin here{document_->filename(), node.line};
  document_->record_written(where, node.text);
  const bool is_number = node.kind == Node::Kind::integer || node.kind == Node::Kind::number;
  if (unit == nullptr || (is_number && takes_numbers(*unit))) {
    if (!is_number || !std::isfinite(node.number))
      throw InputError(here, where, shown(node), is_number ? "a finite number" : "a number");
    return node.number;
  }
  if (is_number) throw InputError(here, where, shown(node) + " without a unit", expected_value(unit));
  if (node.kind != Node::Kind::string) throw InputError(here, where, shown(node), expected_value(unit));
  try {
    return parse_quantity(replaced(node.text), *unit);
  } catch (const ValueFault& fault) {
    throw InputError(here, where, fault.found, fault.expected, fault.nearest);
  }
}

bool Cursor::given(const std::string& key) const { return member(key) != nullptr || setting(path(key)) != nullptr; }

void Cursor::check(const Key& key, const std::string& name, double value) const {
  if (!holds(key.range, value)) fail(name, in_words(key.range));
  for (const KeyBound& bound : key.bounds) require(bound.holds(value), name, bound.expected);
  for (const double refused : key.but_not) require(value != refused, name, key.but_not_expected);
}

double Cursor::one(const std::string& key, const SiUnit* unit) {
  const Node* node = member(key);
  if (const Setting* set = setting(path(key))) return set_value(*set, path(key), unit);
  if (node == nullptr) throw InputError(origin(), path(key), "nothing", expected_value(unit));
  return element(*node, path(key), unit);
}

double Cursor::quantity(const std::string& name) {
  const Key& key = known(name, {KeyKind::quantity});
  if (!given(name) && key.presence == Key::Presence::has_default) return key.number_otherwise;
  const double read = one(name, &key.range.unit);
  check(key, name, read);
  return read;
}

double Cursor::quantity(const std::string& name, double otherwise) {
  if (known(name, {KeyKind::quantity}).presence == Key::Presence::has_default)
    throw std::logic_error(keys_->name + ", " + name + " has a default of its own");
  return given(name) ? quantity(name) : otherwise;
}

double Cursor::quantity(const std::string& name, const PhysicalRange& range) {
  Key key = known(name, {KeyKind::quantity, KeyKind::value});
  if (key.unit_is.empty()) throw std::logic_error(keys_->name + ", " + name + " has a unit of its own");
  key.range = range;
  const double read = one(name, &range.unit);
  check(key, name, read);
  return read;
}

double Cursor::quantity(const std::string& name, const SiUnit& unit) {
  return quantity(name, PhysicalRange{unit, "", ""});
}

double Cursor::value(const std::string& name, const SiUnit& unit) {
  const Key& key = known(name, {KeyKind::value});
  if (!given(name) && key.presence == Key::Presence::has_default) return key.number_otherwise;
  if (std::string(unit.unit) != "1") return quantity(name, unit);
  const double read = one(name, nullptr);
  check(key, name, read);
  return read;
}

std::optional<double> Cursor::quantity_or_word(const std::string& name) {
  const Key& key = known(name, {KeyKind::quantity});
  if (!given(name) || word(name) == key.word) return {};
  const double read = one(name, &key.range.unit);
  check(key, name, read);
  return read;
}

double Cursor::number(const std::string& name) {
  const Key& key = known(name, {KeyKind::number});
  if (!given(name) && key.presence == Key::Presence::has_default) return key.number_otherwise;
  const double read = one(name, nullptr);
  check(key, name, read);
  return read;
}

double Cursor::number(const std::string& name, double otherwise) {
  if (known(name, {KeyKind::number}).presence == Key::Presence::has_default)
    throw std::logic_error(keys_->name + ", " + name + " has a default of its own");
  return given(name) ? number(name) : otherwise;
}

long long Cursor::whole(const Key& key, const std::string& name) {
  long long read = 0;
  if (const Setting* set = setting(path(name))) {
    member(name);
    const double number = set_value(*set, path(name), nullptr);
    require(number == std::floor(number) && std::abs(number) < 9e15, name, "a whole number");
    read = static_cast<long long>(number);
  } else {
    const Node& node = required(name, "a whole number");
    // Shown as "1" it would look like one.
    if (node.kind == Node::Kind::number && node.number == std::floor(node.number) && std::isfinite(node.number))
      fail_found(name, "the number " + node.text + " with a decimal point", "a whole number, such as " + node.text);
    require(node.kind == Node::Kind::integer, name, "a whole number");
    read = node.integer;
  }
  for (const KeyBound& bound : key.bounds) require(bound.holds(read), name, bound.expected);
  for (const double refused : key.but_not) require(static_cast<double>(read) != refused, name, key.but_not_expected);
  return read;
}

long long Cursor::integer(const std::string& name) {
  const Key& key = known(name, {KeyKind::integer});
  if (!given(name) && key.presence == Key::Presence::has_default) return static_cast<long long>(key.number_otherwise);
  return whole(key, name);
}

long long Cursor::integer(const std::string& name, long long otherwise) {
  const Key& key = known(name, {KeyKind::integer});
  if (key.presence == Key::Presence::has_default)
    throw std::logic_error(keys_->name + ", " + name + " has a default of its own");
  return given(name) ? whole(key, name) : otherwise;
}

bool Cursor::boolean(const std::string& name) {
  const Key& key = known(name, {KeyKind::boolean});
  const Node* node = member(name);
  if (const Setting* set = setting(path(name))) {
    require(set->value == "true" || set->value == "false", name, "true or false");
    return set->value == "true";
  }
  if (node == nullptr) return key.text_otherwise == "true";
  require(node->kind == Node::Kind::boolean, name, "true or false");
  return node->boolean;
}

std::string Cursor::word(const std::string& key) {
  const Node* node = member(key);
  if (const Setting* set = setting(path(key))) return set->value;
  if (node == nullptr) throw InputError(origin(), path(key), "nothing", "a text in quotation marks");
  require(node->kind == Node::Kind::string, key, "a text in quotation marks");
  return replaced(node->text);
}

std::string Cursor::unit_as_written(const std::string& key) {
  if (const Setting* set = setting(path(key))) return boresight::unit_as_written(set->value);
  const Node* node = member(key);
  if (node != nullptr && node->kind == Node::Kind::array) node = node->items.empty() ? nullptr : &node->items.front();
  return node != nullptr && node->kind == Node::Kind::string ? boresight::unit_as_written(replaced(node->text)) : "";
}

std::string Cursor::text(const std::string& name) {
  if (const Key* direction = keys_ != nullptr ? keys_->find(name) : nullptr;
      direction != nullptr && !direction->text_form.empty())
    return word(name);
  const Key& key = known(name, {KeyKind::text, KeyKind::expression, KeyKind::texts, KeyKind::expressions});
  if ((key.kind == KeyKind::texts || key.kind == KeyKind::expressions) && !key.or_one)
    throw std::logic_error(keys_->name + ", " + name + " is a list only");
  return !given(name) && key.presence == Key::Presence::has_default ? key.text_otherwise : text_of(key, name);
}

std::string Cursor::text_of(const Key& key, const std::string& name) {
  std::string read = word(name);
  require(key.filled_expected.empty() || !read.empty(), name, key.filled_expected);
  return read;
}

std::string Cursor::text(const std::string& name, const std::string& otherwise) {
  const Key& key = known(name, {KeyKind::text});
  if (key.presence == Key::Presence::has_default)
    throw std::logic_error(keys_->name + ", " + name + " has a default of its own");
  return given(name) ? text_of(key, name) : otherwise;
}

std::string Cursor::chosen(const std::string& key, const std::string& value,
                           const std::vector<std::string>& choices) const {
  std::string list;
  for (const std::string& allowed : choices) {
    if (value == allowed) return value;
    list += (list.empty() ? "\"" : ", \"") + allowed + "\"";
  }
  fail_found(key, in_quotes(value), choices.size() == 1 ? list : "one of " + list, nearest_name(value, choices));
}

std::string Cursor::choice(const std::string& name) {
  const Key& key = known(name, {KeyKind::choice});
  std::vector<std::string> choices;
  for (const KeyChoice& allowed : key.choices) choices.push_back(allowed.name);
  if (!given(name) && key.presence == Key::Presence::has_default) return key.text_otherwise;
  return chosen(name, word(name), choices);
}

std::string Cursor::choice(const std::string& name, const std::vector<std::string>& choices,
                           const std::string& otherwise) {
  const Key& key = known(name, {KeyKind::choice});
  for (const std::string& allowed : choices)
    if (std::none_of(key.choices.begin(), key.choices.end(), [&](const KeyChoice& c) { return c.name == allowed; }))
      throw std::logic_error(keys_->name + ", " + name + " lacks the word " + allowed);
  return given(name) ? chosen(name, word(name), choices) : otherwise;
}

}  // namespace boresight
