// A study file as the verbs take it: opened, with its mechanism as --set leaves it; and the rung that its questions are put to.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "boresight/io/cursor.hpp"
#include "boresight/io/document.hpp"
#include "boresight/mechanism/mechanism.hpp"
#include "boresight_analyses/random/random_inputs.hpp"
#include "boresight_analyses/study/rung_choice.hpp"
#include "boresight_analyses/study/study.hpp"
#include "command_line/command.hpp"

namespace boresight::app {

// A check that the mechanism takes one further setting, on top of `settings`: it throws InputError where it does not.
std::function<void(const Setting&)> trial_of(const std::string& mechanism_file, const std::vector<Setting>& settings);

struct StudyInput {
  // Throws InputError.
  StudyInput(const std::string& file, const std::vector<Setting>& settings);
  StudyInput(const StudyInput&) = delete;
  StudyInput& operator=(const StudyInput&) = delete;

  Document document;
  Cursor root;  // stands at what the verb's own plan reads
  Study study;
  std::shared_ptr<const Mechanism> mechanism;
  std::function<void(const Setting&)> trial;
};

// choose_rung() with the pilot's progress shown, and Ctrl-C heeded. question: `asked` and `progress` are filled in here.
// trials: about as many as the pilot makes; it may need fewer.
RungChoice choose_rung_in_sight(const Command& command, RungQuestion question, double trials,
                                const std::shared_ptr<const Mechanism>& mechanism,
                                const std::vector<Parameters>& samples);
inline constexpr double kPilotTrials = 24.0, kPilotTrialsOfScatter = 72.0;

// The same for a study of designs: at these corners of them, each a motion of its own.
RungChoice choose_rung_of_corners(const Command& command, const Study& study, const RunOptions& run,
                                  const std::shared_ptr<const Mechanism>& mechanism,
                                  const std::vector<Parameters>& corners);

// The same for a study of a scatter.
struct ScatterAsked {
  const RandomInputs& inputs;
  ScatterStatistic statistic = {};
  std::uint64_t runs = 0;    // that the study will make
  bool lanes = false;        // whether it can take lanes
  bool integrators = false;  // whether it can take an integrator and its tolerance
};
RungChoice choose_rung_of_scatter(const Command& command, const Study& study, const RunOptions& run,
                                  const std::shared_ptr<const Mechanism>& mechanism, const ScatterAsked& asked);

// 0 turned into 1 where an accuracy was asked for and the pilot could not show it: the answer is then "no". For what is one
// number with an accuracy: a sweep and a search of designs only say it.
int status_with_accuracy(const RungChoice& choice, int status);

}  // namespace boresight::app
