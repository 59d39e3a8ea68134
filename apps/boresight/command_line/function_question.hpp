// A file as a function of numbers: a mechanism with the inputs that somebody names, or a study with what it scatters.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "boresight_analyses/function/index_function.hpp"
#include "boresight_analyses/study/rung_choice.hpp"
#include "command_line/command.hpp"

namespace boresight::app {

struct FunctionQuestion {
  Command command;  // file, settings, rung, accuracy, jobs, quiet
  MotionOptions motion;
  std::vector<std::string> inputs;  // of a mechanism: paths; a study has its own
  std::string index;                // of a mechanism: "position_error.max", ...; "": that one. A study has its own
};

struct AskedFunction {
  std::string name;   // of the mechanism
  std::string study;  // its file; "": the file is a mechanism
  RungChoice rung;
  std::shared_ptr<const IndexFunction> function;
};

// Of a study the values are those that `boresight montecarlo` computes of the same samples, to the last bit: the same rung, and the same
// step for all. Throws InputError, ComputationError, PilotInterrupted.
AskedFunction read_function(const FunctionQuestion& question);

}  // namespace boresight::app
