// Reads one table of a TOML file, key by key, and refuses what it does not expect: the reader of mechanism and study files.
//
//   Cursor root(document);
//   root.only({"format", "accuracy", "index"});            // any other key: an error with the nearest of these
//   const double accuracy = root.quantity("accuracy", kRatio, 0.01);
//   Cursor index = root.table("index");
//   ...
//   index.finish();                                        // a key that was given but never read: an error
//   root.finish();
//   document.refuse_unused_settings();
//
// Every fault is an InputError with file, line, path, what was found and what was expected. Values come with their unit
// (`quantity`) or are pure numbers (`number`); none is ever NaN or infinite. Settings apply to every value by its path; vector
// components are addressed as `.x .y .z`.
//
// Inside a circular pattern a cursor carries the copy's number, put in place of {i} in every string, and the copy's turn,
// applied to every point and direction.
#pragma once

#include <initializer_list>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "boresight/io/document.hpp"
#include "boresight/io/units.hpp"
#include "boresight/math/types.hpp"

namespace boresight {

class Cursor {
 public:
  explicit Cursor(Document& document);

  // Refuses at once any key that is not among these.
  void only(std::initializer_list<const char*> keys) const;
  // Refuses keys that were given but not read since.
  void finish() const;

  bool has(const std::string& key) const;  // in the file, or set
  std::vector<std::string> keys() const;   // in the order of the file

  // Without a last argument the key must be there; with one, that is the value if it is not.
  double quantity(const std::string& key, const SiUnit& unit);
  double quantity(const std::string& key, const SiUnit& unit, double otherwise);
  double number(const std::string& key);
  double number(const std::string& key, double otherwise);
  long long integer(const std::string& key);
  long long integer(const std::string& key, long long otherwise);
  bool boolean(const std::string& key, bool otherwise);
  std::string text(const std::string& key);
  std::string text(const std::string& key, const std::string& otherwise);
  // A text that must be one of these.
  std::string choice(const std::string& key, const std::vector<std::string>& choices,
                     const std::string& otherwise = "");

  // Lists. Element k is also addressed as PATH.NAMES[k], or PATH.k (from 1) without names.
  // A setting of PATH itself gives all elements one value. `otherwise` is the list if the key is not there.
  std::vector<double> quantities(const std::string& key, const SiUnit& unit, const std::vector<std::string>& names = {},
                                 const std::vector<double>* otherwise = nullptr);
  std::vector<double> numbers(const std::string& key, const std::vector<std::string>& names = {},
                              const std::vector<double>* otherwise = nullptr);
  std::vector<std::string> texts(const std::string& key, const std::vector<std::string>& names = {});

  // Three components in world axes, turned with the copy of a pattern.
  Vec3 vector(const std::string& key, const SiUnit& unit);
  std::vector<Vec3> points(const std::string& key, std::size_t count);  // a list of points [m]
  // Three pure numbers, not all zero, made a unit vector and turned.
  Vec3 direction(const std::string& key);

  bool is_table(const std::string& key) const;
  bool is_list(const std::string& key) const;
  Cursor table(const std::string& key);                // must be there
  Cursor table_or_empty(const std::string& key);       // an empty one if it is not there
  std::vector<Cursor> tables(const std::string& key);  // [[key]]: any number of them

  // Where this table, or the value of this key (a setting included), stands; and the key's full path.
  Origin origin() const { return {document_->filename(), line_}; }
  Origin origin(const std::string& key) const;
  std::string path(const std::string& key) const;
  const std::string& path() const { return path_; }
  void rename(std::string path) { path_ = std::move(path); }  // "body[2]" becomes "body.rod1" once the name is known

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

 private:
  Cursor(Document& document, const Node& node, std::string path);
  const Node* member(const std::string& key) const;  // and remembers that it was asked for
  const Node& required(const std::string& key, const std::string& expected) const;
  std::string replaced(const std::string& text) const;  // {i}
  const Setting* setting(const std::string& path) const { return document_->setting_for(path); }
  const Setting* blamed_setting(const std::string& key) const;
  Cursor child(const Node& node, std::string path) const;
  std::vector<double> list(const std::string& key, const SiUnit* unit, const std::vector<std::string>& names,
                           const std::vector<double>* otherwise);
  Vec3 point_of(const Node& node, const std::string& key, const SiUnit& unit);
  double element(const Node& node, const std::string& key, const SiUnit* unit) const;
  double set_value(const Setting& setting, const std::string& path, const SiUnit* unit) const;

  Document* document_;
  const Node* node_;
  int line_;
  std::string path_;
  mutable std::set<std::string> asked_;
  int copy_ = 0;  // 0: not in a pattern
  Mat3 turn_ = Mat3::Identity();
};

}  // namespace boresight
