#include "montecarlo/several_rungs.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "report_parts/report_parts.hpp"
#include "results/study_warnings.hpp"
#include "terminal/readable.hpp"

namespace boresight::app {

namespace {

ReportedInterval share_within(const Requirement& requirement, const IndependentInterval& excess) {
  return {1.0 - excess.value,
          std::clamp(1.0 - excess.high, 0.0, 1.0),
          std::clamp(1.0 - excess.low, 0.0, 1.0),
          requirement.confidence,
          requirement.confidence,
          false,
          excess.basis,
          "independent"};
}

}  // namespace

RequirementShown requirement_shown(const Requirement& requirement, const IndependentInterval& excess,
                                   const IndependentInterval* excess_within_error, double model_error) {
  const double most = 1.0 - requirement.probability;  // that may exceed the limit
  RequirementShown shown{.share = share_within(requirement, excess), .model_error = model_error};
  shown.met = shown.met_by_samples = excess.high <= most;
  if (excess_within_error == nullptr) return shown;
  shown.within_error = share_within(requirement, *excess_within_error);
  shown.met = shown.met && excess_within_error->high <= most;
  return shown;
}

Json requirement_json(const Requirement& requirement, const RequirementShown& shown) {
  Json json = {{"limit", requirement.limit},
               {"asked_probability", requirement.probability},
               {"confidence", requirement.confidence},
               {"met", shown.met},
               {"met_by_samples", shown.met_by_samples},
               {"model_error", shown.model_error},
               {"probability", interval_json(shown.share)}};
  if (shown.within_error) json["within_model_error"] = interval_json(*shown.within_error);
  for (const char* share : {"probability", "within_model_error"})
    if (json.contains(share)) json[share]["bounds"] = "one-sided, each at this confidence";
  return json;
}

std::string requirement_words(const RequirementShown& shown, const std::string& rung) {
  if (shown.met) return "the requirement is met";
  if (!shown.met_by_samples) return "the requirement is not shown to be met";
  return fmt::format(
      "the samples show the requirement, the model does not: the {} rung and its steps may be off by {}, and if every "
      "sample were larger by what may be missed of it, the share would be {}",
      rung, readable_error(shown.model_error), readable_near_all(shown.within_error->value));
}

Json model_error_json(const std::string& rung, double rung_error, const StudySteps& steps) {
  return {{"discretisation", {{"relative", number_json(steps.relative)}, {"why", steps.why}}},
          {"rung",
           {{"relative", rung_error},
            {"why",
             "unbiased for the " + rung + " rung; its own estimate of what that leaves out, mean over the samples"}}}};
}

RungChoice named_rung(const std::string& rung) { return {rung, "the study names its rungs", 0.0}; }

std::vector<std::string> several_rungs_warnings(const SeveralRungs& s) {
  std::vector<std::string> warnings = study_warnings(*s.question.mechanism, "perturbation");
  const MonteCarloPlan& plan = s.question.plan;
  if (plan.samples_of_budget)
    warnings.push_back("samples = " + std::to_string(plan.samples) + " is not used: the budget of " +
                       (plan.fidelities ? "fidelities" : "tail") + " decides how many samples there are");
  if (plan.confidence_of_requirement)
    warnings.push_back("the study's own confidence is not used: what tail states has the requirement's");
  return warnings;
}

std::string overspent(double spent, double budget) {
  constexpr double kMuchMore = 2.5;  // counted costs are true to about a factor of two
  if (!(spent > kMuchMore * budget)) return "";
  return fmt::format(
      "{} of CPU were spent, {:.2g} times the budget: it is divided by what samples are counted to cost, which makes "
      "studies repeatable, and here they cost more",
      readable(spent, "s"), spent / budget);
}

Json several_rungs_summary(const SeveralRungs& s, const std::string& rung, const std::vector<std::string>& warnings,
                           const SampleStore::Cost& earlier) {
  Json json = s.own.head(s.question.study, named_rung(rung), s.watch, warnings, false, earlier);
  json["seed"] = s.question.plan.design.seed;
  json["index"] = {{"quantity", s.question.study.index.quantity},
                   {"statistic", s.question.study.index.statistic},
                   {"unit", s.question.study.index.si_unit()}};
  return json;
}

report::Document several_rungs_report(const SeveralRungs& s, const std::string& rung, const std::string& leaves_out,
                                      const std::string& data, const std::vector<std::string>& warnings) {
  report::Document document{.title = s.question.mechanism->name(), .verb = "montecarlo"};
  document.warnings = warnings;
  document.sections.push_back(
      {.id = "model", .title = "What the " + rung + " rung leaves out", .items = {report::Text{leaves_out}}});
  document.provenance = provenance_of(s.command, *s.question.mechanism, named_rung(rung));
  document.provenance.back() = {"Data", data};
  document.provenance.push_back({"Study hash", s.question.study.content_hash});
  document.provenance.push_back({"Seed", static_cast<double>(s.question.plan.design.seed)});
  return document;
}

}  // namespace boresight::app
