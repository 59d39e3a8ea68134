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
    const bool name = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
                      c == '-' || c == '"' || c == '\'' || (static_cast<unsigned char>(c) & 0x80) != 0;
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

// Outside strings and comments TOML knows ASCII alone; toml++ asks of other letters there whether they are blanks, and for most has said to
// the compiler that it never will.
void refuse_letters_outside_strings(std::string_view text, const std::string& filename) {
  const auto is_at = [&](std::size_t i, std::string_view what) { return text.substr(i, what.size()) == what; };
  if (is_at(0, "\xFF\xFE") || is_at(0, "\xFE\xFF"))
    throw InputError({filename, 1}, "", "a text in UTF-16", "one in UTF-8: save it as that");
  int line = 1;
  std::string_view closing;  // of the string or comment in which `i` stands
  for (std::size_t i = is_at(0, "\xEF\xBB\xBF") ? 3 : 0; i < text.size(); ++i) {
    const char c = text[i];
    if (closing.empty()) {
      for (const std::string_view quotes : {"\"\"\"", "\'\'\'", "\"", "\'"})
        if (closing.empty() && is_at(i, quotes)) closing = quotes;
      if (!closing.empty()) {
        i += closing.size() - 1;
      } else if (c == '#') {
        closing = "\n";
      } else if ((static_cast<unsigned char>(c) & 0x80) != 0) {
        throw InputError({filename, line}, "", "a letter beyond ASCII outside quotation marks",
                         "it inside them, or none");
      }
    } else if (c == '\\' && closing.front() == '"') {
      ++i;  // what is escaped ends nothing
      if (i < text.size() && text[i] == '\n') ++line;
      continue;
    } else if (is_at(i, closing)) {
      i += closing.size() - 1;
      for (int more = 0; closing.size() == 3 && more < 2 && is_at(i + 1, closing.substr(0, 1)); ++more)
        ++i;  // """a string that ends in quotes"""""
      closing = {};
    } else if (c == '\n' && closing.size() == 1) {
      closing = {};  // a string that its line does not close: toml++ says so
    }
    if (c == '\n') ++line;
  }
}

}  // namespace

Node parse_toml(std::string_view text, const std::string& filename) {
  refuse_deep_keys(text, filename);
  refuse_letters_outside_strings(text, filename);
  try {
    return convert(toml::parse(text, filename));
  } catch (const toml::parse_error& error) {
    throw InputError({filename, static_cast<int>(error.source().begin.line)}, "",
                     "a fault in the TOML (" + std::string(error.description()) + ")", "TOML 1.0");
  }
}

}  // namespace boresight
