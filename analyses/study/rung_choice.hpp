// Which rung of the ladder a question is put to, and why: the sentence goes into every summary.
#pragma once

#include <optional>
#include <string>

namespace boresight {

struct RungChoice {
  std::string name;
  std::string why;
};

// `asked`: a rung's name, or "auto". `accuracy`: what the study wants of its index, if it says.
// Throws InputError (key = --rung) for a name that no rung has.
RungChoice choose_rung(const std::string& asked, std::optional<double> accuracy);

}  // namespace boresight
