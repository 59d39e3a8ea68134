#include "reference/json_schema.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "reference/key_facts.hpp"
#include "reference/quantity_pattern.hpp"

namespace boresight::app {
namespace {

using Json = nlohmann::ordered_json;

Json quantity(const Key& key) { return {{"type", "string"}, {"pattern", quantity_pattern(key)}}; }

Json text_of(const Key& key) {
  Json schema = {{"type", "string"}};
  if (!key.filled_expected.empty()) schema["minLength"] = 1;
  return schema;
}

Json number(const Key& key, const char* type) {
  Json schema = {{"type", type}};
  if (!key.but_not.empty()) schema["not"] = {{"enum", key.but_not}};
  for (const KeyBound& bound : key.bounds) {
    if (std::isfinite(bound.least)) schema[bound.above ? "exclusiveMinimum" : "minimum"] = bound.least;
    if (std::isfinite(bound.most)) schema[bound.below ? "exclusiveMaximum" : "maximum"] = bound.most;
  }
  return schema;
}

// A direction, or coefficients that are not all zero.
Json some_not_zero(Json list) {
  list["contains"] = {{"not", {{"const", 0}}}};
  return list;
}

Json list(const Json& items, const std::vector<std::size_t>& counts) {
  Json schema = {{"type", "array"}, {"items", items}};
  if (counts.empty()) return schema;
  const std::size_t least = *std::min_element(counts.begin(), counts.end()),
                    most = *std::max_element(counts.begin(), counts.end());
  schema["minItems"] = least;
  schema["maxItems"] = most;
  // A list of three or six has no four.
  Json between = Json::array();
  for (std::size_t n = least + 1; n < most; ++n)
    if (std::find(counts.begin(), counts.end(), n) == counts.end())
      between.push_back({{"minItems", n}, {"maxItems", n}});
  if (!between.empty()) schema["not"] = {{"anyOf", between}};
  return schema;
}

Json list(const Json& items, const Key& key) {
  Json schema = list(items, key.counts);
  if (key.fewest > 0) schema["minItems"] = key.fewest;
  if (key.distinct) schema["uniqueItems"] = true;
  return key.not_all_zero ? some_not_zero(std::move(schema)) : schema;
}

Json words(const Key& key) {
  Json names = Json::array(), says = Json::array();
  for (const KeyChoice& choice : key.choices) {
    names.push_back(choice.name);
    says.push_back(choice.says);
  }
  Json schema = {{"enum", names}};
  const bool any =
      std::any_of(key.choices.begin(), key.choices.end(), [](const KeyChoice& c) { return !c.says.empty(); });
  if (any) schema["x-taplo"] = {{"docs", {{"enumValues", says}}}};
  return schema;
}

Json reference_to(const Key& key) {
  const KeyTable* inside = table_inside(key);
  if (inside == nullptr) return {{"type", "object"}};
  return {{"$ref", "#/definitions/" + inside->name}};
}

Json of_kind(const Key& key) {
  const Json text = text_of(key);
  switch (key.kind) {
    case KeyKind::quantity:
      if (!key.word.empty()) return {{"anyOf", {Json{{"const", key.word}}, quantity(key)}}};
      if (key.inside != nullptr) return {{"anyOf", {quantity(key), reference_to(key)}}};
      return quantity(key);
    case KeyKind::quantities:
      return list(quantity(key), key);
    case KeyKind::vector:
      return list(quantity(key), {3});
    case KeyKind::points:
      return list(list(quantity(key), {3}), key);
    case KeyKind::number:
      return number(key, "number");
    case KeyKind::numbers:
      return list(number(key, "number"), key);
    case KeyKind::direction: {
      const Json direction = some_not_zero(list({{"type", "number"}}, {3}));
      if (!key.text_form.empty()) return {{"anyOf", {direction, text}}};
      return direction;
    }
    case KeyKind::integer:
      return number(key, "integer");
    case KeyKind::value:
      return {{"anyOf", {number(key, "number"), quantity(key)}}};
    case KeyKind::values:
      return list({{"anyOf", {number(key, "number"), quantity(key)}}}, key);
    case KeyKind::boolean:
      return {{"type", "boolean"}};
    case KeyKind::text:
    case KeyKind::expression:
      return text;
    case KeyKind::texts:
    case KeyKind::expressions:
      if (key.or_one) return {{"anyOf", {text, list(text, key)}}};
      return list(text, key);
    case KeyKind::choice:
      return words(key);
    case KeyKind::choices:
      return list(words(key), key);
    case KeyKind::table:
      return {{"allOf", Json::array({reference_to(key)})}};  // beside a bare $ref editors read nothing
    case KeyKind::tables:
      return list(reference_to(key), key);
  }
  return {};
}

Json schema_of(const Key& key) {
  Json schema = of_kind(key);
  schema["description"] = key.sentence + " (" + facts_text(key) + ")";
  if (const std::string otherwise = default_text(key); !otherwise.empty()) schema["default"] = Json::parse(otherwise);
  return schema;
}

Json schema_of(const KeyTable& table) {
  Json schema = {{"type", "object"}, {"description", table.says}};
  if (table.any_name) {
    schema["additionalProperties"] = schema_of(table.keys.front());
    return schema;
  }
  Json properties = Json::object(), required = Json::array();
  for (const Key& key : table.keys) {
    properties[key.name] = schema_of(key);
    if (key.presence == Key::Presence::required) required.push_back(key.name);
  }
  schema["properties"] = properties;
  if (!required.empty()) schema["required"] = required;
  schema["additionalProperties"] = false;
  if (table.fewest > 0) schema["minProperties"] = table.fewest;
  if (!table.one_of.empty()) {
    Json each = Json::array();
    for (const std::string& name : table.one_of) each.push_back({{"required", {name}}});
    schema["oneOf"] = each;
  }
  return schema;
}

}  // namespace

Json json_schema(const std::string& file) {
  Json schema = {{"$schema", "http://json-schema.org/draft-07/schema#"}, {"title", "Boresight " + file + " file"}};
  Json definitions = Json::object();
  bool known = false;
  for (const Section& section : sections()) {
    if (section.file != file) continue;
    if (section.path().empty()) {
      known = true;
      schema.update(schema_of(*section.keys));
    } else {
      definitions[section.keys->name] = schema_of(*section.keys);
    }
  }
  if (!known) throw std::out_of_range("no files are called " + file);
  schema["definitions"] = definitions;
  return schema;
}

}  // namespace boresight::app
