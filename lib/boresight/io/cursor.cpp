#include "boresight/io/cursor.hpp"

#include <cmath>

#include "boresight/io/value_fault.hpp"
#include "boresight/mechanism/error.hpp"

namespace boresight {
namespace {

const Node kEmptyTable;

const std::vector<std::string> kAxisNames = {"x", "y", "z"};

std::string joined(const std::string& path, const std::string& key) { return path.empty() ? key : path + "." + key; }

std::string expected_value(const SiUnit* unit) { return unit != nullptr ? expectation(*unit) : "a number"; }

std::string element_path(const std::string& path, const std::vector<std::string>& names, std::size_t k) {
  return joined(path, k < names.size() ? names[k] : std::to_string(k + 1));
}

}  // namespace

Cursor::Cursor(Document& document) : Cursor(document, document.root(), "") {}

Cursor::Cursor(Document& document, const Node& node, std::string path)
    : document_(&document), node_(&node), line_(node.line), path_(std::move(path)) {}

Cursor Cursor::child(const Node& node, std::string path) const {
  Cursor result(*document_, node, std::move(path));
  result.copy_ = copy_;
  result.turn_ = turn_;
  return result;
}

Cursor Cursor::copy(int number, const Mat3& turn) const {
  Cursor result = *this;
  result.copy_ = number;
  result.turn_ = turn;
  return result;
}

// --- keys, paths and faults ------------------------------------------------------------------------------------------

std::string Cursor::path(const std::string& key) const { return joined(path_, key); }

// The setting that is to blame for this value: on its path, or on an element of it where it is a list.
const Setting* Cursor::blamed_setting(const std::string& key) const {
  return is_table(key) ? setting(path(key)) : document_->setting_under(path(key));
}

Origin Cursor::origin(const std::string& key) const {
  if (const Setting* set = blamed_setting(key)) return origin_of(*set);
  const Node* node = node_->member(key);
  return {document_->filename(), node != nullptr ? node->line : line_};
}

std::string Cursor::found(const std::string& key) const {
  if (const Setting* set = blamed_setting(key)) return in_quotes(set->value);
  const Node* node = node_->member(key);
  return node != nullptr ? shown(*node) : "nothing";
}

void Cursor::fail(const std::string& key, const std::string& expected, const std::string& nearest) const {
  throw InputError(origin(key), path(key), found(key), expected, nearest);
}

void Cursor::fail_found(const std::string& key, const std::string& what, const std::string& expected,
                        const std::string& nearest) const {
  throw InputError(origin(key), path(key), what, expected, nearest);
}

void Cursor::require(bool condition, const std::string& key, const std::string& expected) const {
  if (!condition) fail(key, expected);
}

void Cursor::only(std::initializer_list<const char*> known) const {
  const std::vector<std::string> names(known.begin(), known.end());
  for (const auto& [key, node] : node_->members) {
    bool is_known = false;
    for (const std::string& name : names) is_known = is_known || name == key;
    if (is_known) continue;
    std::string list;
    for (const std::string& name : names) list += (list.empty() ? "" : ", ") + name;
    throw InputError({document_->filename(), node.line}, path(key), "an unknown key", "one of " + list,
                     nearest_name(key, names));
  }
}

void Cursor::finish() const {
  for (const auto& [key, node] : node_->members) {
    if (asked_.count(key) != 0) continue;
    throw InputError({document_->filename(), node.line}, path(key), "a key that has no meaning here", "no such key",
                     nearest_name(key, asked_));
  }
}

bool Cursor::has(const std::string& key) const {
  return node_->member(key) != nullptr || document_->setting_under(path(key)) != nullptr;
}

std::vector<std::string> Cursor::keys() const {
  std::vector<std::string> names;
  for (const auto& entry : node_->members) names.push_back(entry.first);
  return names;
}

const Node* Cursor::member(const std::string& key) const {
  asked_.insert(key);
  return node_->member(key);
}

const Node& Cursor::required(const std::string& key, const std::string& expected) const {
  const Node* node = member(key);
  if (node == nullptr) throw InputError(origin(), path(key), "nothing", expected);
  return *node;
}

std::string Cursor::replaced(const std::string& text) const {
  if (copy_ == 0) return text;
  std::string result;
  for (std::size_t begin = 0;;) {
    const std::size_t place = text.find("{i}", begin);
    result.append(text, begin, place - begin);
    if (place == std::string::npos) return result;
    result += std::to_string(copy_);
    begin = place + 3;
  }
}

// --- single values ---------------------------------------------------------------------------------------------------

double Cursor::set_value(const Setting& set, const std::string& where, const SiUnit* unit) const {
  try {
    if (unit != nullptr) return parse_quantity(set.value, *unit);
    double value = 0.0;
    if (!parse_number(set.value, value)) throw ValueFault(in_quotes(set.value), expected_value(unit));
    return value;
  } catch (const ValueFault& fault) {
    throw InputError(origin_of(set), where, fault.found, fault.expected, fault.nearest);
  }
}

// One number out of a node; `unit` null: a pure number.
double Cursor::element(const Node& node, const std::string& where, const SiUnit* unit) const {
  const Origin here{document_->filename(), node.line};
  const bool is_number = node.kind == Node::Kind::integer || node.kind == Node::Kind::number;
  if (unit == nullptr) {
    if (!is_number || !std::isfinite(node.number)) throw InputError(here, where, shown(node), "a number");
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

double Cursor::quantity(const std::string& key, const SiUnit& unit) {
  const Node* node = member(key);
  if (const Setting* set = setting(path(key))) return set_value(*set, path(key), &unit);
  if (node == nullptr) throw InputError(origin(), path(key), "nothing", expected_value(&unit));
  return element(*node, path(key), &unit);
}

double Cursor::quantity(const std::string& key, const SiUnit& unit, double otherwise) {
  const bool given = member(key) != nullptr || setting(path(key)) != nullptr;
  return given ? quantity(key, unit) : otherwise;
}

double Cursor::number(const std::string& key) {
  const Node* node = member(key);
  if (const Setting* set = setting(path(key))) return set_value(*set, path(key), nullptr);
  if (node == nullptr) throw InputError(origin(), path(key), "nothing", expected_value(nullptr));
  return element(*node, path(key), nullptr);
}

double Cursor::number(const std::string& key, double otherwise) {
  const bool given = member(key) != nullptr || setting(path(key)) != nullptr;
  return given ? number(key) : otherwise;
}

long long Cursor::integer(const std::string& key) {
  if (const Setting* set = setting(path(key))) {
    member(key);
    const double value = set_value(*set, path(key), nullptr);
    require(value == std::floor(value) && std::abs(value) < 9e15, key, "a whole number");
    return static_cast<long long>(value);
  }
  const Node& node = required(key, "a whole number");
  require(node.kind == Node::Kind::integer, key, "a whole number");
  return node.integer;
}

long long Cursor::integer(const std::string& key, long long otherwise) {
  const bool given = member(key) != nullptr || setting(path(key)) != nullptr;
  return given ? integer(key) : otherwise;
}

bool Cursor::boolean(const std::string& key, bool otherwise) {
  const Node* node = member(key);
  if (const Setting* set = setting(path(key))) {
    require(set->value == "true" || set->value == "false", key, "true or false");
    return set->value == "true";
  }
  if (node == nullptr) return otherwise;
  require(node->kind == Node::Kind::boolean, key, "true or false");
  return node->boolean;
}

std::string Cursor::text(const std::string& key) {
  const Node* node = member(key);
  if (const Setting* set = setting(path(key))) return set->value;
  if (node == nullptr) throw InputError(origin(), path(key), "nothing", "a text in quotation marks");
  require(node->kind == Node::Kind::string, key, "a text in quotation marks");
  return replaced(node->text);
}

std::string Cursor::text(const std::string& key, const std::string& otherwise) {
  const bool given = member(key) != nullptr || setting(path(key)) != nullptr;
  return given ? text(key) : otherwise;
}

std::string Cursor::choice(const std::string& key, const std::vector<std::string>& choices,
                           const std::string& otherwise) {
  const std::string value = otherwise.empty() ? text(key) : text(key, otherwise);
  std::string list;
  for (const std::string& allowed : choices) {
    if (value == allowed) return value;
    list += (list.empty() ? "\"" : ", \"") + allowed + "\"";
  }
  fail_found(key, in_quotes(value), choices.size() == 1 ? list : "one of " + list, nearest_name(value, choices));
}

// --- lists, points and directions --------------------------------------------------------------------------------------

std::vector<double> Cursor::list(const std::string& key, const SiUnit* unit, const std::vector<std::string>& names,
                                 const std::vector<double>* otherwise) {
  std::vector<double> values;
  const Node* node = member(key);
  if (node == nullptr && otherwise == nullptr) required(key, "a list, each element " + expected_value(unit));
  if (node == nullptr) {
    values = *otherwise;
  } else {
    require(node->kind == Node::Kind::array, key, "a list, each element " + expected_value(unit));
    for (std::size_t k = 0; k < node->items.size(); ++k) {
      values.push_back(element(node->items[k], element_path(path(key), names, k), unit));
    }
  }
  if (const Setting* set = setting(path(key))) values.assign(values.size(), set_value(*set, path(key), unit));
  for (std::size_t k = 0; k < values.size(); ++k) {
    const std::string where = element_path(path(key), names, k);
    if (const Setting* set = setting(where)) values[k] = set_value(*set, where, unit);
  }
  return values;
}

std::vector<double> Cursor::quantities(const std::string& key, const SiUnit& unit,
                                       const std::vector<std::string>& names, const std::vector<double>* otherwise) {
  return list(key, &unit, names, otherwise);
}

std::vector<double> Cursor::numbers(const std::string& key, const std::vector<std::string>& names,
                                    const std::vector<double>* otherwise) {
  return list(key, nullptr, names, otherwise);
}

std::vector<std::string> Cursor::texts(const std::string& key, const std::vector<std::string>& names) {
  const Node& node = required(key, "a list of texts");
  require(node.kind == Node::Kind::array, key, "a list of texts");
  std::vector<std::string> values;
  for (std::size_t k = 0; k < node.items.size(); ++k) {
    const std::string where = element_path(path(key), names, k);
    if (const Setting* set = setting(where)) {
      values.push_back(set->value);
      continue;
    }
    const Node& item = node.items[k];
    if (item.kind != Node::Kind::string) {
      throw InputError({document_->filename(), item.line}, where, shown(item), "a text in quotation marks");
    }
    values.push_back(replaced(item.text));
  }
  return values;
}

Vec3 Cursor::point_of(const Node& node, const std::string& where, const SiUnit& unit) {
  if (node.kind != Node::Kind::array || node.items.size() != 3) {
    throw InputError({document_->filename(), node.line}, where, shown(node),
                     "a list of three, each " + expectation(unit));
  }
  Vec3 value;
  for (int k = 0; k < 3; ++k) value[k] = element(node.items[k], joined(where, kAxisNames[k]), &unit);
  value = (turn_ * value).eval();
  for (int k = 0; k < 3; ++k) {
    const std::string component = joined(where, kAxisNames[k]);
    if (const Setting* set = setting(component)) value[k] = set_value(*set, component, &unit);
  }
  if (!value.allFinite())
    throw InputError({document_->filename(), node.line}, where, "numbers too large", expectation(unit));
  return value;
}

Vec3 Cursor::vector(const std::string& key, const SiUnit& unit) {
  return point_of(required(key, "a list of three, each " + expectation(unit)), path(key), unit);
}

std::vector<Vec3> Cursor::points(const std::string& key, std::size_t count) {
  const std::string expected = "a list of " + std::to_string(count) + " points";
  const Node& node = required(key, expected);
  require(node.kind == Node::Kind::array && node.items.size() == count, key, expected);
  std::vector<Vec3> values;
  for (std::size_t k = 0; k < count; ++k) {
    values.push_back(point_of(node.items[k], joined(path(key), std::to_string(k + 1)), kLength));
  }
  return values;
}

Vec3 Cursor::direction(const std::string& key) {
  const std::string expected = "a direction: three numbers, not all zero";
  const Node& node = required(key, expected);
  require(node.kind == Node::Kind::array && node.items.size() == 3, key, expected);
  Vec3 value;
  for (int k = 0; k < 3; ++k) value[k] = element(node.items[k], joined(path(key), kAxisNames[k]), nullptr);
  value = (turn_ * value).eval();
  for (int k = 0; k < 3; ++k) {
    const std::string component = joined(path(key), kAxisNames[k]);
    if (const Setting* set = setting(component)) value[k] = set_value(*set, component, nullptr);
  }
  const double largest = value.cwiseAbs().maxCoeff();  // scaled first, so that neither 1e200 nor 1e-200 goes wrong
  if (!(largest > 1e-300) || !std::isfinite(largest)) fail_found(key, "three numbers without a direction", expected);
  return (value / largest).normalized();
}

// --- tables ----------------------------------------------------------------------------------------------------------

bool Cursor::is_table(const std::string& key) const {
  const Node* node = node_->member(key);
  return node != nullptr && node->kind == Node::Kind::table;
}

bool Cursor::is_list(const std::string& key) const {
  const Node* node = node_->member(key);
  return node != nullptr && node->kind == Node::Kind::array;
}

Cursor Cursor::table(const std::string& key) {
  const Node& node = required(key, "a table [" + path(key) + "]");
  require(node.kind == Node::Kind::table, key, "a table [" + path(key) + "]");
  return child(node, path(key));
}

Cursor Cursor::table_or_empty(const std::string& key) {
  if (member(key) != nullptr) return table(key);
  Cursor empty = child(kEmptyTable, path(key));
  empty.line_ = line_;
  return empty;
}

std::vector<Cursor> Cursor::tables(const std::string& key) {
  std::vector<Cursor> result;
  const Node* node = member(key);
  if (node == nullptr) return result;
  const std::string expected = "tables [[" + key + "]]";
  require(node->kind == Node::Kind::array, key, expected);
  for (std::size_t k = 0; k < node->items.size(); ++k) {
    const Node& item = node->items[k];
    if (item.kind != Node::Kind::table)
      throw InputError({document_->filename(), item.line}, path(key), shown(item), expected);
    result.push_back(child(item, path(key) + "[" + std::to_string(k + 1) + "]"));
  }
  return result;
}

}  // namespace boresight
