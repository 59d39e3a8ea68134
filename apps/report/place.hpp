// One value of a report's document and where it stands, and what may be asked of it: each check throws std::invalid_argument that
// says where, what was found and what was expected.
#pragma once

#include <initializer_list>
#include <limits>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>

namespace boresight::report::checks {

using nlohmann::json;
using Words = std::initializer_list<const char*>;

struct Place {
  const json& value;
  std::string path;

  [[noreturn]] void fail(const std::string& found, const std::string& expected) const {
    throw std::invalid_argument("report document: " + (path.empty() ? std::string("(root)") : path) + ": found " +
                                found + ", expected " + expected);
  }
  // What stands here, short enough for one line of message.
  std::string found() const;
  bool has(const char* key) const { return value.contains(key); }
  Place at(const char* key) const { return {value.at(key), path.empty() ? key : path + "." + key}; }
  Place at(std::size_t i) const { return {value.at(i), path + "[" + std::to_string(i) + "]"}; }
};

std::string listed(Words words);
void object(const Place& place, Words required, Words optional);
void text(const Place& place, bool may_be_empty = true);
void text_where_given(const Place& place, Words keys);
void flag_where_given(const Place& place, Words keys);
void one_of(const Place& place, Words words);
void finite(const Place& place, double least = -std::numeric_limits<double>::infinity(),
            double most = std::numeric_limits<double>::infinity());
void array(const Place& place);
void same_length(const Place& place, std::size_t length, const char* as_in);
// null is a gap; NaN and infinity become null when written.
void numbers(const Place& place);
void texts(const Place& place);
// Along an axis: all numbers, or all names of categories.
void numbers_or_names(const Place& place);
void each(const Place& place, const char* key, void (*check_one)(const Place&));

}  // namespace boresight::report::checks
