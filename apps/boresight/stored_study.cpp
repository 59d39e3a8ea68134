#include "stored_study.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "boresight/io/content_hash.hpp"
#include "boresight_analyses/study/lane_sample_model.hpp"
#include "boresight_analyses/study/study_error.hpp"
#include "interruption.hpp"
#include "progress.hpp"
#include "scatter_parts.hpp"
#include "summary.hpp"

namespace boresight::app {

SampleStore open_runs(const OutputDirectory& out, const std::string& verb, const RandomInputs& inputs,
                      const std::string& text, bool resume) {
  const std::filesystem::path file = out.path() / "samples.db";
  if (std::filesystem::exists(file) && !resume)
    throw OutputDirectoryError(
        "--out " + out.path().string() +
        ": holds runs of this study already; --resume goes on with them, another --out begins anew");
  announce_begun(out, verb, "begun and not yet ended: samples.db holds what there is; go on with --resume");
  ContentHash hash;
  hash.add(out.identity().dump());
  hash.add(text);
  return SampleStore(file, {{"study", hash.hexadecimal()}}, names_of(inputs));
}

void note_choice(SampleStore& store, const RungChoice& choice) {
  store.note("rung_why", choice.why);
  store.note("integrator", choice.integrator);
  store.note("tolerance", fmt::format("{:.17g}", choice.tolerance));
}

RungChoice stored_choice(const SampleStore& store) {
  const std::vector<SampleStore::StoredRung> stored = store.rungs();
  const std::string tolerance = store.fact("tolerance"), why = store.fact("rung_why");
  return {.name = stored.front().name,
          .why = why.empty() ? "chosen when the study was begun" : why,
          .step = stored.front().step,
          .integrator = store.fact("integrator"),
          .tolerance = tolerance.empty() ? 0.0 : std::stod(tolerance)};
}

RungChoice rung_of_study(const Command& command, const Study& study, const std::shared_ptr<const Mechanism>& mechanism,
                         const ScatterAsked& asked, const RunOptions& run, SampleStore& store) {
  if (!store.rungs().empty()) return stored_choice(store);
  const RungChoice choice = choose_rung_of_scatter(command, study, run, mechanism, asked);
  note_choice(store, choice);
  return choice;
}

StudySteps steps_of_study(const Command& command, const Study& study, const std::shared_ptr<const Mechanism>& mechanism,
                          const ScatterAsked& asked, const RunOptions& run, const std::string& rung, SampleStore* store) {
  if (store != nullptr)
    if (const std::string why = store->fact("discretisation_why"); !why.empty()) {
      const std::string relative = store->fact("discretisation");
      return {relative.empty() ? kNotMeasured : std::stod(relative), why};
    }
  const Way way{.rung = rung,
                .formulation = run.formulation,
                .stabilisation = run.stabilisation,
                .integrator = run.integrator,
                .step = run.step,
                .tolerance = run.tolerance,
                .lanes = asked.lanes && rung == "perturbation" && LaneSampleModel::serve(*mechanism, study.index, run)};
  Progress progress(command.quiet, 512.0, "runs that measure what the steps do");
  double done = 0.0;
  const StudyErrorOptions options{.index = study.index,
                                  .statistic = asked.statistic,
                                  .scene_varies = scene_varies(asked.inputs),
                                  .runs = asked.runs,
                                  .jobs = command.jobs,
                                  .advance = [&] {
                                    progress.update(std::min(512.0, done++), "");
                                    return !interrupted();
                                  }};
  const StudyDiscretisation found = with_options_checked([&] {
    return measure_study_discretisation(mechanism, draws_of_scatter(asked.inputs, *mechanism, kDrawsForPilot), way, options);
  });
  progress.clear();
  const StudySteps steps{found.measured ? found.relative : kNotMeasured, found.why};
  if (store != nullptr && !interrupted()) {
    store->note("discretisation_why", steps.why);
    if (found.measured) store->note("discretisation", fmt::format("{:.17g}", steps.relative));
  }
  return steps;
}

}  // namespace boresight::app
