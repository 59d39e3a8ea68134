// Texts in the columns of a terminal: a letter of a name takes one, whatever bytes it has; one of East Asia two; an accent that is
// written behind its letter none.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace boresight::app {

std::size_t columns_in(std::string_view text);
// With blanks behind it, up to so many columns.
std::string padded(std::string_view text, std::size_t columns);
// As many letters from its beginning as these columns hold.
std::string first_columns(std::string_view text, std::size_t columns);

// The columns of the longest of these texts: of `text_of(one)` for one after the other.
template <typename List, typename TextOf>
std::size_t widest_of(const List& list, const TextOf& text_of) {
  std::size_t widest = 0;
  for (const auto& one : list)
    if (const std::size_t columns = columns_in(text_of(one)); columns > widest) widest = columns;
  return widest;
}

}  // namespace boresight::app
