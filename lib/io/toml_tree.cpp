#include "boresight/io/toml_tree.hpp"

// toml++ asserts (and lets Clang assume) what a damaged file breaks, `a = [ } ]`; its own error paths answer for that.
#undef NDEBUG
#define TOML_ASSERT(expr) static_assert(true)
#include <toml++/toml.h>

#include <algorithm>
#include <sstream>

#include "boresight/mechanism/error.hpp"

namespace boresight {
namespace {

int line_of(const toml::node& node) { return static_cast<int>(node.source().begin.line); }

template <typename T>
std::string printed(const T& value) {
  std::ostringstream out;
  out << value;
  return out.str();
}

Node convert(const toml::node& node) {
  Node result;
  result.line = line_of(node);
  if (const auto* table = node.as_table()) {
    result.kind = Node::Kind::table;
    for (const auto& [key, value] : *table) {
      result.members.emplace_back(std::string(key.str()), convert(value));
      // A table that exists only as the parent of others ([a.b]) has no line of its own.
      Node& added = result.members.back().second;
      if (added.line == 0) added.line = static_cast<int>(key.source().begin.line);
    }
    std::stable_sort(result.members.begin(), result.members.end(),
                     [](const auto& a, const auto& b) { return a.second.line < b.second.line; });
  } else if (const auto* array = node.as_array()) {
    result.kind = Node::Kind::array;
    for (const toml::node& item : *array) result.items.push_back(convert(item));
  } else if (const auto* string = node.as_string()) {
    result.kind = Node::Kind::string;
    result.text = string->get();
  } else if (const auto* integer = node.as_integer()) {
    result.kind = Node::Kind::integer;
    result.integer = integer->get();
    result.number = static_cast<double>(result.integer);
    result.text = std::to_string(result.integer);
  } else if (const auto* number = node.as_floating_point()) {
    result.kind = Node::Kind::number;
    result.number = number->get();
    result.text = printed(result.number);
  } else if (const auto* boolean = node.as_boolean()) {
    result.kind = Node::Kind::boolean;
    result.boolean = boolean->get();
    result.text = result.boolean ? "true" : "false";
  } else {
    result.kind = Node::Kind::date;
    result.text = "a date or time";
  }
  return result;
}

// The library bounds the depth of nested values but not of dotted keys, and frees what it built by recursion: a key of a
// million dots would exhaust the stack. More than this many dots with only key characters between them is refused.
constexpr int kMostDots = 64;

void refuse_deep_keys(std::string_view text, const std::string& filename) {
  int dots = 0, line = 1;
  bool after_name = false;
  for (const char c : text) {
    if (c == '\n') ++line;
    const bool name = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-' ||
                      c == '"' || c == '\'' || (static_cast<unsigned char>(c) & 0x80) != 0;
    if (name) {
      after_name = true;
    } else if (c == '.') {
      if (after_name && ++dots > kMostDots) {
        throw InputError({filename, line}, "", "a key of more than " + std::to_string(kMostDots) + " parts",
                         "a shorter key");
      }
      after_name = false;
    } else if (c != ' ' && c != '\t') {
      dots = 0;
      after_name = false;
    }
  }
}

}  // namespace

Node parse_toml(std::string_view text, const std::string& filename) {
  refuse_deep_keys(text, filename);
  try {
    return convert(toml::parse(text, filename));
  } catch (const toml::parse_error& error) {
    throw InputError({filename, static_cast<int>(error.source().begin.line)}, "",
                     "a fault in the TOML (" + std::string(error.description()) + ")", "TOML 1.0");
  }
}

}  // namespace boresight
