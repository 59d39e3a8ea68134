// What every verb of the command line is: a name, an example, its own options, and what it does.
//
// A verb is one folder, with a file VERB_verb.cpp that defines `std::unique_ptr<Verb> make_VERB_verb()`, and one line in
// verbs.cpp.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "boresight/keys/key.hpp"
#include "command_line/command.hpp"

namespace CLI {
class App;
}

namespace boresight::app {

class Verb {
 public:
  virtual ~Verb() = default;
  virtual std::string name() const = 0;
  virtual std::string file_kind() const = 0;                       // what FILE is: "mechanism", "study"
  virtual const KeyTable* study_table() const { return nullptr; }  // what its table of a study file may hold
  virtual bool needs_file() const { return true; }
  virtual std::string operand() const { return "FILE"; }  // what --help calls it, and says of it
  virtual std::string operand_is() const { return (needs_file() ? "the " : "a ") + file_kind() + " file"; }
  virtual std::string out_is() const { return "where results go; otherwise results/FILE-VERB"; }
  virtual std::string json_is() const { return "summary.json to standard output instead of the summary for people"; }
  virtual std::string summary() const = 0;  // one line for --help
  // Commands that work as they stand, in this order, in a folder where `boresight new antenna` was called; one a line.
  virtual std::string example() const = 0;
  // What to do with the results, in one line: "boresight run FILE"; "": nothing more. answer_is_no: of exit status 1.
  virtual std::string next(const Command&, bool /*answer_is_no*/) const { return ""; }
  virtual void declare_options(CLI::App&) {}  // beyond those that verbs share
  // Of the options that verbs share, those that it has no use for, and refuses: "--rung", ...
  virtual std::vector<std::string> unused_options() const { return {}; }
  // Returns the exit status. Throws InputError, ComputationError, OutputDirectoryError, WriteError.
  virtual int execute(const Command& command) = 0;
};

// Every verb, in the order of --help.
std::vector<std::unique_ptr<Verb>> all_verbs();

}  // namespace boresight::app
