// Lists, points and directions of a table.
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "boresight/io/cursor.hpp"
#include "boresight/io/cursor_texts.hpp"
#include "boresight/mechanism/error.hpp"

namespace boresight {

using namespace cursor;

namespace {

const std::vector<std::string> kAxisNames = {"x", "y", "z"};

}  // namespace

std::vector<double> Cursor::list(const std::string& name, const Key& key, const SiUnit* unit) {
  const bool has_default = key.presence == Key::Presence::has_default;
  std::vector<double> read;
  const Node* node = member(name);
  if (node == nullptr && !has_default) required(name, "a list, each element " + expected_value(unit));
  if (node == nullptr) {
    read = key.list_otherwise;
  } else {
    require(node->kind == Node::Kind::array, name, "a list, each element " + expected_value(unit));
    for (std::size_t k = 0; k < node->items.size(); ++k) {
      read.push_back(element(node->items[k], element_path(path(name), key.elements, k), unit));
    }
  }
  // The last one given wins, of all or of one.
  const Setting* of_all = setting(path(name));
  if (of_all) read.assign(read.size(), set_value(*of_all, path(name), unit));
  for (std::size_t k = 0; k < read.size(); ++k) {
    const std::string where = element_path(path(name), key.elements, k);
    if (const Setting* set = setting(where); set && (!of_all || set > of_all)) read[k] = set_value(*set, where, unit);
  }
  for (const double x : read)
    if (!holds(key.range, x)) fail(name, in_words(key.range));
  if (!key.counts.empty())
    require(std::find(key.counts.begin(), key.counts.end(), read.size()) != key.counts.end(), name, key.list_expected);
  require(read.size() >= key.fewest, name, key.fewest_expected);
  for (const KeyBound& bound : key.bounds)
    for (const double x : read) require(bound.holds(x), name, bound.expected);
  if (key.not_all_zero)
    require(std::any_of(read.begin(), read.end(), [](double x) { return x != 0.0; }), name,
            "a coefficient that is not zero");
  return read;
}

std::vector<double> Cursor::quantities(const std::string& name) {
  const Key& key = known(name, {KeyKind::quantities});
  return list(name, key, &key.range.unit);
}

std::vector<double> Cursor::values(const std::string& name, const SiUnit& unit) {
  return list(name, known(name, {KeyKind::values}), std::string(unit.unit) == "1" ? nullptr : &unit);
}

std::vector<double> Cursor::numbers(const std::string& name) {
  return list(name, known(name, {KeyKind::numbers}), nullptr);
}

std::vector<std::string> Cursor::words(const std::string& key, const std::vector<std::string>& elements) {
  const Node& node = required(key, "a list of texts");
  require(node.kind == Node::Kind::array, key, "a list of texts");
  std::vector<std::string> read;
  for (std::size_t k = 0; k < node.items.size(); ++k) {
    const std::string where = element_path(path(key), elements, k);
    if (const Setting* set = setting(where)) {
      read.push_back(set->value);
      continue;
    }
    const Node& item = node.items[k];
    if (item.kind != Node::Kind::string) {
      throw InputError({document_->filename(), item.line}, where, shown(item), "a text in quotation marks");
    }
    read.push_back(replaced(item.text));
  }
  return read;
}

std::vector<std::string> Cursor::texts(const std::string& name) {
  const Key& key = known(name, {KeyKind::texts, KeyKind::expressions});
  const std::vector<std::string> read = words(name, key.elements);
  if (!key.counts.empty())
    require(std::find(key.counts.begin(), key.counts.end(), read.size()) != key.counts.end(), name, key.list_expected);
  require(read.size() >= key.fewest, name, key.fewest_expected);
  return read;
}

std::vector<std::string> Cursor::choices(const std::string& name) {
  const Key& key = known(name, {KeyKind::choices});
  const std::vector<std::string> read = words(name, key.elements);
  std::vector<std::string> choices;
  for (const KeyChoice& allowed : key.choices) choices.push_back(allowed.name);
  for (const std::string& x : read)
    if (std::find(choices.begin(), choices.end(), x) == choices.end())
      fail_found(name, in_quotes(x), key.list_expected, nearest_name(x, choices));
  require(read.size() >= key.fewest, name, key.fewest_expected);
  return read;
}

std::vector<std::string> Cursor::one_or_texts(const std::string& name) {
  known(name, {KeyKind::texts});
  return is_list(name) ? texts(name) : std::vector<std::string>{text(name)};
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

Vec3 Cursor::vector(const std::string& name) {
  const Key& key = known(name, {KeyKind::vector});
  const Vec3 read =
      point_of(required(name, "a list of three, each " + expectation(key.range.unit)), path(name), key.range.unit);
  for (const double component : read) check(key, name, component);
  return read;
}

std::vector<Vec3> Cursor::points(const std::string& name) {
  const Key& key = known(name, {KeyKind::points});
  const std::size_t count = key.counts.front();
  const Node& node = required(name, key.list_expected);
  require(node.kind == Node::Kind::array && node.items.size() == count, name, key.list_expected);
  std::vector<Vec3> read;
  for (std::size_t k = 0; k < count; ++k)
    read.push_back(point_of(node.items[k], joined(path(name), std::to_string(k + 1)), key.range.unit));
  for (const Vec3& point : read)
    for (const double component : point) check(key, name, component);
  return read;
}

Vec3 Cursor::direction(const std::string& key) {
  known(key, {KeyKind::direction});
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

}  // namespace boresight
