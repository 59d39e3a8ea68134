// What a user may write in one table of a file: every key with its kind, unit, default and range, and a sentence for people.
//
// This is the one source. The reader (`Cursor`, in `io`) takes a key's unit, default and range from here and refuses to be asked for a key
// that is not here; the messages about unknown keys, `boresight help`, the JSON schemas and the reference page are made of the same.
//
//   const KeyTable& spring_keys() {
//     using namespace keys;
//     static const KeyTable table{
//         .name = "spring",
//         .says = "A spring with a damper between two points.",
//         .keys = {quantity("stiffness", kStiffnessRange).at_least(0.0, "a stiffness of zero or more").says("Force per length."),
//                  quantity("damping", kDampingRange).otherwise(0.0).says("Force per speed of lengthening.")}};
//     return table;
//   }
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "boresight/keys/physical_ranges.hpp"

namespace boresight {

struct KeyTable;

enum class KeyKind {
  quantity,     // "0.1 mm"
  quantities,   // ["72 GPa", "72 GPa"]
  vector,       // three quantities along the world's axes
  points,       // a list of vectors
  number,       // 0.9
  numbers,      // [0.33, 0.33]
  direction,    // three numbers
  integer,      // 100
  value,        // quantity or number, as the parameter that it is a value of
  values,       // a list of them
  boolean,      // true
  text,         // "F1"
  texts,        // ["ground", "crank"]
  choice,       // one of some words
  choices,      // a list of such words
  expression,   // "0.5*sin(2*pi*t)"
  expressions,  // ["0", "t", "0"]
  table,        // [motion]
  tables,       // [[body]]
};

// One of the words that a key may have. says: "" where the word explains itself.
struct KeyChoice {
  std::string name, says;
};

// What a number, or each of a list, has to be; in SI.
struct KeyBound {
  double least = -std::numeric_limits<double>::infinity();
  double most = std::numeric_limits<double>::infinity();
  bool above = false, below = false;  // the bound itself is refused
  std::string expected;               // for the error's text

  bool holds(long double value) const;
};

struct Key {
  enum class Presence {
    required,
    has_default,  // number_otherwise, list_otherwise or text_otherwise
    computed,     // the default depends on other keys: `when` says on what
    sometimes,    // needed, or of use, in some cases only: `when` says in which
  };

  std::string name;
  KeyKind kind = KeyKind::text;
  PhysicalRange range{
      {"", "", ""}, "", ""};  // its unit too; unit.what "": the reader knows the unit, `unit_is` says it in words
  std::string unit_is;
  std::vector<KeyBound> bounds;  // checked in this order, after the range
  Presence presence = Presence::required;
  std::string when;
  double number_otherwise = 0.0;
  std::vector<double> list_otherwise;
  std::string text_otherwise;  // of booleans "true" or "false"
  std::string shown_in;        // unit in which people see the default; "": the SI unit
  std::string text_form;       // of a direction: what text may stand in its place, in words; "": none
  std::string word;            // a word that may stand in place of a quantity, and is the default
  std::vector<KeyChoice> choices;
  std::vector<std::string> elements;  // names of a list's elements, by which settings address them
  std::vector<std::size_t> counts;    // how many a list may have; empty: any number
  std::string list_expected;          // of a list, for the error's text
  bool or_one = false;                // one element may stand without the list
  std::size_t fewest = 0;             // elements of a list, or tables, where the number is open otherwise
  std::string fewest_expected;        // for the error's text
  bool distinct = false;              // no element of a list twice; its reader says which, or of which study
  bool not_all_zero = false;          // of numbers
  std::string filled_expected;        // of a text that may not be empty, for the error's text; "": it may
  std::vector<double> but_not;        // numbers within the bounds that are refused
  std::string but_not_expected;
  const KeyTable& (*inside)() = nullptr;  // of a table; null: read elsewhere (the tables of a study's verbs)
  std::string verbs;                      // that look at it; "": all that read the file
  std::string sentence;                   // for people

