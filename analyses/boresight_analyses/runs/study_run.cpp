#include "boresight_analyses/runs/study_run.hpp"

#include <algorithm>
#include <cstdio>
#include <cstdlib>

#include "boresight/io/content_hash.hpp"
#include "boresight/mechanism/interruption.hpp"
#include "boresight/rungs/option_check.hpp"
#include "boresight_analyses/runs/scatter_draws.hpp"
#include "boresight_analyses/runs/stored_header.hpp"
#include "boresight_analyses/runs/stored_pilot.hpp"
#include "boresight_analyses/study/lane_sample_model.hpp"
#include "boresight_analyses/study/setup_samples.hpp"
#include "boresight_analyses/study/study_error.hpp"

namespace boresight {
namespace {

class Unseen final : public Stage {
 public:
  void update(double, double, const std::string&) override {}
  void clear() override {}
};

std::string exact(double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%.17g", value);
  return text;
}

// Nothing where there is none, or one that was cut short as it was made, or damaged: who opens it to go on sees to that.
std::unique_ptr<SampleStore> readable_store(const std::filesystem::path& file) {
  try {
    return std::filesystem::exists(file) ? std::make_unique<SampleStore>(file) : nullptr;
  } catch (const StoreRefused&) {
    return nullptr;
  }
}

}  // namespace

StudyRun::StudyRun(std::shared_ptr<const Mechanism> mechanism, StudyRunOptions options)
    : mechanism_(std::move(mechanism)), options_(std::move(options)) {}

std::unique_ptr<Stage> StudyRun::stage(double total, const std::string& unit) const {
  return options_.stage ? options_.stage(total, unit) : std::make_unique<Unseen>();
}

std::string StudyRun::hash(const std::string& decides) const {
  ContentHash hash;
  hash.add(options_.identity);
  if (!decides.empty()) hash.add(decides);
  return hash.hexadecimal();
}

std::map<std::string, std::string> StudyRun::facts(const std::string& decides) const {
  std::map<std::string, std::string> all{{"study", hash(decides)}};
  if (!options_.version.empty()) all[kVersionFact] = options_.version;
  return all;
}

std::unique_ptr<SampleStore> StudyRun::open_samples(const std::string& decides,
                                                    const std::vector<std::string>& parameters,
                                                    const std::string& name) const {
  if (options_.begun)
    options_.begun("begun and not yet ended: " + name + " holds what there is; the same command goes on");
  auto store = std::make_unique<SampleStore>(options_.folder / name, facts(decides), parameters);
  if (options_.damaged && !store->damage().empty()) options_.damaged(store->damage());
  return store;
}

std::unique_ptr<EvaluationStore> StudyRun::open_evaluations(const std::string& name,
                                                            const std::vector<std::string>& variables,
                                                            const std::string& rung, double step,
                                                            const std::string& model) const {
  if (options_.begun)
    options_.begun("begun and not yet ended: the same command goes on, and reuses what is in " + name);
  // Values of another model are worth nothing here, and are computed anew.
  const std::string decides = rung + " at " + exact(step) + " s, " + model;
  if (auto found = readable_store(options_.folder / name);
      found && found->fact("study") == hash() && found->fact("model") != decides) {
    found->require(facts());
    found.reset();
    forget(name);
  }
  std::map<std::string, std::string> own = facts();
  own["rung"] = rung;
  own["model"] = decides;
  auto store = std::make_unique<EvaluationStore>(options_.folder / name, own, variables, rung, step);
  if (options_.damaged && !store->damage().empty()) options_.damaged(store->damage());
  return store;
}

void StudyRun::forget(const std::string& name) const {
  std::error_code error;  // what cannot be removed is gone on with
  for (const char* suffix : {"", "-wal", "-shm"}) std::filesystem::remove(options_.folder / (name + suffix), error);
}

Unfinished StudyRun::go_on(const std::function<RungChoice()>& choose, const std::string& decides) const {
  const std::filesystem::path file = options_.folder / kUnfinished;
  if (auto found = readable_store(file); found && found->fact("study") != hash(decides)) {
    found.reset();
    forget(kUnfinished);
  }
  if (std::filesystem::exists(file)) {
    std::unique_ptr<SampleStore> store = open_samples(decides, KeptResults::columns(), kUnfinished);
    if (std::optional<RungChoice> begun_with = stored_choice(*store))
      return {std::make_unique<KeptResults>(std::move(store)), std::move(*begun_with)};
  }
  const RungChoice choice = choose();
  const auto make = [this, choice, decides] {
    std::unique_ptr<SampleStore> store = open_samples(decides, KeptResults::columns(), kUnfinished);
    note_choice(*store, choice);
    store->use_rung(choice.name, choice.step);
    return store;
  };
  // A pilot has taken its time; without one nothing is in the folder before there is something to keep.
  if (choice.pilot) return {std::make_unique<KeptResults>(make()), choice};
  return {std::make_unique<KeptResults>(make), choice};
}

RungChoice StudyRun::choose_rung(RungQuestion question, double trials, const std::vector<Parameters>& samples) const {
  const std::unique_ptr<Stage> progress = stage(trials, "trials of the pilot");
  question.asked = options_.rung;
  question.accuracy = options_.accuracy;
  question.index = options_.index;
  question.step = options_.run.step;
  question.integrator = options_.run.integrator;
  question.tolerance = options_.run.tolerance;
  question.progress = [&](int trial) {
    progress->update(trial, "finding the cheapest rung that meets the accuracy");
    return !interrupted();
  };
  return boresight::choose_rung(question, mechanism_, samples);
}

RungChoice StudyRun::rung_of_designs(const DesignsTried& tried, const std::string& store) const {
  // What a pilot chooses hangs on times. A store that cannot be gone on with is refused before there is a pilot.
  if (const auto found = readable_store(options_.folder / store); found && found->fact("study") == hash()) {
    found->require(facts());
    if (std::optional<RungChoice> begun_with = stored_choice(*found); begun_with && begun_with->pilot)
      return std::move(*begun_with);
  }
  RungQuestion question{.wants_multibody = !options_.run.formulation.empty() || !options_.run.stabilisation.empty(),
                        .integrators = true,
                        .lanes = tried.lanes};
  if (!tried.statistic) {
    std::vector<Parameters> motions;
    for (const std::vector<Parameters>& samples : tried.samples)
      motions.insert(motions.end(), samples.begin(), samples.end());
    return choose_rung(question, kPilotTrialsOfScatter, motions);
  }
  question.statistic = tried.statistic;
  question.scene_varies = tried.scene_varies;
  question.runs = tried.runs / tried.samples.size();
  question.jobs = options_.jobs;
  std::vector<RungChoice> choices;
  for (const std::vector<Parameters>& samples : tried.samples)
    choices.push_back(choose_rung(question, kPilotTrialsOfScatter, samples));
  return most_demanding(choices);
}

RungChoice StudyRun::choose_rung_of_scatter(const ScatterAsked& asked) const {
  std::vector<Parameters> draws;
  if (options_.rung == "auto" && options_.accuracy) draws = draws_of_scatter(asked.inputs, *mechanism_, kDrawsForPilot);
  return choose_rung({.wants_multibody = !options_.run.formulation.empty() || !options_.run.stabilisation.empty(),
                      .integrators = asked.integrators,
                      .lanes = asked.lanes,
                      .statistic = asked.statistic,
                      .scene_varies = scene_varies(asked.inputs),
                      .runs = asked.runs,
                      .jobs = options_.jobs},
                     kPilotTrialsOfScatter, draws);
}

RungChoice StudyRun::rung_of_scatter(const ScatterAsked& asked, SampleStore& store) const {
  if (const std::optional<RungChoice> begun_with = stored_choice(store)) return *begun_with;
  RungChoice choice = choose_rung_of_scatter(asked);
  note_choice(store, choice);
  return choice;
}

std::unique_ptr<SampleModel> StudyRun::model_of_scatter(const std::string& rung, const RandomInputs& inputs,
                                                        const RunOptions& run) const {
  std::vector<double> typical;
  if (!mechanism_->description().errors.empty())
    typical = typical_errors(draws_of_scatter(inputs, *mechanism_, kDrawsForPilot));
  return sample_model(
      rung, mechanism_,
      [mechanism = mechanism_, inputs](std::span<const double> values) {
        return inputs.parameters_with(*mechanism, values);
      },
      options_.index, run, scene_varies(inputs), typical);
}

std::unique_ptr<SampleModel> StudyRun::model_on(const std::string& rung, const RandomInputs& inputs,
                                                SampleStore& store) const {
  RunOptions run = options_.run;
  check_options(run, rung, *mechanism_, mechanism_->parameters());
  const bool lanes = rung == "perturbation" && LaneSampleModel::serve(*mechanism_, options_.index, run);
  if (!lanes && run.step == 0.0) run.step = common_step_of_scatter(rung, inputs, run, store);
  std::unique_ptr<SampleModel> model = model_of_scatter(rung, inputs, run);
  store.use_rung(rung, model->step());
  return model;
}

double StudyRun::common_step_of_scatter(const std::string& rung, const RandomInputs& inputs, const RunOptions& run,
                                        SampleStore& store) const {
  const std::vector<Parameters> samples = pilot_samples(inputs, *mechanism_);
  const auto fact = [](std::size_t k) { return "step_of_pilot_" + std::to_string(k); };
  std::vector<double> known;
  for (std::size_t k = 0; k < samples.size(); ++k) {
    const std::string kept = store.fact(fact(k));
    known.push_back(kept.empty() ? 0.0 : std::strtod(kept.c_str(), nullptr));
  }
  return common_step(rung, mechanism_, samples, run, known,
                     [&](std::size_t k, double step) { store.note(fact(k), exact(step)); });
}

StudySteps StudyRun::steps_of_scatter(const ScatterAsked& asked, const RunOptions& run, const std::string& rung,
                                      SampleStore* store) const {
  if (store != nullptr)
    if (const std::string why = store->fact("discretisation_why"); !why.empty()) {
      const std::string relative = store->fact("discretisation"), of = store->fact("discretisation_of"),
                        runs = store->fact("discretisation_runs");
      // Measured for another statistic it says nothing of this one; and what was too dear for a small study may not be for a larger one.
      const bool larger = relative.empty() && !runs.empty() &&
                          static_cast<double>(asked.runs) > 1.5 * std::strtod(runs.c_str(), nullptr);
      if ((of.empty() || of == asked.statistic.title()) && !larger)
        return {relative.empty() ? kNotMeasured : std::strtod(relative.c_str(), nullptr), why};
    }
  const RungSetup setup{
      .rung = rung,
      .formulation = run.formulation,
      .stabilisation = run.stabilisation,
      .integrator = run.integrator,
      .step = run.step,
      .tolerance = run.tolerance,
      .lanes = asked.lanes && rung == "perturbation" && LaneSampleModel::serve(*mechanism_, options_.index, run)};
  constexpr double kMostRuns = 512.0;
  const std::unique_ptr<Stage> progress = stage(kMostRuns, "runs that measure what the steps do");
  double done = 0.0;
  const StudyErrorOptions options{.index = options_.index,
                                  .statistic = asked.statistic,
                                  .scene_varies = scene_varies(asked.inputs),
                                  .runs = asked.runs,
                                  .jobs = options_.jobs,
                                  .advance = [&] {
                                    progress->update(std::min(kMostRuns, done++), "");
                                    return !interrupted();
                                  }};
  StudyDiscretisation found;
  try {
    found = measure_study_discretisation(mechanism_, draws_of_scatter(asked.inputs, *mechanism_, kDrawsForPilot), setup,
                                         options);
  } catch (const Interrupted&) {  // the study's own runs are there, and are kept
  }
  progress->clear();
  if (interrupted())
    return {kNotMeasured, "not measured: the study was interrupted before; the same command measures it", true};
  StudySteps steps{found.measured ? found.relative : kNotMeasured, found.why};
  if (store != nullptr) {
    // The reason last: it says that the rest is there.
    store->note("discretisation", found.measured ? exact(steps.relative) : "");
    store->note("discretisation_of", asked.statistic.title());
    store->note("discretisation_runs", std::to_string(asked.runs));
    store->note("discretisation_why", steps.why);
  }
  return steps;
}

namespace {

template <typename Store>
void note_in(Store& store, const RungChoice& choice) {
  store.note("rung_why", choice.why);
  store.note("integrator", choice.integrator);
  store.note("tolerance", exact(choice.tolerance));
  if (choice.pilot) store.note("pilot", text_of(*choice.pilot));
}

}  // namespace

void note_choice(SampleStore& store, const RungChoice& choice) { note_in(store, choice); }
void note_choice(EvaluationStore& store, const RungChoice& choice) { note_in(store, choice); }

std::optional<RungChoice> stored_choice(const SampleStore& store) {
  const std::vector<SampleStore::StoredRung> stored = store.rungs();
  if (stored.empty()) return {};
  const std::string tolerance = store.fact("tolerance"), why = store.fact("rung_why");
  return RungChoice{.name = stored.front().name,
                    .why = why.empty() ? "chosen when the study was begun" : why,
                    .step = stored.front().step,
                    .integrator = store.fact("integrator"),
                    .tolerance = tolerance.empty() ? 0.0 : std::strtod(tolerance.c_str(), nullptr),
                    .pilot = pilot_of_text(store.fact("pilot"))};
}

}  // namespace boresight
