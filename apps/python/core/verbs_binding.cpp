// The verbs of the command line, each called as the program calls it: the same files, the same results.
#include <pybind11/stl.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <mutex>
#include <utility>

#include "boresight/mechanism/error.hpp"
#include "command_line/montecarlo_study.hpp"
#include "command_line/program_options.hpp"
#include "python/core/bindings.hpp"
#include "python/core/task.hpp"
#include "results/summary.hpp"
#include "terminal/embedding.hpp"
#include "terminal/exit_status.hpp"

namespace py = pybind11;

namespace boresight::python {
namespace {

using namespace boresight::app;

// As the program does it, without its terminal. Throws InputError and what the verb throws.
int execute(const std::vector<std::string>& words) {
  ProgramOptions program;
  std::vector<std::string> reversed(words.rbegin(), words.rend());  // as CLI11 wants them
  try {
    program.app.parse(reversed);
  } catch (const CLI::ParseError& error) {
    throw InputError({"command line", 0}, words.front(), error.what(),
                     "options as in boresight " + words.front() + " --help");
  }
  for (const CLI::App* parsed : program.app.get_subcommands()) refuse_values_that_are_none(*parsed);
  for (std::size_t i = 0; i < program.verbs.size(); ++i) {
    if (!program.commands[i]->parsed()) continue;
    const Command command = program.options[i].command(program.verbs[i]->name());
    return with_options_checked([&] { return program.verbs[i]->execute(command); });
  }
  return kBadInput;
}

// Verbs end by one flag and tell of their progress in one place: one at a time.
py::dict call(const std::vector<std::string>& words, const py::object& progress) {
  Task task(progress);
  int status = kBadInput;
  std::string reason, folder;
  const Embedding host{.interrupted = [&] { return task.stop().load(); },
                       .progress = [&](double done, double total, const std::string& unit,
                                       const std::string& estimate) { task.tell(done, total, unit, estimate); },
                       .failed = [&](const std::string& why) { reason = why; }};
  task.run([&] {
    const std::scoped_lock lock(one_at_a_time());
    const Embedded in(host);
    forget_summary();
    try {
      status = execute(words);
    } catch (const SilentExit& exit) {
      status = exit.status;
    }
    folder = last_summary().parent_path().string();
  });
  if (status == kFailed) throw ComputationError(reason.empty() ? "the study failed; " + folder + " says why" : reason);
  if (status == kInterrupted) {
    PyErr_SetNone(PyExc_KeyboardInterrupt);
    throw py::error_already_set();
  }
  py::dict result;
  result["status"] = status;
  result["folder"] = folder;
  return result;
}

// "--out", "--quiet", ...; of what is no verb none.
std::vector<std::string> options_that_verb_has(const std::string& verb) {
  const ProgramOptions program;
  std::vector<std::string> names;
  for (std::size_t i = 0; i < program.verbs.size(); ++i) {
    if (program.verbs[i]->name() != verb) continue;
    for (const CLI::Option* option : std::as_const(*program.commands[i]).get_options())
      if (option->nonpositional()) names.push_back(option->get_name());
  }
  return names;
}

}  // namespace

void bind_verbs(py::module_& module) {
  module.def("call_verb", &call, py::arg("words"), py::arg("progress") = py::none(),
             "Calls a verb with the words of a command line; {\"status\": 0 or 1, \"folder\": of its results}.");
  module.def("options_of_verb", &options_that_verb_has, py::arg("verb"),
             "The options that a verb has: \"--out\", ...; of what is no verb none.");
}

}  // namespace boresight::python
