// What every verb is asked with: the file, the settings, where results go, how much may be computed at once;
// and the options of those verbs that follow a motion.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "boresight/io/document.hpp"
#include "boresight/keys/units.hpp"
#include "boresight/mechanism/error.hpp"
#include "boresight/mechanism/mechanism.hpp"
#include "boresight/rungs/option_check.hpp"
#include "boresight/rungs/rung.hpp"
#include "boresight_analyses/study/index_choice.hpp"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace boresight::app {

class Verb;

struct Command {
  std::string verb;
  std::string file;
  std::vector<Setting> settings;  // --set, in the order given
  std::string out;                // "": chosen from file and verb
  std::string rung = "auto";
  std::optional<double> accuracy;  // --accuracy, relative, of the index
  int jobs = 1;                    // threads
  bool quiet = false;
  bool json = false;  // --json: then quiet as well
};

// The exit status of a verb of which the computation failed. The summary on the terminal has said why; where none was wanted,
// the reason goes to standard error, as that of every failure does.
int failed(const Command& command, const std::string& reason);

// The options every verb has, as CLI11 fills them in; command() checks them and throws InputError.
struct CommandOptions {
  std::string file, out, rung = "auto", accuracy, jobs;
  std::vector<std::string> settings;
  bool quiet = false;
  bool json = false;

  // Those among them that the verb has a use for.
  void declare(CLI::App& app, const Verb& verb);
  Command command(const std::string& verb) const;
};

// How a motion is followed and what of it is kept: the options of `run` and `sweep`.
struct MotionOptions {
  std::string step, sample = "1 ms", integrator, tolerance, formulation, stabilisation;
  std::vector<std::string> poses;

  void declare(CLI::App& app, bool with_poses);
  void declare_model(CLI::App& app);  // step, formulation, stabilisation alone: for verbs that keep no histories
  // Throws InputError for a value that is no duration, an unknown body, an unknown word, and for what the rung would
  // refuse in every run; of "auto", what the rung that has most would. And for an option that a rung asked for by name does not
  // read, but for those that are read besides ("step", ...): by other rungs that the verb goes on to.
  RunOptions run_options(const Mechanism& mechanism, const std::string& rung,
                         const std::vector<std::string>& read_besides = {}) const;
  // Whether an option was given that not every rung has: `auto` then takes multibody, which has them all.
  bool asks_for_multibody() const;
  nlohmann::json identity() const;  // what of them changes results
  nlohmann::json model_identity() const;
  // Those that this rung reads, as they are typed for a shell, but for the step, each with a space before it.
  std::string model_text(const std::string& rung) const;

 private:
  void refuse_unread(const std::string& rung, const std::vector<std::string>& read_besides) const;
  void set_sample_spacing(RunOptions& options, const Mechanism& mechanism, double most_samples) const;
  bool keeps_histories_ = false;
  const CLI::Option* sample_option_ = nullptr;
};

// Computes, and turns a rung's refusal of an option into an InputError that names it.
template <typename Compute>
auto with_options_checked(const Compute& compute) {
  try {
    return compute();
  } catch (const OptionRefused& refusal) {
    throw InputError({"command line", 0}, "--" + refusal.option, refusal.found, refusal.expected, refusal.nearest);
  }
}
// Before the first of many runs: what the rung would refuse in each of them. Throws InputError.
void check_run_options(const RunOptions& options, const std::string& rung, const Mechanism& mechanism);

// Charts want the impacts, so histories are finer than the table of the user's --sample: how many history
// samples stand for one of its rows. Up to ten, while the history stays below 20,000 samples.
std::size_t history_refinement(double duration, double sample_spacing);

// A positive value with its unit, given to an option. Throws InputError naming the option.
double positive_quantity(const std::string& option, const std::string& text, const SiUnit& unit);

// "position_error.max" as an index. Throws InputError naming the option.
IndexChoice index_named(const std::string& option, const std::string& text);

// What tells this study's results from another's: verb, hashes, settings, options.
nlohmann::json identity_of(const Command& command, const std::string& mechanism_hash, const std::string& study_hash,
                           const nlohmann::json& options);

}  // namespace boresight::app
