// Small study files for any mechanism: one of every kind, a few samples each, over numbers that the mechanism has.
#pragma once

#include <string>
#include <vector>

#include "boresight/mechanism/mechanism.hpp"

namespace boresight::gauntlet {

struct Study {
  std::string stage;                   // "montecarlo", "montecarlo tail", ...
  std::string verb, file;              // file "": the mechanism's
  std::string text;                    // of the file
  std::vector<std::string> arguments;  // besides verb and file
};

// Of a mechanism without play: the verbs that need none. typical: the index of a run, for requirements [m]. data: the name of
// a CSV file of measured poses for `calibrate`.
std::vector<Study> studies(const Mechanism& mechanism, double typical, const std::string& data);

}  // namespace boresight::gauntlet
