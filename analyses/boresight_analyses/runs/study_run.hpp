// One study under way, whichever analysis it is: who it is and where it keeps its runs, how the rung and the step are found
// that its questions are put to, how it is told to stop and shows how far it has come. Whoever runs it, the command line or a
// program of one's own, says how once; the analyses ask it.
//
//   StudyRun run(mechanism, {.identity = "clearance of F1, try 3", .folder = "results", .jobs = 8});
//   const auto store = run.open_samples("", plan.inputs.names());
//   const RungChoice choice = run.rung_of_scatter({.inputs = plan.inputs, .runs = 2000}, *store);
//   run_montecarlo(*run.model_of_scatter(choice.name, plan.inputs, run.options().run), ...);
//
// A study keeps its rung, integrator, tolerance and step: those it was begun with are those it goes on with.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "boresight/stepping/measured_error.hpp"
#include "boresight_analyses/random/random_inputs.hpp"
#include "boresight_analyses/runs/evaluation_store.hpp"
#include "boresight_analyses/runs/kept_results.hpp"
#include "boresight_analyses/study/rung_choice.hpp"
#include "boresight_analyses/study/sample_model.hpp"

namespace boresight {

// How far one stage of a study has come, for people.
class Stage {
 public:
  virtual ~Stage() = default;
  // done: of the stage's total, `before` of it by an earlier start. From any thread.
  virtual void update(double before, double done, const std::string& estimate) = 0;
  void update(double done, const std::string& estimate) { update(0.0, done, estimate); }
  // Before something else is shown.
  virtual void clear() = 0;
};

struct StudyRunOptions {
  std::string identity = {};            // tells this study from every other one: its stores are known by it
  std::string version = {};             // of the program: stores of another are refused; "": it does not matter
  std::filesystem::path folder = {};    // of its results; it must exist before a store is opened
  std::string rung = "auto";            // asked for
  std::optional<double> accuracy = {};  // relative, of the index
  IndexChoice index = {};
  RunOptions run = {};  // as asked for
  int jobs = 1;
  std::function<bool()> interrupted = {};                                                   // asked often
  std::function<std::unique_ptr<Stage>(double total, const std::string& unit)> stage = {};  // none: nobody looks
  std::function<void(const std::string& how_it_goes_on)> begun = {};                        // before a store is made
  std::function<void(const std::string& what_became_of_it)> damaged = {};  // of a store, as it was opened
};

// What a study of a scatter asks of the rung that it is put to.
struct ScatterAsked {
  const RandomInputs& inputs;
  ScatterStatistic statistic = {};
  std::uint64_t runs = 0;    // that the study will make
  bool lanes = false;        // whether it can take lanes
  bool integrators = false;  // whether it can take an integrator and its tolerance
};

// Designs that stand for all designs of a study, as it judges them.
struct DesignsTried {
  std::vector<std::vector<Parameters>> samples;    // of each design
  std::optional<ScatterStatistic> statistic = {};  // of its samples; nothing: each one is a motion of its own
  bool scene_varies = true;                        // over the samples of one design
  std::uint64_t runs = 0;                          // that the study will make in all; 0: not known
  bool lanes = false;                              // designs are judged on lanes where these serve
};

// What the steps do to a study's answer, relative.
struct StudySteps {
  double relative = kNotMeasured;
  std::string why;
  bool interrupted = false;  // the study is whole but for this
};

// A study that is not whole yet: what is there of it, and the rung that it was begun with.
struct Unfinished {
  std::unique_ptr<KeptResults> results;
  RungChoice rung;
};
inline constexpr const char* kUnfinished = "unfinished.db";  // where it is kept

class StudyRun {
 public:
  StudyRun(std::shared_ptr<const Mechanism> mechanism, StudyRunOptions options);

  const std::shared_ptr<const Mechanism>& mechanism() const { return mechanism_; }
  const StudyRunOptions& options() const { return options_; }
  bool interrupted() const { return options_.interrupted && options_.interrupted(); }
  std::unique_ptr<Stage> stage(double total, const std::string& unit) const;

  // By which its stores are known. decides: what decides a run beside the identity; "": nothing.
  std::string hash(const std::string& decides = "") const;
  // What a store of it says of itself: that hash, and the version.
  std::map<std::string, std::string> facts(const std::string& decides = "") const;
  // Open a store in the folder; what is in it already stays. Throw StoreRefused, StoreFailed.
  std::unique_ptr<SampleStore> open_samples(const std::string& decides, const std::vector<std::string>& parameters,
                                            const std::string& name = "samples.db") const;
  std::unique_ptr<EvaluationStore> open_evaluations(const std::string& name, const std::vector<std::string>& variables,
                                                    const std::string& rung, double step,
                                                    const std::string& model) const;
  // Removes a store that has been closed: the study is whole, and computed anew where it is asked once more.
  void forget(const std::string& name) const;

  // Of a study that keeps its results until it is whole: goes on with those of an earlier start and the rung that it chose, or
  // has one chosen and begins. decides: where it is another, it begins anew. forget(kUnfinished) ends it.
  Unfinished go_on(const std::function<RungChoice()>& choose, const std::string& decides = "") const;

  // choose_rung() with the pilot's progress shown and an interruption heard (PilotInterrupted). trials: about as many as the
  // pilot makes. question: what only the caller knows; the rung asked for, accuracy, index and options are filled in.
  RungChoice choose_rung(RungQuestion question, double trials, const std::vector<Parameters>& samples) const;
  // For a study of designs. store: the name of its evaluations, where note_choice() has kept what a pilot chose.
  RungChoice rung_of_designs(const DesignsTried& tried, const std::string& store) const;
  // For a study of a scatter. With a store, the one it was begun with, or the one that is chosen and noted now.
  RungChoice choose_rung_of_scatter(const ScatterAsked& asked) const;
  RungChoice rung_of_scatter(const ScatterAsked& asked, SampleStore& store) const;

  // The model of a scatter's samples on a rung, at these options: lanes where they serve.
  std::unique_ptr<SampleModel> model_of_scatter(const std::string& rung, const RandomInputs& inputs,
                                                const RunOptions& run) const;
  // On a rung that the study names itself, with the options asked for and one step for all samples, which the store keeps.
  // Throws OptionRefused.
  std::unique_ptr<SampleModel> model_on(const std::string& rung, const RandomInputs& inputs, SampleStore& store) const;
  // common_step() of the scatter's pilot samples [s], each of whose motions is kept in the store as soon as it is followed.
  double common_step_of_scatter(const std::string& rung, const RandomInputs& inputs, const RunOptions& run,
                                SampleStore& store) const;
  // Measured once on a few samples, and noted, so that a study that goes on says the same. run: with the step, integrator and
  // tolerance of the study's runs. store: may be none.
  StudySteps steps_of_scatter(const ScatterAsked& asked, const RunOptions& run, const std::string& rung,
                              SampleStore* store) const;

 private:
  std::shared_ptr<const Mechanism> mechanism_;
  StudyRunOptions options_;
};

inline constexpr double kPilotTrials = 24.0, kPilotTrialsOfScatter = 72.0;

// What rung_of_scatter() keeps.
void note_choice(SampleStore& store, const RungChoice& choice);
void note_choice(EvaluationStore& store, const RungChoice& choice);
// Nothing where no run is stored yet, and none was chosen.
std::optional<RungChoice> stored_choice(const SampleStore& store);

}  // namespace boresight
