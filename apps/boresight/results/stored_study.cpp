#include "results/stored_study.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "boresight/io/content_hash.hpp"
#include "boresight/mechanism/interruption.hpp"
#include "boresight_analyses/runs/scatter_draws.hpp"
#include "boresight_analyses/study/lane_sample_model.hpp"
#include "boresight_analyses/study/study_error.hpp"
#include "command_line/declared_option.hpp"
#include "results/scatter_parts.hpp"
#include "results/stored_pilot.hpp"
#include "results/summary.hpp"
#include "terminal/interruption.hpp"
#include "terminal/progress.hpp"
#include "terminal/readable.hpp"
#include "terminal/terminal.hpp"

namespace boresight::app {

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

void tell_of_damage(const std::string& damage) {
  if (!damage.empty()) fmt::print(stderr, "boresight: {}\n", printable(damage));
}

void add_earlier_cost(nlohmann::ordered_json& summary, const SampleStore::Cost& earlier) {
  summary["cpu_seconds"] = summary["cpu_seconds"].get<double>() + earlier.cpu_seconds;
  summary["wall_seconds"] = summary["wall_seconds"].get<double>() + earlier.wall_seconds;
}

void bring_runs(const OutputDirectory& out, const std::string& study_hash, const Resumption& resumption) {
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
    if (found.fact("study") != study_hash)
      throw OutputDirectoryError("--from " + resumption.from +
                                 ": holds the samples of another study (other file, settings or options)");
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

SampleStore open_runs(const OutputDirectory& out, const std::string& verb, const RandomInputs& inputs,
                      const std::string& text, const Resumption& resumption) {
  ContentHash hash;
  hash.add(out.identity().dump());
  hash.add(text);
  bring_runs(out, hash.hexadecimal(), resumption);
  const std::filesystem::path file = out.path() / "samples.db";
  announce_begun(out, verb, "begun and not yet ended: samples.db holds what there is; the same command goes on");
  return SampleStore(file, {{"study", hash.hexadecimal()}}, inputs.names());
}

void note_choice(SampleStore& store, const RungChoice& choice) {
  store.note("rung_why", choice.why);
  store.note("integrator", choice.integrator);
  store.note("tolerance", fmt::format("{:.17g}", choice.tolerance));
  if (choice.pilot) store.note("pilot", text_of(*choice.pilot));
}

RungChoice stored_choice(const SampleStore& store) {
  const std::vector<SampleStore::StoredRung> stored = store.rungs();
  const std::string tolerance = store.fact("tolerance"), why = store.fact("rung_why");
  return {.name = stored.front().name,
          .why = why.empty() ? "chosen when the study was begun" : why,
          .step = stored.front().step,
          .integrator = store.fact("integrator"),
          .tolerance = tolerance.empty() ? 0.0 : std::stod(tolerance),
          .pilot = pilot_of_text(store.fact("pilot"))};
}

RungChoice rung_of_study(const Command& command, const Study& study, const std::shared_ptr<const Mechanism>& mechanism,
                         const ScatterAsked& asked, const RunOptions& run, SampleStore& store) {
  if (!store.rungs().empty()) return stored_choice(store);
  RungChoice choice = choose_rung_of_scatter(command, study, run, mechanism, asked);
  note_choice(store, choice);
  return choice;
}

std::string no_run_done(bool stopped, std::uint64_t before, std::uint64_t after, double seconds) {
  if (!stopped || after > before) return "";
  return fmt::format(
      "no run was done in these {}: one that is cut off is computed anew, so a start must last longer than one run",
      readable(seconds, "s"));
}

double kept_common_step(const std::string& rung, const std::shared_ptr<const Mechanism>& mechanism,
                        const RandomInputs& inputs, const RunOptions& run, SampleStore& store) {
  const std::vector<Parameters> samples = pilot_samples(inputs, *mechanism);
  const auto fact = [](std::size_t k) { return fmt::format("step_of_pilot_{}", k); };
  std::vector<double> known;
  for (std::size_t k = 0; k < samples.size(); ++k) {
    const std::string kept = store.fact(fact(k));
    known.push_back(kept.empty() ? 0.0 : std::stod(kept));
  }
  return with_options_checked([&] {
    return common_step(rung, mechanism, samples, run, known,
                       [&](std::size_t k, double step) { store.note(fact(k), fmt::format("{:.17g}", step)); });
  });
}

StudySteps steps_of_study(const Command& command, const Study& study, const std::shared_ptr<const Mechanism>& mechanism,
                          const ScatterAsked& asked, const RunOptions& run, const std::string& rung,
                          SampleStore* store) {
  if (store != nullptr)
    if (const std::string why = store->fact("discretisation_why"); !why.empty()) {
      const std::string relative = store->fact("discretisation");
      return {relative.empty() ? kNotMeasured : std::stod(relative), why};
    }
  const RungSetup setup{
      .rung = rung,
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
  StudyDiscretisation found;
  try {
    found = with_options_checked([&] {
      return measure_study_discretisation(mechanism, draws_of_scatter(asked.inputs, *mechanism, kDrawsForPilot), setup,
                                          options);
    });
  } catch (const Interrupted&) {  // the study's own runs are there, and are kept
  }
  progress.clear();
  if (interrupted())
    return {kNotMeasured, "not measured: the study was interrupted before; the same command measures it", true};
  StudySteps steps{found.measured ? found.relative : kNotMeasured, found.why};
  if (store != nullptr) {
    store->note("discretisation_why", steps.why);
    if (found.measured) store->note("discretisation", fmt::format("{:.17g}", steps.relative));
  }
  return steps;
}

}  // namespace boresight::app
