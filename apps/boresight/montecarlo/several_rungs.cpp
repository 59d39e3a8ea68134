#include "montecarlo/several_rungs.hpp"

#include <fmt/format.h>

#include "report_parts/report_parts.hpp"
#include "results/study_warnings.hpp"
#include "terminal/readable.hpp"

namespace boresight::app {

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
                                      const std::vector<std::string>& warnings) {
  report::Document document{.title = s.question.mechanism->name(), .verb = "montecarlo"};
  document.warnings = warnings;
  document.sections.push_back(
      {.id = "model", .title = "What the " + rung + " rung leaves out", .items = {report::Text{leaves_out}}});
  document.provenance = provenance_of(s.command, *s.question.mechanism, named_rung(rung));
  document.provenance.push_back({"Study hash", s.question.study.content_hash});
  document.provenance.push_back({"Seed", static_cast<double>(s.question.plan.design.seed)});
  return document;
}

}  // namespace boresight::app
