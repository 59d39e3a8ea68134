#include "results/verb_study.hpp"

#include <fmt/format.h>

#include <filesystem>

#include "boresight/io/content_hash.hpp"
#include "command_line/declared_option.hpp"
#include "terminal/interruption.hpp"
#include "terminal/progress.hpp"
#include "terminal/readable.hpp"
#include "terminal/terminal.hpp"

namespace boresight::app {
namespace {

class StageOnTerminal final : public Stage {
 public:
  StageOnTerminal(bool quiet, double total, const std::string& unit) : progress_(quiet, total, unit) {}
  void update(double before, double done, const std::string& estimate) override {
    progress_.update_from(before, done, estimate);
  }
  void clear() override { progress_.clear(); }

 private:
  Progress progress_;
};

// Copies samples.db from the folder that the study goes on from, where one was named. Throws OutputDirectoryError, StoreRefused.
void bring_runs(const OutputDirectory& out, const std::map<std::string, std::string>& facts,
                const Resumption& resumption) {
  namespace fs = std::filesystem;
  if (resumption.from.empty()) return;
  const fs::path source = fs::path(resumption.from) / "samples.db", target = out.path() / "samples.db";
  std::error_code error;
  if (fs::equivalent(resumption.from, out.path(), error)) return;
  if (fs::exists(target, error))
    throw OutputDirectoryError(
        "--out " + out.path().string() +
        ": holds samples already, with which a study goes on without --from; --from wants a new folder");
  const std::optional<FolderClaim> claim =
      fs::is_directory(resumption.from, error) ? FolderClaim::take(resumption.from) : std::nullopt;
  if (!claim && fs::is_directory(resumption.from, error))
    throw OutputDirectoryError("--from " + resumption.from + ": a run is writing there; wait for it to end");
  {
    const SampleStore found(source);  // refuses what is no store
    if (found.fact("study") != facts.at("study"))
      throw OutputDirectoryError("--from " + resumption.from +
                                 ": holds the samples of another study (other file, settings or options)");
    if (const std::string another = found.another_than(facts); !another.empty())
      throw OutputDirectoryError("--from " + resumption.from + ": holds " + another + "; begin without it");
  }
  // The log first: a store without its log lacks its last samples, a log without its store is nothing.
  for (const char* suffix : {"-wal", ""}) {
    if (!fs::exists(source.string() + suffix, error)) continue;
    const fs::path copy = target.string() + suffix + std::string("-copy");
    fs::copy_file(source.string() + suffix, copy, fs::copy_options::overwrite_existing, error);
    if (!error) fs::permissions(copy, fs::perms::owner_read | fs::perms::owner_write, fs::perm_options::add, error);
    if (!error) fs::rename(copy, target.string() + suffix, error);
    if (error) throw WriteError("cannot write " + target.string() + suffix + ": " + error.message());
  }
}

StudyRunOptions in_folder(StudyRunOptions options, const std::string& verb, const OutputDirectory& out) {
  options.identity = out.identity().dump();
  options.folder = out.path();
  options.begun = [&out, verb](const std::string& how_it_goes_on) { announce_begun(out, verb, how_it_goes_on); };
  return options;
}

}  // namespace

void Resumption::declare(CLI::App& app) {
  declare_flag(app, "--resume", resume,
               "nothing more than without it: the same command goes on where an earlier run of this study stopped, or "
               "with more samples");
  declare_option(app, "--from", from,
                 "go on with the samples of this folder of results, which stays as it is (it may be on a disk that "
                 "cannot be written); "
                 "results go to --out",
                 "DIR");
}

nlohmann::json identity_of_study(const Command& command, const Mechanism& mechanism, const std::string& decides,
                                 const nlohmann::json& options) {
  ContentHash hash;
  hash.add(decides);
  return identity_of(command, mechanism.description().content_hash, hash.hexadecimal(), options);
}

StudyRunOptions run_options_of(const Command& command, const IndexChoice& index,
                               const std::optional<double>& study_accuracy, const RunOptions& run) {
  return {.version = BORESIGHT_VERSION,
          .rung = command.rung,
          .accuracy = command.accuracy ? command.accuracy : study_accuracy,
          .index = index,
          .run = run,
          .jobs = command.jobs,
          .interrupted = [] { return interrupted(); },
          .stage = [quiet = command.quiet](
                       double total,
                       const std::string& unit) { return std::make_unique<StageOnTerminal>(quiet, total, unit); },
          .damaged = [](const std::string& damage) { fmt::print(stderr, "boresight: {}\n", printable(damage)); }};
}

VerbStudy::VerbStudy(const Command& command, const std::shared_ptr<const Mechanism>& mechanism,
                     const IndexChoice& index, const std::optional<double>& study_accuracy, const RunOptions& run,
                     const nlohmann::json& identity)
    : command_(command),
      out_(OutputDirectory::open(command.out, command.verb, command.file, identity)),
      run_(mechanism, in_folder(run_options_of(command, index, study_accuracy, run), command.verb, out_)) {}

std::unique_ptr<SampleStore> VerbStudy::open_samples(const std::string& decides,
                                                     const std::vector<std::string>& parameters,
                                                     const Resumption& resumption) const {
  bring_runs(out_, run_.facts(decides), resumption);
  return run_.open_samples(decides, parameters);
}

Json VerbStudy::head(const RungChoice& rung, const Stopwatch& watch, const std::vector<std::string>& warnings,
                     bool interrupted, const SampleStore::Cost& earlier) const {
  Json json = common_summary(command_, *run_.mechanism(), rung, watch, warnings, interrupted, out_);
  json["cpu_seconds"] = json["cpu_seconds"].get<double>() + earlier.cpu_seconds;
  json["wall_seconds"] = json["wall_seconds"].get<double>() + earlier.wall_seconds;
  return json;
}

Json VerbStudy::head(const Study& study, const RungChoice& rung, const Stopwatch& watch,
                     const std::vector<std::string>& warnings, bool interrupted,
                     const SampleStore::Cost& earlier) const {
  Json json = head(rung, watch, warnings, interrupted, earlier);
  json["study"] = {{"file", study.file}, {"hash", study.content_hash}};
  return json;
}

std::string no_run_done(bool stopped, std::uint64_t before, std::uint64_t after, double seconds) {
  if (!stopped || after > before) return "";
  return fmt::format(
      "no run was done in these {}: one that is cut off is computed anew, so a start must last longer than one run",
      readable(seconds, "s"));
}

}  // namespace boresight::app
