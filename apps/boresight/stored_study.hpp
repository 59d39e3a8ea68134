// What the verbs share whose runs are kept in samples.db and gone on with: whose store it is, and on which rung.
#pragma once

#include <memory>
#include <string>

#include "boresight_analyses/montecarlo/sample_store.hpp"
#include "boresight_analyses/random/random_inputs.hpp"
#include "boresight_analyses/study/rung_choice.hpp"
#include "boresight_analyses/study/study.hpp"
#include "command.hpp"
#include "output_directory.hpp"

namespace boresight::app {

// Opens samples.db in the folder of results, and says in summary.json whose it is before the first run lands. `text`:
// what decides a run beside the folder's identity. Throws OutputDirectoryError where it is there and --resume was not
// asked for.
SampleStore open_runs(const OutputDirectory& out, const std::string& verb, const RandomInputs& inputs,
                      const std::string& text, bool resume);

// A study keeps its rung: the one it was begun with is the one it goes on with.
RungChoice rung_of_study(const Command& command, const Study& study, const std::shared_ptr<const Mechanism>& mechanism,
                         const RandomInputs& inputs, const RunOptions& run, const SampleStore& store);

}  // namespace boresight::app
