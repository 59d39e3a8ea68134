#include "boresight_analyses/study/pilot.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "boresight/mechanism/built_mechanism.hpp"
#include "boresight/mechanism/error.hpp"
#include "boresight/pointing/relative_text.hpp"
#include "boresight_analyses/study/geometric_sample_model.hpp"
#include "boresight_analyses/study/measurement.hpp"
#include "boresight_analyses/study/pilot_choice.hpp"

namespace boresight {
namespace {

// Of what the study's runs would take on multibody, the pilot may take this share where that is long, and no more than the
// other where it is short.
constexpr double kShareOfLongStudy = 0.02, kShareOfShortStudy = 0.5;

}  // namespace

double most_seconds(const PilotOptions& options, double multibody_seconds) {
  if (options.runs == 0) return options.most_seconds;
  const double study = static_cast<double>(options.runs) * multibody_seconds;
  return std::max(kShareOfLongStudy * study, std::min(options.most_seconds, kShareOfShortStudy * study));
}

std::vector<double> stated_probabilities(const ScatterStatistic& asked) {
  return {0.0, 0.5, 0.95, 0.99, 0.9973, asked.probability};
}

PilotResult run_pilot(std::shared_ptr<const Mechanism> mechanism, const std::vector<Parameters>& samples,
                      const PilotOptions& options) {
  if (GeometricErrors::serve(*mechanism) && std::any_of(samples.begin(), samples.end(), has_errors))
    return pilot_of_geometry(std::move(mechanism), samples, options);
  return options.statistic ? pilot_of_scatter(std::move(mechanism), samples, options)
                           : pilot_of_motions(std::move(mechanism), samples, options);
}

bool indistinguishable(const PilotTrial& trial, const PilotResult& result) {
  if (!trial.refusal.empty() || RungSetup{.rung = trial.rung}.stepless()) return false;
  // What is uncertain of the difference is no more than twice what the reference is good to: less would tell nothing.
  const double uncertain = trial.error - std::abs(trial.difference);
  return std::abs(trial.difference) <= std::max(uncertain, result.accuracy) &&
         trial.error <= 2.0 * result.reference_error;
}

void conclude(PilotResult& result) {
  const auto cheaper = [&](int k) {
    return result.chosen < 0 || result.trials[k].cpu_seconds < result.trials[result.chosen].cpu_seconds;
  };
  const int trials = static_cast<int>(result.trials.size());
  const bool good_reference = result.reference_error <= result.accuracy;
  result.chosen = -1;
  for (int k = 0; k < trials; ++k)
    if (result.trials[k].accepted && cheaper(k)) result.chosen = k;
  result.met = result.chosen >= 0;
  bool told_apart = true;
  if (!result.met && !good_reference) {
    for (int k = 0; k < trials; ++k)
      if (indistinguishable(result.trials[k], result) && cheaper(k)) result.chosen = k;
    told_apart = result.chosen < 0;
  }
  if (result.chosen < 0)
    for (int k = 0; k < trials; ++k)
      if (result.trials[k].refusal.empty() &&
          (result.chosen < 0 || result.trials[k].error < result.trials[result.chosen].error))
        result.chosen = k;
  if (result.chosen < 0) throw ComputationError("no rung can follow this motion: " + result.trials.back().refusal);

  const PilotTrial& best = result.trials[result.chosen];
  const double a = 100.0 * result.accuracy;
  const std::string error = relative_text(best.error), reference = relative_text(result.reference_error);
  char pairs[60] = "";
  if (result.pairs > 0) std::snprintf(pairs, sizeof pairs, " over %zu paired samples", result.pairs);
  const std::string scatter =
      result.pairs == 0 && result.scatter > 0.1 * result.accuracy
          ? "; single motions scatter by " + relative_text(result.scatter) + ", standard deviation"
          : "";
  char text[600];
  if (result.met)
    std::snprintf(text, sizeof text,
                  "the cheapest that comes within %.3g %% of multibody in the %s: off by %s at most%s (reference "
                  "good to %s)",
                  a, result.index.c_str(), error.c_str(), pairs, reference.c_str());
  else if (!good_reference)
    std::snprintf(text, sizeof text,
                  "an accuracy of %.3g %% cannot be shown: multibody itself is good to %s only in the %s%s%s; this %s",
                  a, reference.c_str(), result.index.c_str(), pairs, scatter.c_str(),
                  told_apart ? "one comes nearest" : "is the cheapest that cannot be told from it");
  else
    std::snprintf(
        text, sizeof text,
        "none is shown to come within %.3g %% of multibody in the %s; this one comes nearest: off by %s at most%s "
        "(reference good to %s)",
        a, result.index.c_str(), error.c_str(), pairs, reference.c_str());
  result.why = text;
}

}  // namespace boresight
