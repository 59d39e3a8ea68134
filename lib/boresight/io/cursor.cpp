#include "boresight/io/cursor.hpp"

#include <algorithm>
#include <stdexcept>

#include "boresight/io/cursor_texts.hpp"
#include "boresight/mechanism/error.hpp"

namespace boresight {

using namespace cursor;

namespace {

const Node kEmptyTable;

std::string listed(const std::vector<std::string>& names) {
  std::string list;
  for (const std::string& name : names) list += (list.empty() ? "" : ", ") + name;
  return list;
}

}  // namespace

Cursor::Cursor(Document& document) : Cursor(document, document.root(), "") {}

Cursor::Cursor(Document& document, const Node& node, std::string path)
    : document_(&document), node_(&node), line_(node.line), path_(std::move(path)) {}

Cursor Cursor::child(const Node& node, std::string path) const {
  Cursor result(*document_, node, std::move(path));
  result.made_ = made_;
  result.copy_ = copy_;
  result.turn_ = turn_;
  return result;
}

Cursor Cursor::standing_for(Node table, std::string path) const {
  const auto made = std::make_shared<const Node>(std::move(table));
  Cursor result = child(*made, std::move(path));
  result.made_ = made;
  result.line_ = line_;
  result.turn_ = Mat3::Identity();
  return result;
}

Cursor Cursor::copy(int number, const Mat3& turn) const {
  Cursor result = *this;
  result.copy_ = number;
  result.turn_ = turn;
  return result;
}

// --- keys, paths and faults ------------------------------------------------------------------------------------------

std::string Cursor::path(const std::string& key) const {
  return !own_key_.empty() && key == own_key_ ? path_ : joined(path_, key);
}

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

void Cursor::only(const KeyTable& known) {
  keys_ = &known;
  if (node_->members.size() < known.fewest && document_->setting_under(path_) == nullptr)
    throw InputError(origin(), path(), node_->members.empty() ? "an empty table" : "too few keys",
                     known.fewest_expected);
  if (known.any_name) return;
  const std::vector<std::string> names = known.names();
  for (const auto& [key, node] : node_->members) {
    if (std::find(names.begin(), names.end(), key) != names.end()) continue;
    throw InputError({document_->filename(), node.line}, path(key), "an unknown key", "one of " + listed(names),
                     nearest_name(key, names));
  }
  if (!known.one_of.empty()) the_one();
}

std::string Cursor::the_one() const {
  std::string found;
  for (const std::string& name : keys_->one_of) {
    if (!has(name)) continue;
    if (!found.empty()) fail_found(name, found + " and " + name, "one " + keys_->one_of_what);
    found = name;
  }
  if (found.empty()) throw InputError(origin(), path(), "no " + keys_->one_of_what, "one of " + listed(keys_->one_of));
  return found;
}

void Cursor::finish() const {
  if (keys_ == nullptr) throw std::logic_error("the table " + path_ + " is read without a table of its keys");
  for (const auto& [key, node] : node_->members) {
    if (asked_.count(key) != 0) continue;
    throw InputError({document_->filename(), node.line}, path(key), "a key that has no meaning here",
                     "this table without it", nearest_name(key, asked_));
  }
}

const Key& Cursor::known(const std::string& key, std::initializer_list<KeyKind> kinds) const {
  if (keys_ == nullptr) throw std::logic_error("the table " + path_ + " is read without a table of its keys");
  const Key* found = keys_->find(key);
  if (found == nullptr) throw std::logic_error("the keys of " + keys_->name + " lack " + key + ", which is read");
  const bool holds_tables =
      found->inside != nullptr && *kinds.begin() == KeyKind::table;  // where a quantity may be a table too
  if (!holds_tables && std::find(kinds.begin(), kinds.end(), found->kind) == kinds.end())
    throw std::logic_error("the keys of " + keys_->name + " have " + key + " as " + kind_text(*found) +
                           ", and it is read as another kind");
  return *found;
}

bool Cursor::has(const std::string& key) const {
  if (keys_ != nullptr && keys_->find(key) == nullptr)
    throw std::logic_error("the keys of " + keys_->name + " lack " + key + ", which is looked for");
  return node_->member(key) != nullptr || document_->setting_under(path(key)) != nullptr;
}

bool Cursor::has_by_name(const std::string& key) const {
  return node_->member(key) != nullptr || document_->setting_under(path(key), false) != nullptr;
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
  if (node == nullptr) throw InputError(origin(key), path(key), "nothing", expected);
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

// --- tables ----------------------------------------------------------------------------------------------------------

bool Cursor::is_table(const std::string& key) const {
  const Node* node = node_->member(key);
  return node != nullptr && node->kind == Node::Kind::table;
}

bool Cursor::is_list(const std::string& key) const {
  const Node* node = node_->member(key);
  return node != nullptr && node->kind == Node::Kind::array;
}

bool Cursor::is_text(const std::string& key) const {
  const Node* node = node_->member(key);
  return node != nullptr && node->kind == Node::Kind::string;
}

bool Cursor::is_number(const std::string& key) const {
  if (const Setting* set = setting(path(key))) {
    double number = 0.0;
    return parse_number(set->value, number);
  }
  const Node* node = node_->member(key);
  return node != nullptr && (node->kind == Node::Kind::number || node->kind == Node::Kind::integer);
}

Cursor Cursor::table(const std::string& key) {
  if (keys_ != nullptr) known(key, {KeyKind::table});
  const Node& node = required(key, "a table [" + path(key) + "]");
  require(node.kind == Node::Kind::table, key, "a table [" + path(key) + "]");
  return child(node, path(key));
}

Cursor Cursor::table_or_empty(const std::string& key) {
  if (keys_ != nullptr) known(key, {KeyKind::table});
  if (member(key) != nullptr) return table(key);
  Cursor empty = child(kEmptyTable, path(key));
  empty.line_ = line_;
  return empty;
}

std::vector<Cursor> Cursor::tables(const std::string& key) {
  const Key* of_table = keys_ != nullptr ? &known(key, {KeyKind::tables}) : nullptr;
  std::vector<Cursor> result;
  const Node* node = member(key);
  if (of_table != nullptr && (node != nullptr || of_table->presence == Key::Presence::required))
    require(of_table->fewest == 0 ||
                (node != nullptr && (node->kind != Node::Kind::array || node->items.size() >= of_table->fewest)),
            key, of_table->fewest_expected);
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
