#include "command_line/function_question.hpp"

#include "boresight/io/cursor.hpp"
#include "boresight/io/mechanism_file.hpp"
#include "boresight_analyses/random/random_inputs.hpp"
#include "boresight_analyses/runs/scatter_draws.hpp"
#include "boresight_analyses/runs/study_run.hpp"
#include "boresight_analyses/study/lane_sample_model.hpp"
#include "command_line/study_input.hpp"
#include "results/verb_study.hpp"

namespace boresight::app {
namespace {

const Origin kGivenAsOption{"command line", 0};

bool is_study(const std::string& file) {
  Document document = Document::from_file(file);
  return Cursor(document).has("mechanism");
}

AskedFunction function_of_study(const FunctionQuestion& question) {
  const Command& command = question.command;
  if (!question.inputs.empty())
    throw InputError(kGivenAsOption, "--input", question.inputs.front(),
                     "none: a study says itself what varies, in [[random]]");
  if (!question.index.empty())
    throw InputError(kGivenAsOption, "--index", question.index, "none: a study says itself what is asked, in [index]");
  StudyInput input(command.file, command.settings);
  const RandomInputs random = read_random_inputs(input.root, input.mechanism->description(), input.trial);
  if (random.size() == 0) throw InputError({command.file, 0}, "random", "nothing", "at least one [[random]]");
  const RunOptions run = question.motion.run_options(*input.mechanism, command.rung);
  const StudyRun own(input.mechanism, run_options_of(command, input.study.index, input.study.accuracy, run));
  const RungChoice choice = own.choose_rung_of_scatter({.inputs = random, .lanes = true, .integrators = true});
  FunctionModel model{.index = input.study.index, .rung = choice.name, .run = run};
  apply(choice, model.run);
  const bool lanes = choice.name == "perturbation" && LaneSampleModel::serve(*input.mechanism, model.index, run);
  if (!choice.pilot && !lanes && run.step == 0.0)
    model.run.step = common_step(choice.name, input.mechanism, pilot_samples(random, *input.mechanism), run);
  return {input.mechanism->name(), command.file, choice,
          std::make_shared<const IndexFunction>(input.mechanism, inputs_of(random), model)};
}

AskedFunction function_of_mechanism(const FunctionQuestion& question) {
  const Command& command = question.command;
  const auto mechanism = std::make_shared<const Mechanism>(read_mechanism(command.file, command.settings));
  if (question.inputs.empty())
    throw InputError(kGivenAsOption, "--input", "none",
                     "the path of at least one number that varies: boresight paths FILE lists them");
  const IndexChoice index = index_named("--index", question.index.empty() ? "position_error.max" : question.index);
  check_line_of_sight(index, *mechanism, kGivenAsOption, "--index");
  std::vector<FunctionInput> inputs;
  try {
    inputs = inputs_named(*mechanism, question.inputs);
  } catch (const InputError& error) {
    throw InputError(kGivenAsOption, "--input " + error.key, error.found, error.expected, error.nearest);
  }
  RunOptions run = question.motion.run_options(*mechanism, command.rung);
  RungChoice choice = StudyRun(mechanism, run_options_of(command, index, {}, run))
                          .choose_rung({.wants_multibody = question.motion.asks_for_multibody(), .integrators = true},
                                       kPilotTrials, {mechanism->parameters()});
  // How far its user goes from there nobody has said; a study's [[random]] does.
  if (choice.pilot) choice.why += "; tried at the file's values alone";
  apply(choice, run);
  return {mechanism->name(), "", choice,
          std::make_shared<const IndexFunction>(mechanism, inputs,
                                                FunctionModel{.index = index, .rung = choice.name, .run = run})};
}

}  // namespace

AskedFunction read_function(const FunctionQuestion& question) {
  check_rung_name(question.command.rung);
  return is_study(question.command.file) ? function_of_study(question) : function_of_mechanism(question);
}

}  // namespace boresight::app
