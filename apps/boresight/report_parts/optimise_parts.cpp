#include "report_parts/optimise_parts.hpp"

#include <algorithm>
#include <filesystem>

#include "boresight/io/content_hash.hpp"
#include "boresight/ladder/ladder.hpp"
#include "boresight/rungs/integrator_choice.hpp"
#include "boresight_analyses/study/rung_sample_model.hpp"
#include "results/stored_study.hpp"
#include "results/summary.hpp"

namespace boresight::app {

std::string next_rung_up(const std::string& rung) {
  // Envelope and quasistatic are both static answers; what confirms either is a motion with impacts.
  if (rung == "envelope" || rung == "quasistatic") return "perturbation";
  return rung_names().back();
}

RunOptions options_on(const std::string& rung, const std::shared_ptr<const Mechanism>& mechanism,
                      const std::vector<Parameters>& corners, RunOptions run) {
  const std::vector<std::string> known = integrator_names(rung);
  if (!run.integrator.empty() && std::find(known.begin(), known.end(), run.integrator) == known.end()) {
    run.integrator.clear();
    run.tolerance = 0.0;
  }
  const bool adaptive = !run.integrator.empty() && run.integrator != "rk4";
  if (!adaptive && run.step == 0.0)
    run.step = with_options_checked([&] { return common_step(rung, mechanism, corners, run); });
  return run;
}

std::unique_ptr<EvaluationStore> open_evaluations(const OutputDirectory& out, const std::string& verb,
                                                  const std::string& name, const std::vector<std::string>& variables,
                                                  const std::string& rung, double step) {
  announce_begun(out, verb, "begun and not yet ended: the same command goes on, and reuses what is in " + name);
  ContentHash hash;
  hash.add(out.identity().dump());
  auto store = std::make_unique<EvaluationStore>(
      out.path() / name, std::map<std::string, std::string>{{"study", hash.hexadecimal()}, {"rung", rung}}, variables,
      rung, step);
  tell_of_damage(store->damage());
  return store;
}

}  // namespace boresight::app
