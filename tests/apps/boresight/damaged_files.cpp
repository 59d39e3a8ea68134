#include "damaged_files.hpp"

#include <cmath>
#include <cstdio>
#include <regex>

namespace boresight::app {
namespace {

Node text_node(const std::string& text) {
  Node node;
  node.kind = Node::Kind::string;
  node.text = text;
  return node;
}

Node number_node(double value) {
  Node node;
  node.kind = Node::Kind::number;
  node.number = value;
  return node;
}

Node integer_node(long long value) {
  Node node;
  node.kind = Node::Kind::integer;
  node.integer = value;
  node.number = static_cast<double>(value);
  return node;
}

Node boolean_node() {
  Node node;
  node.kind = Node::Kind::boolean;
  node.boolean = true;
  return node;
}

Node list_of(std::vector<Node> items) {
  Node node;
  node.kind = Node::Kind::array;
  node.items = std::move(items);
  return node;
}

struct Replacement {
  Node with;
  std::string what;
  bool by_itself = false;
};

std::vector<Replacement> of_text(const std::string& text) {
  std::vector<Replacement> all = {{boolean_node(), "true in place of a text", true},
                                  {text_node(""), "an empty text"},
                                  {text_node("\x7fno word"), "a text that means nothing"},
                                  {list_of({text_node(text)}), "a list of a text"},
                                  {Node(), "a table in place of a text"}};
  static const std::regex quantity("([-+]?)([0-9.]+)([eE][-+]?[0-9]+)?( *[^-+ 0-9.].*)");
  std::smatch parts;
  if (!std::regex_match(text, parts, quantity)) {
    all.push_back({number_node(1.5), "a number in place of a text", true});
    return all;
  }
  const std::string unit = parts[4], size = parts[2].str() + parts[3].str();
  all.push_back({number_node(std::strtod(size.c_str(), nullptr)), "a number without its unit"});
  all.push_back({text_node(size), "a number without its unit, as text"});
  all.push_back({text_node("-" + size + unit), "another sign"});
  all.push_back({text_node("0" + unit), "zero"});
  all.push_back({text_node("-0" + unit), "minus zero"});
  all.push_back({text_node("1e300" + unit), "a huge size"});
  all.push_back({text_node("1e-300" + unit), "a tiny size"});
  all.push_back({text_node(size + " furlongs of it"), "an unknown unit"});
  return all;
}

std::vector<Replacement> of_number(const Node& node) {
  std::vector<Replacement> all = {{text_node("some"), "a text in place of a number", true},
                                  {text_node(std::to_string(node.number)), "the number as a text"},
                                  {boolean_node(), "true in place of a number", true},
                                  {list_of({node}), "a list of a number"}};
  const bool whole = node.kind == Node::Kind::integer;
  for (const double value : {-node.number, 0.0, 1.0, 2.0, 3.0, 1e4, 1e9}) {
    if (value == node.number) continue;
    char what[40];
    std::snprintf(what, sizeof what, "%g in place of a number", value);
    all.push_back({whole ? integer_node(static_cast<long long>(value)) : number_node(value), what});
  }
  all.push_back({number_node(node.number + 0.5), "half more"});
  return all;
}

std::vector<Replacement> of_list(const Node& node) {
  std::vector<Replacement> all = {{list_of({}), "an empty list"},
                                  {text_node("some"), "a text in place of a list"},
                                  {number_node(1.5), "a number in place of a list"}};
  if (node.items.empty()) return all;
  Node shorter = node, longer = node;
  shorter.items.pop_back();
  longer.items.push_back(node.items.back());
  all.push_back({shorter, "a list without its last element"});
  all.push_back({longer, "a list with its last element twice"});
  all.push_back({node.items.front(), "an element in place of its list"});
  return all;
}

std::vector<Replacement> of_table(const Node& node) {
  Node more = node;
  more.members.emplace_back("no_such_key", integer_node(1));
  return {{Node(), "an empty table"},
          {text_node("some"), "a text in place of a table"},
          {list_of({node}), "a list of a table"},
          {more, "a further key"}};
}

std::vector<Replacement> replacements_of(const Node& node) {
  switch (node.kind) {
    case Node::Kind::string:
    case Node::Kind::date:
      return of_text(node.text);
    case Node::Kind::integer:
    case Node::Kind::number:
      return of_number(node);
    case Node::Kind::boolean:
      return {{text_node("yes"), "a text in place of true or false", true},
              {integer_node(1), "a number in place of true or false", true}};
    case Node::Kind::array:
      return of_list(node);
    case Node::Kind::table:
      return of_table(node);
  }
  return {};
}

void damage(Node& here, const std::string& path, const std::function<void(const Damage&)>& judge) {
  const Node whole = here;
  for (const Replacement& replacement : replacements_of(whole)) {
    here = replacement.with;
    judge({path, replacement.what, replacement.by_itself});
  }
  here = whole;
  for (std::size_t k = 0; k < here.members.size(); ++k) {
    here.members.erase(here.members.begin() + static_cast<std::ptrdiff_t>(k));
    const std::string inside = (path.empty() ? "" : path + ".") + whole.members[k].first;
    judge({inside, "left out"});
    here = whole;
    damage(here.members[k].second, inside, judge);
  }
  for (Node& item : here.items) damage(item, path + "[]", judge);
}

std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    char escaped[8];
    std::snprintf(escaped, sizeof escaped, "\\u%04x", static_cast<unsigned char>(c));
    const bool control = static_cast<unsigned char>(c) < 0x20 || c == 0x7f;
    out += control || c == '"' || c == '\\' ? std::string(escaped) : std::string(1, c);
  }
  return out + "\"";
}

std::string value_of(const Node& node) {
  char number[40];
  std::string out;
  switch (node.kind) {
    case Node::Kind::string:
      return quoted(node.text);
    case Node::Kind::date:
      return node.text;
    case Node::Kind::integer:
      return std::to_string(node.integer);
    case Node::Kind::boolean:
      return node.boolean ? "true" : "false";
    case Node::Kind::number:
      std::snprintf(number, sizeof number, "%.17e", node.number);  // with a point: no whole number
      return number;
    case Node::Kind::array:
      for (const Node& item : node.items) out += (out.empty() ? "" : ", ") + value_of(item);
      return "[" + out + "]";
    case Node::Kind::table:
      for (const auto& [key, member] : node.members)
        out += (out.empty() ? "" : ", ") + quoted(key) + " = " + value_of(member);
      return "{" + out + "}";
  }
  return "";
}

}  // namespace

void for_each_damage(Node root, const std::function<void(const Damage&, const Node& damaged)>& judge) {
  damage(root, "", [&](const Damage& made) {
    if (root.kind == Node::Kind::table) judge(made, root);  // a file is a table
  });
}

std::string toml_of(const Node& root) {
  std::string out;
  for (const auto& [key, member] : root.members) out += quoted(key) + " = " + value_of(member) + "\n";
  return out;
}

}  // namespace boresight::app
