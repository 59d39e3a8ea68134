// boresight VERB FILE [options]: finds the verb, reads the command line, and turns faults into one line and
// an exit status.
#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdlib>
#include <exception>
#include <fstream>
#include <iostream>
#include <new>

#include "boresight/mechanism/error.hpp"
#include "boresight/mechanism/interruption.hpp"
#include "boresight_analyses/runs/sample_store.hpp"
#include "boresight_analyses/study/pilot.hpp"
#include "command_line/completion.hpp"
#include "command_line/montecarlo_study.hpp"
#include "command_line/program_options.hpp"
#include "results/output_directory.hpp"
#include "results/summary.hpp"
#include "terminal/exit_status.hpp"
#include "terminal/interruption.hpp"
#include "terminal/terminal.hpp"
#include "terminal/work_line.hpp"

namespace {

using namespace boresight;
using namespace boresight::app;

int fail(int status, const std::string& message) {
  clear_work_line();
  std::string line = message;
  for (char& c : line)
    if (c == '\n' || c == '\r') c = ' ';
  line = printable(line);
  // Colour only where somebody looks, and did not ask for none (no-color.org).
  const bool colour = ::isatty(STDERR_FILENO) && std::getenv("NO_COLOR") == nullptr;
  std::cerr << (colour ? "\033[31mboresight:\033[0m " : "boresight: ") << line << std::endl;
  return status;
}

int unknown_verb(const std::string& word, const std::vector<std::unique_ptr<Verb>>& verbs) {
  std::vector<std::string> names;
  std::string listed;
  for (const auto& verb : verbs) {
    names.push_back(verb->name());
    listed += (listed.empty() ? "" : ", ") + verb->name();
  }
  const std::string nearest = nearest_name(word, names);
  return fail(kBadInput, "found \"" + word + "\", expected a verb: " + listed +
                             (nearest.empty() ? "" : "; did you mean " + nearest + "?"));
}

// An option that the verb does not have: named, with the nearest one that it has or the verbs that have it.
std::string unknown_option(const std::vector<std::string>& left_over, const std::string& verb,
                           const std::vector<CLI::App*>& commands) {
  const auto option = std::find_if(left_over.begin(), left_over.end(),
                                   [](const std::string& word) { return word.size() > 1 && word.starts_with('-'); });
  if (option == left_over.end()) return "found \"" + left_over.front() + "\", expected no further argument";
  const std::string name = option->substr(0, option->find('='));
  std::vector<std::string> own;
  std::string others;
  for (const CLI::App* command : commands)
    for (const CLI::Option* known : command->get_options()) {
      if (command->get_name() == verb) own.push_back(known->get_name());
      if (known->check_name(name)) others += (others.empty() ? "" : ", ") + command->get_name();
    }
  if (!others.empty()) return name + " is not an option of " + verb + ", but of " + others;
  const std::string nearest = nearest_name(name, own);
  return name + " is not an option of " + verb + (nearest.empty() ? "" : "; did you mean " + nearest + "?");
}

// An option before any verb that the program itself does not have.
std::string unknown_option_of_program(const std::string& word, const CLI::App& app,
                                      const std::vector<CLI::App*>& commands) {
  const std::string name = word.substr(0, word.find('='));
  for (const CLI::App* command : commands)
    if (command->get_option_no_throw(name) != nullptr)
      return "found " + name + " before a verb, expected it behind one: boresight VERB FILE " + name;
  std::vector<std::string> own;
  for (const CLI::Option* known : app.get_options()) own.push_back("--" + known->get_lnames().front());
  const std::string nearest = nearest_name(name, own);
  return name + " is not an option of boresight" + (nearest.empty() ? "" : "; did you mean " + nearest + "?");
}

int run_program(int argc, char** argv) {
  ProgramOptions program;
  auto& [verbs, options, shell, app, commands, completion] = program;

  if (argc < 2) return fail(kBadInput, "found no verb, expected boresight VERB FILE; boresight --help tells more");
  const bool known =
      std::any_of(verbs.begin(), verbs.end(), [&](const auto& verb) { return verb->name() == argv[1]; }) ||
      completion->get_name() == argv[1];
  if (argv[1][0] != '-' && !known) return unknown_verb(argv[1], verbs);
  const std::string first(argv[1]);
  if (first[0] == '-' && app.get_option_no_throw(first.substr(0, first.find('='))) == nullptr)
    return fail(kBadInput, unknown_option_of_program(first, app, commands) + "; boresight --help tells more");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ExtrasError&) {
    return fail(kBadInput, unknown_option(app.remaining(true), argv[1], commands) + "; boresight " + argv[1] +
                               " --help tells more");
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app.exit(error);  // --help, --version
    return fail(kBadInput, std::string(error.what()) + "; boresight " +
                               (argv[1][0] == '-' ? "" : argv[1] + std::string(" ")) + "--help tells more");
  }
  for (const CLI::App* parsed : app.get_subcommands()) refuse_values_that_are_none(*parsed);
  if (completion->parsed()) {
    const auto& shells = completion_shells();
    if (std::find(shells.begin(), shells.end(), shell) == shells.end())
      throw InputError({"command line", 0}, "SHELL", "\"" + shell + "\"", "bash, zsh or fish",
                       nearest_name(shell, shells));
    std::cout << completion_script(app, shell);
    return kDone;
  }
  for (std::size_t i = 0; i < verbs.size(); ++i) {
    if (!commands[i]->parsed()) continue;
    const Command command = options[i].command(verbs[i]->name());
    show_work(!command.quiet);
    const int status = with_options_checked([&] { return verbs[i]->execute(command); });
    if (options[i].json && !last_summary().empty()) std::cout << std::ifstream(last_summary()).rdbuf();
    const bool answered = status == kDone || status == kAnswerIsNo;
    if (const std::string next = answered && !command.quiet ? verbs[i]->next(command, status == kAnswerIsNo) : "";
        !next.empty())
      tell("  next: {}\n", next);
    return status;
  }
  return kBadInput;
}

}  // namespace

int main(int argc, char** argv) {
  catch_interruptions();
  watch_long_work();
  try {
    const int status = run_program(argc, argv);
    std::cout.flush();
    if (!std::cout) return fail(kFailed, "cannot write to standard output");
    return status;
  } catch (const InputError& error) {
    return fail(kBadInput, error.what());
  } catch (const Interrupted&) {
    return fail(kInterrupted, "interrupted before there was anything new to keep");
  } catch (const PilotInterrupted&) {
    return fail(kInterrupted,
                "interrupted while a rung was being chosen: nothing is lost, nothing was begun; --rung NAME does "
                "without the choice");
  } catch (const OutputDirectoryError& error) {
    return fail(kBadInput, error.what());
  } catch (const SilentExit& exit) {
    return exit.status;
  } catch (const StoreRefused& error) {
    return fail(kBadInput, error.what());
  } catch (const StoreFailed& error) {
    return fail(kFailed, error.what());
  } catch (const WriteError& error) {
    return fail(kFailed, error.what());
  } catch (const ComputationError& error) {
    return fail(kFailed, error.what());
  } catch (const std::bad_alloc&) {
    return fail(kFailed, "not enough memory");
  } catch (const std::exception& error) {
    return fail(kFailed, std::string("a fault in the program itself: ") + error.what());
  }
}
