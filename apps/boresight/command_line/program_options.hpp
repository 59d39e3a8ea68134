// The program's command line: every verb with its options.
#pragma once

#include <CLI/CLI.hpp>
#include <memory>
#include <string>
#include <vector>

#include "command_line/command.hpp"
#include "command_line/verb.hpp"

namespace boresight::app {

struct ProgramOptions {
  std::vector<std::unique_ptr<Verb>> verbs;
  std::vector<CommandOptions> options;  // one a verb
  std::string shell;                    // of completion
  CLI::App app;
  std::vector<CLI::App*> commands;  // one a verb
  CLI::App* completion = nullptr;

  ProgramOptions();
};

// An unset variable of a shell leaves an empty text, which is no value; nor is one that is not UTF-8, but of a file. Throws InputError naming
// the option, or what the verb is called on.
void refuse_values_that_are_none(const CLI::App& command);

}  // namespace boresight::app
