// Reads one table of a TOML file, key by key, as its table of keys (key.hpp) says, and refuses what that does not know: the reader of
// mechanism and study files.
//
//   Cursor root(document);
//   root.only(study_keys());                    // any other key: an error with the nearest of these
//   const double accuracy = root.quantity("accuracy");
//   Cursor index = root.table("index");
//   index.only(index_keys());
//   ...
//   index.finish();                             // a key that was given but never read: an error
//   root.finish();
//   document.refuse_unused_settings();
//
// Every fault is an InputError with file, line, path, what was found and what was expected. Unit, default and range of a value are
// those of the table of keys; none is ever NaN or infinite. A key that the table lacks, or has as another kind, is a fault of the
// reader itself: std::logic_error. Settings apply to every value by its path; vector components are addressed as `.x .y .z`.
//
// Inside a circular pattern a cursor carries the copy's number, put in place of {i} in every string, and the copy's turn,
// applied to every point and direction.
#pragma once

#include <initializer_list>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "boresight/io/document.hpp"
#include "boresight/keys/key.hpp"
#include "boresight/keys/units.hpp"
#include "boresight/math/types.hpp"

namespace boresight {

class Cursor {
 public:
  explicit Cursor(Document& document);

  // From here on this table says what may be read; any key of the file that it lacks is refused at once, and so is too little of what it asks for.
  void only(const KeyTable& keys);
  // Of the keys of which exactly one stands in such a table, the one that does.
  std::string the_one() const;
  // Refuses keys that were given but not read since.
  void finish() const;

  bool has(const std::string& key) const;  // in the file, or set
  // The table is that of an error of this name.
  void name_error(const std::string& name) { document_->name_error(name); }
  // In the file, or set by its own name: what is refused where it has no meaning. "clearance.*.axial" means the joints that have one.
  bool has_by_name(const std::string& key) const;
  std::vector<std::string> keys() const;  // in the order of the file

  // A key without a default must be there. `otherwise` is the value of a key whose default depends on others.
  double quantity(const std::string& key);
  double quantity(const std::string& key, double otherwise);
  // Where another key decides the unit. value(): of the unit "1" a pure number.
  double quantity(const std::string& key, const PhysicalRange& range);
  double quantity(const std::string& key, const SiUnit& unit);
  double value(const std::string& key, const SiUnit& unit);
  // In which unit a quantity that was read is written, or the first of a list of them: "arcsec"; "" for a pure number. What is shown of it
  // is shown in that one.
  std::string unit_as_written(const std::string& key);
  // Where a word may stand in place of the quantity: none for the word.
  std::optional<double> quantity_or_word(const std::string& key);
  double number(const std::string& key);
  double number(const std::string& key, double otherwise);
  long long integer(const std::string& key);
  long long integer(const std::string& key, long long otherwise);
  bool boolean(const std::string& key);
  std::string text(const std::string& key);
  std::string text(const std::string& key, const std::string& otherwise);
  std::string choice(const std::string& key);
  // Of the table's words only these; without the key, `otherwise`.
  std::string choice(const std::string& key, const std::vector<std::string>& choices, const std::string& otherwise);

  // Lists. Element k is also addressed as PATH.ELEMENT with the table's names, or PATH.k (from 1) without.
  // A setting of PATH itself gives all elements one value.
  std::vector<double> quantities(const std::string& key);
  std::vector<double> values(const std::string& key, const SiUnit& unit);
  std::vector<double> numbers(const std::string& key);
  std::vector<std::string> texts(const std::string& key);
  std::vector<std::string> choices(const std::string& key);
  // Where one text may stand without the list.
  std::vector<std::string> one_or_texts(const std::string& key);

  // Three components in world axes, turned with the copy of a pattern.
  Vec3 vector(const std::string& key);
  std::vector<Vec3> points(const std::string& key);
  // Three pure numbers, not all zero, made a unit vector and turned.
  Vec3 direction(const std::string& key);

  bool is_table(const std::string& key) const;
  bool is_list(const std::string& key) const;
  bool is_text(const std::string& key) const;
  bool is_number(const std::string& key) const;        // without a unit, a setting included
  Cursor table(const std::string& key);                // must be there
  Cursor table_or_empty(const std::string& key);       // an empty one if it is not there
  std::vector<Cursor> tables(const std::string& key);  // [[key]]: any number of them

  // Where this table, or the value of this key (a setting included), stands; and the key's full path.
  Origin origin() const { return {document_->filename(), line_}; }
  Origin origin(const std::string& key) const;
  std::string path(const std::string& key) const;
  const std::string& path() const { return path_; }
  void rename(std::string path) { path_ = std::move(path); }  // "body[2]" becomes "body.rod1" once the name is known
  // The value of this key goes by the table's own path: "error.F1.squareness", not "error.F1.squareness.value".
  void stands_for_table(std::string key) { own_key_ = std::move(key); }

  // The value as found, for error texts.
  std::string found(const std::string& key) const;
  [[noreturn]] void fail(const std::string& key, const std::string& expected, const std::string& nearest = "") const;
  [[noreturn]] void fail_found(const std::string& key, const std::string& found, const std::string& expected,
                               const std::string& nearest = "") const;
  // Throws with `expected` unless the condition holds.
  void require(bool condition, const std::string& key, const std::string& expected) const;

  // The same table as copy `number` of a pattern, everything turned by `turn`.
  Cursor copy(int number, const Mat3& turn) const;
  const Mat3& turn() const { return turn_; }

  // What the file says here, as a tree.
  const Node& node() const { return *node_; }
  // A table that this one stands for, read at this line under another path. It has the copy's number, but is not turned.
  Cursor standing_for(Node table, std::string path) const;

 private:
  Cursor(Document& document, const Node& node, std::string path);
  const Key& known(const std::string& key, std::initializer_list<KeyKind> kinds) const;  // throws std::logic_error
  bool given(const std::string& key) const;
  void check(const Key& key, const std::string& name, double value) const;  // range and bounds
  const Node* member(const std::string& key) const;                         // and remembers that it was asked for
  const Node& required(const std::string& key, const std::string& expected) const;
  std::string replaced(const std::string& text) const;  // {i}
  const Setting* setting(const std::string& path) const { return document_->setting_for(path); }
  const Setting* blamed_setting(const std::string& key) const;
  Cursor child(const Node& node, std::string path) const;
  double one(const std::string& key, const SiUnit* unit);
  long long whole(const Key& key, const std::string& name);
  std::string word(const std::string& key);
  std::string text_of(const Key& key, const std::string& name);  // and refuses an empty one where none may be
  std::string chosen(const std::string& key, const std::string& value, const std::vector<std::string>& choices) const;
  std::vector<double> list(const std::string& name, const Key& key, const SiUnit* unit);
  std::vector<std::string> words(const std::string& key, const std::vector<std::string>& elements);
  Vec3 point_of(const Node& node, const std::string& key, const SiUnit& unit);
  double element(const Node& node, const std::string& key, const SiUnit* unit) const;
  double set_value(const Setting& setting, const std::string& path, const SiUnit* unit) const;

  Document* document_;
  const Node* node_;
  std::shared_ptr<const Node> made_;  // holds node_, or what is around it, where that is not the document's
  int line_;
  std::string path_, own_key_;
  const KeyTable* keys_ = nullptr;  // null: not said yet
  mutable std::set<std::string> asked_;
  int copy_ = 0;  // 0: not in a pattern
  Mat3 turn_ = Mat3::Identity();
};

}  // namespace boresight
