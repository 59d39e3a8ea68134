// boresight convert MECHANISM: the ideal mechanism as SDF or MJCF, for viewing in other programs.
#include <filesystem>

#include "boresight/io/mechanism_file.hpp"
#include "boresight/mechanism/error.hpp"
#include "boresight/mechanism/mechanism.hpp"
#include "command_line/declared_option.hpp"
#include "command_line/verb.hpp"
#include "exchange/writers.hpp"
#include "results/output_directory.hpp"
#include "results/whole_results.hpp"
#include "terminal/exit_status.hpp"
#include "terminal/terminal.hpp"

namespace boresight::app {
namespace {

class ConvertVerb : public Verb {
 public:
  std::string name() const override { return "convert"; }
  std::string file_kind() const override { return "mechanism"; }
  std::string summary() const override {
    return "the ideal mechanism as SDF or MJCF, to be looked at in other programs";
  }
  std::string example() const override { return "boresight convert antenna/mechanism.toml --to antenna.sdf"; }
  std::vector<std::string> unused_options() const override {
    return {"--out", "--rung", "--accuracy", "--jobs", "--json"};
  }
  void declare_options(CLI::App& app) override {
    declare_option(app, "--to,--out", to_,
                   "the file to write, NAME.sdf or NAME.xml (MJCF); otherwise FILE's name with .sdf, here", "FILE");
  }

  int execute(const Command& command) override {
    const std::filesystem::path to =
        to_.empty() ? std::filesystem::path(std::filesystem::path(command.file).stem().string() + ".sdf")
                    : std::filesystem::path(to_);
    const std::string extension = to.extension().string();
    if (extension != ".sdf" && extension != ".xml" && extension != ".mjcf")
      throw InputError({"command line", 0}, "--to", "\"" + to.string() + "\"",
                       "a name that ends in .sdf, .xml or .mjcf");
    const Mechanism mechanism(read_mechanism(command.file, command.settings));
    const Written written = extension == ".sdf" ? sdf_of(mechanism) : mjcf_of(mechanism);
    std::error_code error;
    if (std::filesystem::exists(std::filesystem::symlink_status(to, error)))
      throw OutputDirectoryError(to.string() + ": is there already; give another --to, or remove it");
    write_atomically(to, written.text);
    if (command.quiet) return kDone;
    tell("{}: {} bodies, {} joints, at home\nleft out:\n", to.string(), mechanism.bodies(), mechanism.joints());
    for (const std::string& line : written.left_out) tell("  {}\n", line);
    return kDone;
  }

 private:
  std::string to_;
};

}  // namespace

std::unique_ptr<Verb> make_convert_verb() { return std::make_unique<ConvertVerb>(); }

}  // namespace boresight::app
