// What a rung cannot make of the options of a run, said before it follows anything: an unknown word, a number out of
// range, a combination that a method does not have. Every rung that follows a motion asks this first, so that a word
// misspelt through the library is refused and never taken for a default; a study asks it once, before its first sample.
#pragma once

#include <stdexcept>
#include <string>

#include "boresight/mechanism/mechanism.hpp"
#include "boresight/rungs/rung.hpp"

namespace boresight {

// what(): "integrator: found FOUND, expected EXPECTED".
class OptionRefused : public std::invalid_argument {
 public:
  OptionRefused(const std::string& of, const std::string& given, const std::string& wanted,
                const std::string& meant = "");
  std::string option, found, expected,
      nearest;  // option: "integrator", ...; nearest: the name that may have been meant
};

// Why a rung does not read an option ("step", "integrator", "tolerance", "formulation", "stabilisation"), for whoever named both; "": it does.
std::string why_unread(const std::string& option, const std::string& rung);

// Throws OptionRefused. Rungs that take no steps ignore what steps are told, but not a misspelt word.
void check_options(const RunOptions& options, const std::string& rung, const Mechanism& mechanism,
                   const Parameters& parameters);

}  // namespace boresight
