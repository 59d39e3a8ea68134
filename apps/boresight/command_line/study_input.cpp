#include "command_line/study_input.hpp"

#include "boresight/io/mechanism_file.hpp"
#include "boresight/io/referred_file.hpp"
#include "boresight_analyses/runs/scatter_draws.hpp"
#include "terminal/exit_status.hpp"
#include "terminal/interruption.hpp"
#include "terminal/progress.hpp"

namespace boresight::app {

std::function<void(const Setting&)> trial_of(const std::string& mechanism_file, const std::vector<Setting>& settings) {
  return [mechanism_file, settings](const Setting& setting) {
    std::vector<Setting> all = settings;
    all.push_back(setting);
    const Mechanism tried(read_mechanism(mechanism_file, all));
  };
}

StudyInput::StudyInput(const std::string& file, const std::vector<Setting>& settings)
    : document(Document::from_file(file)),
      root(document),
      study(read_study(root, document.content_hash())),
      mechanism(read_referred(
          root.origin("mechanism"), "mechanism", study.mechanism_file,
          [&] { return std::make_shared<const Mechanism>(read_mechanism(study.mechanism_file, settings)); })),
      trial(trial_of(study.mechanism_file, settings)) {
  check_index(study, *mechanism);
}

RungChoice choose_rung_in_sight(const Command& command, RungQuestion question, double trials,
                                const std::shared_ptr<const Mechanism>& mechanism,
                                const std::vector<Parameters>& samples) {
  Progress progress(command.quiet, trials, "trials of the pilot");
  question.asked = command.rung;
  question.progress = [&](int trial) {
    progress.update(trial, "finding the cheapest rung that meets the accuracy");
    return !interrupted();
  };
  return choose_rung(question, mechanism, samples);
}

RungChoice choose_rung_of_corners(const Command& command, const Study& study, const RunOptions& run,
                                  const std::shared_ptr<const Mechanism>& mechanism,
                                  const std::vector<Parameters>& corners) {
  return choose_rung_in_sight(command,
                              {.accuracy = command.accuracy ? command.accuracy : study.accuracy,
                               .wants_multibody = !run.formulation.empty() || !run.stabilisation.empty(),
                               .index = study.index,
                               .step = run.step,
                               .integrator = run.integrator,
                               .tolerance = run.tolerance},
                              kPilotTrialsOfScatter, mechanism, corners);
}

RungChoice choose_rung_of_scatter(const Command& command, const Study& study, const RunOptions& run,
                                  const std::shared_ptr<const Mechanism>& mechanism, const ScatterAsked& asked) {
  RungQuestion question{.accuracy = command.accuracy ? command.accuracy : study.accuracy,
                        .wants_multibody = !run.formulation.empty() || !run.stabilisation.empty(),
                        .index = study.index,
                        .step = run.step,
                        .integrator = run.integrator,
                        .tolerance = run.tolerance,
                        .integrators = asked.integrators,
                        .lanes = asked.lanes,
                        .statistic = asked.statistic,
                        .scene_varies = scene_varies(asked.inputs),
                        .runs = asked.runs,
                        .jobs = command.jobs};
  std::vector<Parameters> draws;
  if (command.rung == "auto" && question.accuracy) draws = draws_of_scatter(asked.inputs, *mechanism, kDrawsForPilot);
  return choose_rung_in_sight(command, question, kPilotTrialsOfScatter, mechanism, draws);
}

int status_with_accuracy(const RungChoice& choice, int status) {
  return status == kDone && choice.pilot && !choice.pilot->met ? kAnswerIsNo : status;
}

}  // namespace boresight::app