  // Each returns the key, so that they can be written in a row; says() is the last one.
  Key otherwise(double value, const std::string& shown_in_unit = "") &&;
  Key otherwise(std::vector<double> values, const std::string& shown_in_unit = "") &&;
  Key otherwise(const char* text) &&;
  Key usually(const std::string& words) &&;  // computed
  Key sometimes(const std::string& words) &&;
  Key or_word(const std::string& text) &&;
  Key or_text(const std::string& form) &&;
  Key above(double least, const std::string& expected) &&;
  Key at_least(double least, const std::string& expected) &&;
  Key at_most(double most, const std::string& expected) &&;
  Key between(double least, double most, const std::string& expected) &&;
  Key inside_of(double least, double most, const std::string& expected) &&;  // the ends excluded
  Key bounded(KeyBound bound) &&;
  Key counting(double least, double most) &&;  // "2 to 50"
  Key share() &&;                              // more than 0 and less than 1
  Key named(std::vector<std::string> elements) &&;
  Key of_length(std::vector<std::size_t> counts, const std::string& expected) &&;
  Key or_single() &&;
  Key at_least_of(std::size_t fewest, const std::string& expected) &&;
  Key all_different() &&;
  Key with_some_not_zero() &&;
  Key filled(const std::string& expected) &&;
  Key except(std::vector<double> refused, const std::string& expected) &&;
  Key for_verbs(const std::string& verbs) &&;
  Key says(const std::string& sentence) &&;
};

// One table of a file.
struct KeyTable {
  std::string name;                      // "clearance.contact"; "mechanism", "study" of the file itself
  std::string says;                      // a sentence for people
  std::vector<Key> keys;                 // in the order of messages and of the reference
  bool any_name = false;                 // its names are the user's: the one key says what stands behind each
  std::vector<std::string> one_of = {};  // exactly one of these keys stands in it; empty: whatever each of them says
  std::string one_of_what = {};          // what that one is, "distribution", for the error's text
  std::size_t fewest = 0;                // keys that stand in it
  std::string fewest_expected = {};      // for the error's text

  const Key* find(const std::string& key) const;
  std::vector<std::string> names() const;
};

// The makers of keys, one a kind. unit_is: of values whose unit another key decides, "the parameter's".
namespace keys {
Key quantity(const std::string& name, const PhysicalRange& range);
Key quantity(const std::string& name, const SiUnit& unit);
Key quantity_of(const std::string& name, const std::string& unit_is);
Key quantities(const std::string& name, const PhysicalRange& range);
Key quantities(const std::string& name, const SiUnit& unit);
Key vector(const std::string& name, const PhysicalRange& range);
Key points(const std::string& name, std::size_t count, const PhysicalRange& range);
Key number(const std::string& name);
Key numbers(const std::string& name);
Key direction(const std::string& name);
Key integer(const std::string& name);
Key value(const std::string& name, const std::string& unit_is);
Key values(const std::string& name, const std::string& unit_is);
Key boolean(const std::string& name, bool otherwise);
Key text(const std::string& name);
Key texts(const std::string& name);
Key choice(const std::string& name, std::vector<KeyChoice> choices);
Key choice(const std::string& name, const std::vector<std::string>& choices);
// expected: of each, for the error's text.
Key choices(const std::string& name, const std::vector<std::string>& choices, const std::string& expected);
Key expression(const std::string& name, const SiUnit& unit);
Key expressions(const std::string& name, const SiUnit& unit);
Key table(const std::string& name, const KeyTable& (*inside)());
Key tables(const std::string& name, const KeyTable& (*inside)());
}  // namespace keys

// As it would stand in a file: 0.9, "1 mm/s", ["72 GPa", "72 GPa"], "flores"; "" without a fixed default.
std::string default_text(const Key& key);
// "1 pm to 10000 km, above 0", "0 to 1"; "" for no range.
std::string range_text(const Key& key);
// "length", "list of 2 numbers", "direction", "text", "table".
std::string kind_text(const Key& key);

}  // namespace boresight
