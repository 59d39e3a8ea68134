#include "report/place.hpp"

#include <cmath>

#include "boresight/keys/letters.hpp"

namespace boresight::report::checks {

std::string Place::found() const {
  const std::string text = value.is_object()  ? "an object"
                           : value.is_array() ? "an array of " + std::to_string(value.size())
                                              : value.dump(-1, ' ', false, json::error_handler_t::replace);
  return shortened(text, 60, 57);
}

std::string listed(Words words) {
  std::string text;
  for (const char* word : words) text += (text.empty() ? "" : ", ") + std::string(word);
  return text;
}

void object(const Place& place, Words required, Words optional) {
  if (!place.value.is_object()) place.fail(place.found(), "an object with " + listed(required));
  for (const char* key : required) {
    if (!place.has(key)) place.fail("no key '" + std::string(key) + "'", "the keys " + listed(required));
  }
  const auto is = [](const std::string& name) { return [&name](const char* key) { return name == key; }; };
  for (const auto& [name, value] : place.value.items()) {
    if (std::none_of(required.begin(), required.end(), is(name)) &&
        std::none_of(optional.begin(), optional.end(), is(name))) {
      place.fail("unknown key '" + name + "'",
                 listed(required) + (optional.size() ? "; or, where wanted, " + listed(optional) : ""));
    }
  }
}

void text(const Place& place, bool may_be_empty) {
  if (!place.value.is_string()) place.fail(place.found(), "text");
  if (!may_be_empty && place.value.get_ref<const std::string&>().empty()) place.fail("empty text", "some text");
}
void text_where_given(const Place& place, Words keys) {
  for (const char* key : keys)
    if (place.has(key)) text(place.at(key));
}

void flag_where_given(const Place& place, Words keys) {
  for (const char* key : keys) {
    if (place.has(key) && !place.at(key).value.is_boolean()) place.at(key).fail(place.at(key).found(), "true or false");
  }
}

void one_of(const Place& place, Words words) {
  text(place);
  const auto& word = place.value.get_ref<const std::string&>();
  if (std::none_of(words.begin(), words.end(), [&](const char* w) { return word == w; })) {
    place.fail("'" + word + "'", "one of " + listed(words));
  }
}

void finite(const Place& place, double least, double most) {
  if (!place.value.is_number() || !std::isfinite(place.value.get<double>()))
    place.fail(place.found(), "a finite number");
  const double number = place.value.get<double>();
  if (number < least || number > most) {
    const auto end = [](double limit) { return std::isfinite(limit) ? json(limit).dump() : std::string("any"); };
    place.fail(place.found(), "a number from " + end(least) + " to " + end(most));
  }
}

void array(const Place& place) {
  if (!place.value.is_array()) place.fail(place.found(), "an array");
}

void same_length(const Place& place, std::size_t length, const char* as_in) {
  array(place);
  if (place.value.size() != length) {
    place.fail(std::to_string(place.value.size()) + " values", std::to_string(length) + ", as in " + as_in);
  }
}

// null is a gap; NaN and infinity become null when written.
void numbers(const Place& place) {
  array(place);
  for (std::size_t i = 0; i < place.value.size(); ++i) {
    if (!place.value[i].is_number() && !place.value[i].is_null())
      place.at(i).fail(place.at(i).found(), "a number or null");
  }
}
void texts(const Place& place) {
  array(place);
  for (std::size_t i = 0; i < place.value.size(); ++i) text(place.at(i));
}
// Along an axis: all numbers, or all names of categories.
void numbers_or_names(const Place& place) {
  array(place);
  if (!place.value.empty() && place.value[0].is_string())
    texts(place);
  else
    numbers(place);
}

void each(const Place& place, const char* key, void (*check_one)(const Place&)) {
  if (!place.has(key)) return;
  const Place list = place.at(key);
  array(list);
  for (std::size_t i = 0; i < list.value.size(); ++i) check_one(list.at(i));
}

}  // namespace boresight::report::checks
