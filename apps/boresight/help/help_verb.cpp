// boresight help WORD: what a key, a table, a verb or a topic is; and all of it as one page.
#include <fmt/format.h>

#include <iostream>

#include "boresight/mechanism/error.hpp"
#include "command_line/declared_option.hpp"
#include "command_line/program_help.hpp"
#include "command_line/verb.hpp"
#include "reference/key_help.hpp"
#include "reference/manual_page.hpp"
#include "reference/reference_page.hpp"
#include "reference/topics.hpp"
#include "terminal/exit_status.hpp"
#include "terminal/terminal.hpp"

namespace boresight::app {
namespace {

std::string overview() {
  std::string text =
      help_of_program() +
      "\nboresight help WORD explains a verb, a key (restitution), a table (clearance.friction) or a topic:\n";
  for (const Topic& topic : topics()) text += fmt::format("  {:<14}{}\n", topic.name, topic.title);
  return text;
}

std::vector<std::pair<std::string, std::string>> helps_of_verbs() {
  std::vector<std::pair<std::string, std::string>> helps;
  for (const std::string& verb : verb_names()) helps.emplace_back(verb, help_of_verb(verb));
  return helps;
}

[[noreturn]] void refuse(const std::string& word) {
  std::vector<std::string> known = known_words();
  for (const std::string& verb : verb_names()) known.push_back(verb);
  throw InputError({"command line", 0}, "WORD", "\"" + word + "\"",
                   "a verb, a key (restitution), a table (clearance.friction) or a topic (units)",
                   nearest_name(word, known));
}

class HelpVerb : public Verb {
 public:
  std::string name() const override { return "help"; }
  std::string file_kind() const override { return "word"; }
  bool needs_file() const override { return false; }
  std::string operand() const override { return "WORD"; }
  std::string operand_is() const override {
    return "a verb, a key (restitution), a table (clearance.friction), a path (clearance.F1.radial) or a topic (units)";
  }
  std::string summary() const override { return "what a key of a file, a table, a verb or a topic is"; }
  std::string example() const override { return "boresight help clearance.friction"; }
  std::vector<std::string> unused_options() const override {
    return {"--set", "--out", "--rung", "--accuracy", "--jobs", "--quiet", "--json"};
  }
  void declare_options(CLI::App& app) override {
    declare_flag(app, "--page", page_, "the whole reference as a page of HTML, to standard output");
    declare_flag(app, "--man", man_, "verbs and topics as a manual page, to standard output");
  }

  int execute(const Command& command) override {
    const std::string& word = command.file;
    if (page_ || man_) {
      const std::string option = page_ ? "--page" : "--man";
      if (page_ && man_) throw InputError({"command line", 0}, "--page", "--page and --man", "one of the two");
      if (!word.empty())
        throw InputError({"command line", 0}, "WORD", "\"" + word + "\" and " + option, "one of the two");
      std::cout << (page_
                        ? reference_page(helps_of_verbs())
                        : manual_page("accuracy of pointing mechanisms whose joints have clearance", helps_of_verbs()));
      return kDone;
    }
    if (word.empty()) {
      tell("{}", overview());
      return kDone;
    }
    const std::string verb = help_of_verb(word), keys = key_help(word);
    if (verb.empty() && keys.empty()) refuse(word);
    tell("{}{}{}", verb, verb.empty() || keys.empty() ? "" : "\n", keys);
    return kDone;
  }

 private:
  bool page_ = false, man_ = false;
};

}  // namespace

std::unique_ptr<Verb> make_help_verb() { return std::make_unique<HelpVerb>(); }

}  // namespace boresight::app
