// boresight report DIR: the report of a folder of results, made again by this version of the program.
#include "command_line/verb.hpp"
#include "results/report_files.hpp"
#include "terminal/exit_status.hpp"
#include "terminal/terminal.hpp"

namespace boresight::app {
namespace {

class ReportVerb : public Verb {
 public:
  std::string name() const override { return "report"; }
  std::string file_kind() const override { return "results"; }
  std::string operand() const override { return "DIR"; }
  std::string operand_is() const override { return "the folder of any verb's results"; }
  std::string summary() const override { return "the report of results again, from their report.json: report.html"; }
  std::string example() const override {
    return "boresight run antenna/mechanism.toml\n  boresight report results/mechanism-run";
  }
  std::vector<std::string> unused_options() const override {
    return {"--set", "--out", "--rung", "--accuracy", "--jobs", "--json"};
  }

  int execute(const Command& command) override {
    rebuild_report(command.file);
    if (!command.quiet) tell("report: {}\n", (std::filesystem::path(command.file) / "report.html").string());
    return kDone;
  }
};

}  // namespace

std::unique_ptr<Verb> make_report_verb() { return std::make_unique<ReportVerb>(); }

}  // namespace boresight::app
