// Which parameters or groups a sensitivity study may call the first: the one with the largest measure, and all whose intervals reach
// its own, since samples do not tell these apart.
#pragma once

#include <string>
#include <vector>

#include "boresight_analyses/statistics/interval.hpp"

namespace boresight::app {

struct MeasuredGroup {
  std::string name;
  ReportedInterval measure;
};

// Of groups in any order, largest first. Intervals reach each other where they have a point in common.
std::vector<MeasuredGroup> leading_groups(std::vector<MeasuredGroup> groups);

// "x", "x and y", "x, y and z"; of more than four the first three, "x, y, z and 7 others".
std::string names_of(const std::vector<MeasuredGroup>& leading);

// "0.51 (0.45 to 0.58) and 0.49 (0.42 to 0.55)", as many as names_of() names; text: of a measure's value.
template <typename Text>
std::string measures_of(const std::vector<MeasuredGroup>& leading, const Text& text);

// How many of them are named.
std::size_t named(const std::vector<MeasuredGroup>& leading);
// "a", "a and b", "a, b and c"
std::string in_a_sentence(const std::vector<std::string>& words);

template <typename Text>
std::string measures_of(const std::vector<MeasuredGroup>& leading, const Text& text) {
  std::vector<std::string> words;
  for (std::size_t k = 0; k < named(leading); ++k) {
    const ReportedInterval& i = leading[k].measure;
    words.push_back(text(i.value) + " (" + text(i.low) + " to " + text(i.high) + ")");
  }
  return in_a_sentence(words);
}

}  // namespace boresight::app
