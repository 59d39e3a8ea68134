#include "montecarlo/montecarlo_summary.hpp"

#include "boresight/keys/letters.hpp"
#include "results/scatter_parts.hpp"
#include "results/summary.hpp"

namespace boresight::app {
namespace {

Json part_json(const StatedError& part) {
  return {{"value", number_json(part.value)}, {"relative", number_json(part.relative)}, {"why", part.why}};
}

Json error_json(const ErrorStatement& e) {
  return {{"of", e.of},
          {"sampling", part_json(e.sampling)},
          {"discretisation", part_json(e.discretisation)},
          {"rung", part_json(e.rung)},
          {"dominant", e.dominant}};
}

}  // namespace

Json montecarlo_summary(const MonteCarloStudy& s, const Stopwatch& watch, const VerbStudy& own,
                        const SampleStore& store) {
  Json json = own.head(s.study, s.rung, watch, s.warnings, s.result.ended == Ended::interrupted, store.earlier());
  json["seed"] = s.plan.design.seed;
  json["design"] = s.plan.design.text();
  json["step"] = store.rungs().front().step;
  json["samples"] = s.estimates.samples;
  json["samples_asked"] = s.plan.samples;
  json["samples_stored"] = s.result.stored;
  json["ended"] = to_string(s.result.ended);
  json["failed"] = s.estimates.failed;
  add_first_failure(json, s.shown.failures, "sample");
  Json& index = json["index"] = {
      {"quantity", s.study.index.quantity}, {"statistic", s.study.index.statistic}, {"unit", s.study.index.si_unit()}};
  for (const NamedEstimate& e : s.estimates.index) index[e.name] = interval_json(e.interval);
  if (s.estimates.requirement) {
    const Requirement& asked = *s.plan.requirement;
    json["requirement"] = {{"limit", asked.limit},
                           {"asked_probability", asked.probability},
                           {"confidence", asked.confidence},
                           {"met", s.estimates.requirement->met},
                           {"probability", interval_json(s.estimates.requirement->probability)},
                           {"fewest_samples", s.estimates.requirement->fewest_samples},
                           {"model_error", s.estimates.requirement->model_error},
                           {"met_by_samples", s.estimates.requirement->met_by_samples}};
    const Judgement& judgement = s.estimates.requirement->judgement;
    if (s.estimates.requirement->within_error)
      json["requirement"]["within_model_error"] = interval_json(*s.estimates.requirement->within_error);
    for (const char* share : {"probability", "within_model_error"}) {
      if (!json["requirement"].contains(share)) continue;
      json["requirement"][share]["confidence"] = judgement.confidence;
      json["requirement"][share]["bounds"] = "one-sided, each at this confidence";
    }
    if (!judgement.why.empty()) json["requirement"]["judged"] = judgement.why;
  }
  for (const ErrorStatement& e : s.estimates.errors) {
    if (e.of == s.estimates.headline) json["error"] = error_json(e);
    json["errors"][e.of] = error_json(e);
  }
  json["random"] = Json::array();
  for (std::size_t i = 0; i < s.plan.inputs.size(); ++i) {
    const RandomParameter& p = s.plan.inputs.parameters[i];
    json["random"].push_back({{"parameters", p.paths},
                              {"unit", p.told_unit()},
                              {"distribution", first_letters(s.plan.inputs.text_of(i), 400)},
                              {"mean", number_json(p.distribution->mean())},
                              {"sd", number_json(p.distribution->sd())}});
  }
  json["replay"] = s.replay + " NUMBER";
  json["files"] = {"summary.json", "samples.db", "report.html", "report.json"};
  return json;
}

}  // namespace boresight::app
