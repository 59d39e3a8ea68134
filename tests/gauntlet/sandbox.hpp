// One piece of work in a process of its own, with limits: a crash or an endless loop becomes an answer.
#pragma once

#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace boresight::gauntlet {

using Json = nlohmann::json;

struct Limits {
  double cpu_seconds = 30.0, wall_seconds = 300.0;
};

struct Outcome {
  enum class End { answered, refused, crashed, out_of_time };
  End end = End::answered;
  Json answer;         // of the work, if it answered
  std::string reason;  // of a refusal, or the signal's name
  double cpu_seconds = 0.0;
};

// A std::exception out of the work is a refusal with its text; its type is kept as {"type"} in the answer.
Outcome in_sandbox(const Limits& limits, const std::function<Json()>& work);

// A program with its output thrown away but for the last 2,000 characters of both streams, in the folder given. One that works
// for longer than the limit is asked to end, as by Ctrl-C, and has ten seconds of CPU to do so.
struct ProgramOutcome {
  Outcome::End end = Outcome::End::answered;
  bool asked_to_end = false;
  int status = 0;  // of its exit
  std::string output, reason;
  double cpu_seconds = 0.0;
};
ProgramOutcome run_program(const Limits& limits, const std::string& folder, const std::vector<std::string>& arguments);

}  // namespace boresight::gauntlet
