// One scene through the gauntlet.
#pragma once

#include <string>

#include "verdict.hpp"

namespace boresight::gauntlet {

struct TrialOptions {
  Limits limits;  // of one stage
  bool integrators = true;
  bool invariances = true;
  std::string program;     // the boresight program, for `auto` and the verbs
  bool automatic = false;  // `run --accuracy` by the program
  bool verbs = false;      // every verb of the program
};

Verdict try_scene(const std::string& name, const std::string& family, const std::string& text,
                  const TrialOptions& options);

}  // namespace boresight::gauntlet
