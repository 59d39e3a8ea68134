#include "stored_study.hpp"

#include <filesystem>

#include "boresight/io/content_hash.hpp"
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
  // Whose folder this is has to be known before the first run is, or a kill would leave an orphan.
  if (!std::filesystem::exists(out.path() / "summary.json"))
    write_json(out, "summary.json",
               {{"verb", verb},
                {"version", BORESIGHT_VERSION},
                {"interrupted", true},
                {"warnings", {"begun and not yet ended: samples.db holds what there is; go on with --resume"}},
                {"identity", Json::parse(out.identity().dump())}});
  ContentHash hash;
  hash.add(out.identity().dump());
  hash.add(text);
  return SampleStore(file, {{"study", hash.hexadecimal()}}, names_of(inputs));
}

RungChoice rung_of_study(const Command& command, const Study& study, const std::shared_ptr<const Mechanism>& mechanism,
                         const RandomInputs& inputs, const RunOptions& run, const SampleStore& store) {
  const std::vector<SampleStore::StoredRung> stored = store.rungs();
  if (!stored.empty()) return {stored.front().name, "chosen when the study was begun", stored.front().step};
  constexpr double kPilotTrials = 72.0;  // about as many as it makes; it may need fewer
  Progress progress(command.quiet, kPilotTrials, "trials of the pilot");
  return choose_rung({.asked = command.rung,
                      .accuracy = command.accuracy ? command.accuracy : study.accuracy,
                      .wants_multibody = !run.formulation.empty() || !run.stabilisation.empty(),
                      .index = study.index,
                      .step = run.step,
                      .progress =
                          [&](int trial) {
                            progress.update(trial, "finding the cheapest rung that meets the accuracy");
                            return !interrupted();
                          }},
                     mechanism, pilot_samples(inputs, *mechanism));
}

}  // namespace boresight::app
