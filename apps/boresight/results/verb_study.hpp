// The study of a verb: its run (runs/study_run.hpp) as the command asks for it, in the folder of its results, with the
// terminal's progress and Ctrl-C; and the head of its summary.
//
//   const Stopwatch watch;
//   VerbStudy own(command, mechanism, study.index, study.accuracy, run, identity_of_study(...));
//   const auto store = own.open_samples(plan.text(study), plan.inputs.names(), resumption);
//   Json json = own.head(choice, watch, warnings, false, store->earlier());
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "boresight_analyses/runs/study_run.hpp"
#include "boresight_analyses/study/study.hpp"
#include "command_line/command.hpp"
#include "results/output_directory.hpp"
#include "results/summary.hpp"

namespace CLI {
class App;
}

namespace boresight::app {

// How a study goes on: in its folder, or from the samples of another one, which stays as it is.
struct Resumption {
  bool resume = false;  // changes nothing: kept for the scripts that ask for it
  std::string from;     // "": none

  void declare(CLI::App& app);
};

// identity_of() for a study: decides is the text that decides its runs beside mechanism, settings and options.
nlohmann::json identity_of_study(const Command& command, const Mechanism& mechanism, const std::string& decides,
                                 const nlohmann::json& options);

// What the command and the terminal say of how a study is run; without a folder. study_accuracy: where the command asks none.
StudyRunOptions run_options_of(const Command& command, const IndexChoice& index,
                               const std::optional<double>& study_accuracy, const RunOptions& run);

class VerbStudy {
 public:
  // run: as asked for. Opens the folder: throws OutputDirectoryError.
  VerbStudy(const Command& command, const std::shared_ptr<const Mechanism>& mechanism, const IndexChoice& index,
            const std::optional<double>& study_accuracy, const RunOptions& run, const nlohmann::json& identity);
  VerbStudy(const VerbStudy&) = delete;
  VerbStudy& operator=(const VerbStudy&) = delete;

  const OutputDirectory& out() const { return out_; }
  const StudyRun& run() const { return run_; }

  // samples.db as StudyRun has it, brought from another folder where one was named. Throws OutputDirectoryError too.
  std::unique_ptr<SampleStore> open_samples(const std::string& decides, const std::vector<std::string>& parameters,
                                            const Resumption& resumption) const;

  // common_summary() and the study, where it has a file; seconds of CPU and wall clock are those of all its parts.
  Json head(const RungChoice& rung, const Stopwatch& watch, const std::vector<std::string>& warnings, bool interrupted,
            const SampleStore::Cost& earlier = {}) const;
  Json head(const Study& study, const RungChoice& rung, const Stopwatch& watch,
            const std::vector<std::string>& warnings, bool interrupted, const SampleStore::Cost& earlier = {}) const;

 private:
  const Command& command_;
  OutputDirectory out_;
  StudyRun run_;
};

// A warning where a start was stopped before a single run was done; otherwise "". before, after: runs in the store.
std::string no_run_done(bool stopped, std::uint64_t before, std::uint64_t after, double seconds);

}  // namespace boresight::app
