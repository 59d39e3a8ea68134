// What the verbs share whose runs are kept in samples.db and gone on with: whose store it is, and on which rung.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "boresight/stepping/measured_error.hpp"
#include "boresight_analyses/random/random_inputs.hpp"
#include "boresight_analyses/runs/sample_store.hpp"
#include "boresight_analyses/study/rung_choice.hpp"
#include "boresight_analyses/study/study.hpp"
#include "command_line/command.hpp"
#include "command_line/study_input.hpp"
#include "results/output_directory.hpp"

namespace boresight::app {

// How a study goes on: in its folder, or from the samples of another one, which stays as it is.
struct Resumption {
  bool resume = false;  // changes nothing: kept for the scripts that ask for it
  std::string from;     // "": none

  void declare(CLI::App& app);
};

// Opens samples.db in the folder of results, and says in summary.json whose it is before the first run lands. `text`:
// what decides a run beside the folder's identity. The runs that are there already stay.
SampleStore open_runs(const OutputDirectory& out, const std::string& verb, const RandomInputs& inputs,
                      const std::string& text, const Resumption& resumption);
// Copies samples.db from the folder that the study goes on from, where one was named. Throws OutputDirectoryError, StoreRefused.
void bring_runs(const OutputDirectory& out, const std::string& study_hash, const Resumption& resumption);
// One line to standard error where a store was damaged when it was opened.
void tell_of_damage(const std::string& damage);
// The study's CPU and wall-clock seconds are those of all its parts.
void add_earlier_cost(nlohmann::ordered_json& summary, const SampleStore::Cost& earlier);

// A study keeps its rung, integrator and tolerance: those it was begun with are those it goes on with.
void note_choice(SampleStore& store, const RungChoice& choice);
RungChoice stored_choice(const SampleStore& store);  // where it has samples
RungChoice rung_of_study(const Command& command, const Study& study, const std::shared_ptr<const Mechanism>& mechanism,
                         const ScatterAsked& asked, const RunOptions& run, SampleStore& store);

// A warning where a start was stopped before a single run was done; otherwise "". before, after: runs in the store.
std::string no_run_done(bool stopped, std::uint64_t before, std::uint64_t after, double seconds);

// common_step() of the scatter's pilot samples, each of whose motions is kept in the store as soon as it is flown.
double kept_common_step(const std::string& rung, const std::shared_ptr<const Mechanism>& mechanism,
                        const RandomInputs& inputs, const RunOptions& run, SampleStore& store);

// What the steps do to a study's answer, relative: measured once on a few samples, and noted, so that a study that goes on
// says the same.
struct StudySteps {
  double relative = kNotMeasured;
  std::string why;
  bool interrupted = false;  // the study is whole but for this
};
// run: with the step, integrator and tolerance of the study's runs. store: may be none.
StudySteps steps_of_study(const Command& command, const Study& study, const std::shared_ptr<const Mechanism>& mechanism,
                          const ScatterAsked& asked, const RunOptions& run, const std::string& rung,
                          SampleStore* store);

}  // namespace boresight::app
