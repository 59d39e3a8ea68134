// boresight new FOLDER: a commented mechanism and a study of each kind to start from, and what to do with them.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <string>

#include "boresight/mechanism/error.hpp"
#include "command_line/verb.hpp"
#include "results/folder_claim.hpp"
#include "results/output_directory.hpp"
#include "results/whole_results.hpp"
#include "terminal/exit_status.hpp"
#include "terminal/terminal.hpp"

extern "C" {
extern const char boresight_template_mechanism[];
extern const char boresight_template_montecarlo[];
extern const char boresight_template_sweep[];
extern const char boresight_template_sensitivity[];
extern const char boresight_template_match[];
extern const char boresight_template_allocate[];
extern const char boresight_template_budget[];
extern const char boresight_template_calibrate[];
}

namespace boresight::app {
namespace {

namespace fs = std::filesystem;

std::string text_of(const fs::path& file) {
  std::ifstream in(file);
  return {std::istreambuf_iterator<char>(in), {}};
}

class NewVerb : public Verb {
 public:
  std::string name() const override { return "new"; }
  std::string file_kind() const override { return "folder"; }
  std::string operand() const override { return "FOLDER"; }
  std::string operand_is() const override { return "the folder to make"; }
  std::string summary() const override { return "a commented mechanism to start from, and a study of each kind"; }
  std::string example() const override { return "boresight new antenna"; }
  std::vector<std::string> unused_options() const override {
    return {"--set", "--out", "--rung", "--accuracy", "--json"};
  }

  int execute(const Command& command) override {
    const fs::path folder = command.file;
    const struct {
      const char* name;
      const char* text;
    } files[] = {{"mechanism.toml", boresight_template_mechanism}, {"montecarlo.toml", boresight_template_montecarlo},
                 {"sweep.toml", boresight_template_sweep},         {"sensitivity.toml", boresight_template_sensitivity},
                 {"match.toml", boresight_template_match},         {"allocate.toml", boresight_template_allocate},
                 {"budget.toml", boresight_template_budget},       {"calibrate.toml", boresight_template_calibrate}};
    // Some of them word for word as they would be written, and not all: a start that was killed, which this one completes.
    std::error_code failed;
    const auto is_there = [&](const auto& file) { return fs::exists(folder / file.name, failed); };
    const bool all = std::all_of(std::begin(files), std::end(files), is_there);
    for (const auto& file : files)
      if (is_there(file) && (all || text_of(folder / file.name) != file.text))
        throw OutputDirectoryError((folder / file.name).string() +
                                   ": is there already; give another folder, or remove it");
    fs::create_directories(folder, failed);
    std::error_code unknown;
    if (failed || !fs::is_directory(folder, unknown))
      throw OutputDirectoryError(folder.string() + ": cannot make this folder" +
                                 (failed ? ": " + failed.message() : ""));
    const std::optional<FolderClaim> claim = FolderClaim::take(folder);
    if (!claim)
      throw OutputDirectoryError(folder.string() +
                                 ": another run is writing there; wait for it to end, or give another folder");
    discard_staged(folder);
    for (const auto& file : files) stage(folder, file.name, file.text);
    place_staged(folder);
    if (!command.quiet) tell_what_to_do(folder);
    return kDone;
  }

 private:
  static void tell_what_to_do(const fs::path& folder) {
    const auto call = [&](const char* verb, const char* file) {
      return fmt::format("boresight {} {}", verb, shell_word((folder / file).string()));
    };
    const std::string check = call("check", "mechanism.toml"), run = call("run", "mechanism.toml"),
                      montecarlo = call("montecarlo", "montecarlo.toml");
    tell(
        "{0}: an antenna whose elevation bearing has play, to be changed into yours\n"
        "  {1:<{4}}  what would go wrong, before it does\n"
        "  {2:<{4}}  one motion: how far off it points\n"
        "  {3:<{4}}  how the error scatters\n"
        "and a study for each of sweep, sensitivity, match, allocate, budget and calibrate\n",
        folder.string(), check, run, montecarlo, montecarlo.size());
  }
};

}  // namespace

std::unique_ptr<Verb> make_new_verb() { return std::make_unique<NewVerb>(); }

}  // namespace boresight::app
