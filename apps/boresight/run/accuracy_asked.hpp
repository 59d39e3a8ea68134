// --accuracy beside a rung asked for by name: there is nothing to choose, and what the run states of itself is held against it.
#pragma once

#include <optional>
#include <string>

#include "boresight/rungs/run_result.hpp"
#include "boresight_analyses/study/index_choice.hpp"
#include "boresight_analyses/study/rung_choice.hpp"
#include "command_line/command.hpp"
#include "results/summary.hpp"

namespace boresight::app {

struct AccuracyAsked {
  double wanted = 0.0;  // of the index, relative
  double stated = 0.0;  // what the rung leaves out and what its steps do; not a number where these were not measured
  bool met() const { return stated <= wanted; }
};

// Nothing where none was asked for, or a pilot answers.
std::optional<AccuracyAsked> accuracy_asked(const Command& command, const RungChoice& choice, const RunResult& result,
                                            const IndexChoice& index);
std::string accuracy_sentence(const AccuracyAsked& asked, const IndexChoice& index);
Json accuracy_json(const AccuracyAsked& asked);

}  // namespace boresight::app
