#include "stored_study.hpp"

#include <filesystem>

#include "boresight/io/content_hash.hpp"
#include "scatter_parts.hpp"
#include "study_input.hpp"
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
  return choose_rung_of_scatter(command, study, run, mechanism, pilot_samples(inputs, *mechanism));
}

}  // namespace boresight::app
