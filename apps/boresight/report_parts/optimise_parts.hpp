// What `match` and `allocate` share: the rung to confirm on, the steps of their models, the store of what was
// paid for.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "boresight_analyses/runs/evaluation_store.hpp"
#include "boresight_analyses/study/rung_choice.hpp"
#include "command_line/command.hpp"
#include "results/output_directory.hpp"

namespace boresight::app {

// The rung that leaves out less than this one; the same where there is none.
std::string next_rung_up(const std::string& rung);

// The run's options on this rung, with one step for all designs where it takes fixed steps and the user gave
// none. An integrator that the rung does not have is left out: the question was put to another rung.
RunOptions options_on(const std::string& rung, const std::shared_ptr<const Mechanism>& mechanism,
                      const std::vector<Parameters>& corners, RunOptions run);

// Opens `name` in the folder of results, and says in summary.json whose it is before the first evaluation
// lands.
std::unique_ptr<EvaluationStore> open_evaluations(const OutputDirectory& out, const std::string& verb,
                                                  const std::string& name, const std::vector<std::string>& variables,
                                                  const std::string& rung, double step);

}  // namespace boresight::app
