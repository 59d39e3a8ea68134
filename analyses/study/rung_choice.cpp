#include "boresight_analyses/study/rung_choice.hpp"

#include <algorithm>

#include "boresight/mechanism/error.hpp"
#include "boresight/rungs/rung.hpp"

namespace boresight {
namespace {

std::string listed(const std::vector<std::string>& names) {
  std::string text;
  for (const auto& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

}  // namespace

RungChoice choose_rung(const std::string& asked, std::optional<double> accuracy) {
  const std::vector<std::string> names = rung_names();
  if (asked != "auto") {
    if (std::find(names.begin(), names.end(), asked) == names.end())
      throw InputError({"command line", 0}, "--rung", "\"" + asked + "\"", "auto, " + listed(names),
                       nearest_name(asked, names));
    return {asked, "asked for by name"};
  }
  // Cheapest first, so the last one leaves out least. It serves any accuracy.
  const std::string& most_exact = names.back();
  if (names.size() == 1) return {most_exact, "the only rung there is"};
  return {most_exact, accuracy ? "the rung that leaves out least; it meets any accuracy"
                               : "the rung that leaves out least"};
}

}  // namespace boresight
