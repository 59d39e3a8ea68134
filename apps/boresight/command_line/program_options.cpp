#include "command_line/program_options.hpp"

#include "boresight/keys/units.hpp"
#include "boresight/mechanism/error.hpp"
#include "command_line/option_range.hpp"
#include "command_line/program_help.hpp"
#include "exchange/utf8.hpp"

namespace boresight::app {
namespace {

constexpr const char* kOtherVerbs = "Files and help";

// Under which heading --help lists a verb.
std::string group_of(const Verb& verb) {
  if (verb.file_kind() == "study") return "Studies of a mechanism";
  const bool of_mechanism = verb.file_kind().starts_with("mechanism") && verb.name() != "paths";
  return of_mechanism || verb.name() == "new" ? "One mechanism" : kOtherVerbs;
}

}  // namespace

ProgramOptions::ProgramOptions()
    : verbs(all_verbs()),
      options(verbs.size()),
      app("Accuracy of pointing mechanisms whose joints have clearance.", "boresight") {
  app.set_version_flag("--version", std::string("boresight ") + BORESIGHT_VERSION);
  app.require_subcommand(1);
  app.footer(
      "boresight VERB --help tells more; boresight help WORD explains a key of a file. Exit status: 0 done, 1 the "
      "answer is no, 2 bad "
      "input, 3 failed, 130 interrupted.");
  for (std::size_t i = 0; i < verbs.size(); ++i) {
    CLI::App* command = app.add_subcommand(verbs[i]->name(), verbs[i]->summary());
    options[i].declare(*command, *verbs[i]);
    verbs[i]->declare_options(*command);
    command->group(group_of(*verbs[i]));
    const std::string example = verbs[i]->example();
    const bool of_files = example.find("antenna/") != std::string::npos;
    command->footer(std::string(of_files ? "Example, after boresight new antenna:\n  " : "Example:\n  ") + example);
    commands.push_back(command);
  }
  completion = app.add_subcommand("completion", "completion of verbs and options in a shell: bash, zsh, fish");
  completion->group(kOtherVerbs);
  completion->add_option("SHELL", shell, "bash, zsh or fish")->required()->type_name("");
  completion->footer("Example:\n  source <(boresight completion bash)");
}

void refuse_values_that_are_none(const CLI::App& command) {
  for (const CLI::Option* option : command.get_options())
    for (const std::string& value : option->results())
      if (value.empty())
        throw InputError(kCommandLine, option->get_name(), in_quotes(value),
                         option->nonpositional() ? "a value, or no " + option->get_name() : option->get_description());
  for (const CLI::Option* option : command.get_options()) {
    // Files may be called anything.
    const bool is_a_file = option->get_type_name() == "FILE" || option->get_type_name() == "DIR";
    if (is_a_file || !option->nonpositional()) continue;
    for (const std::string& value : option->results())
      if (const std::size_t at = first_byte_not_utf8(value); at != std::string::npos)
        throw InputError(kCommandLine, option->get_name(), byte_in_words(value[at]) + " in " + in_quotes(value),
                         "a text in UTF-8");
  }
}

std::string help_of_program() { return ProgramOptions().app.help(); }

std::string help_of_verb(const std::string& verb) {
  const ProgramOptions program;
  for (const CLI::App* command : program.app.get_subcommands([](const CLI::App*) { return true; }))
    if (command->get_name() == verb) return command->help("boresight");
  return "";
}

std::vector<std::string> verb_names() {
  std::vector<std::string> names;
  for (const auto& verb : all_verbs()) names.push_back(verb->name());
  return names;
}

}  // namespace boresight::app
