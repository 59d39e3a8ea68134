// `tail` of a Monte Carlo study: what it found (tails/tail_study.hpp), as files and words.
#include "boresight_analyses/tails/tail_study.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <ostream>

#include "montecarlo/montecarlo_report.hpp"
#include "montecarlo/several_rungs.hpp"
#include "results/assumed.hpp"
#include "results/report_files.hpp"
#include "results/tables.hpp"
#include "terminal/exit_status.hpp"
#include "terminal/readable.hpp"
#include "terminal/terminal.hpp"

namespace boresight::app {
namespace {

report::Chart levels_chart(const SeveralRungs& s, const SubsetResult& subset, const std::string& rung) {
  double most = 0.0;
  for (const SubsetLevel& level : subset.levels) most = std::max(most, std::abs(level.threshold));
  const DisplayUnit unit = display_unit_as(s.question.study.index.si_unit(), most, written_unit(s.question.plan));
  report::Chart chart{.title = "How the excess was found",
                      .caption = "Subset simulation on the " + rung +
                                 " rung: each level starts from the worst tenth of the one before.",
                      .x = {"index", unit.name},
                      .y = {"probability of exceeding it, " + rung, "", true}};
  report::Numbers x, y;
  double p = 1.0;
  for (const SubsetLevel& level : subset.levels) {
    p *= level.probability;
    x.push_back(level.threshold * unit.per_si);
    y.push_back(p > 0.0 ? p : std::nan(""));
  }
  chart.series.push_back({.name = "levels", .x = x, .y = y, .style = report::Style::line_markers});
  chart.lines = {{'x', s.question.plan.requirement->limit * unit.per_si, "limit"}};
  return chart;
}

std::string forecast_sentence(const TwoLevelPlan& pilot, const TailQuestion& asked) {
  if (!pilot.informed)
    return fmt::format("no point of the pilot exceeds the limit on {}: no forecast, the budget goes to {} points there",
                       asked.exact, pilot.exact_points);
  if (!pilot.forecasts)
    return fmt::format("the pilot is too small to forecast what comes of {} points on {}{}", pilot.exact_points,
                       asked.exact,
                       pilot.cheap_points > 0 ? fmt::format(" and {} on {}", pilot.cheap_points, asked.cheap) : "");
  if (pilot.on_exact)
    return fmt::format(
        "about {:.2g} exceed; forecast: standard error {:.2g} with {} points on {} ({:.2g} by plain Monte Carlo for "
        "the "
        "same CPU); {} costs more and was left alone",
        pilot.probability, pilot.standard_error, pilot.exact_points, asked.exact, pilot.plain_standard_error,
        asked.cheap);
  return fmt::format(
      "about {:.2g} exceed; forecast: standard error {:.2g} with {} points on {} and {} on {} "
      "({:.2g} on {} alone, {:.2g} by plain Monte Carlo for the same CPU)",
      pilot.probability, pilot.standard_error, pilot.cheap_points, asked.cheap, pilot.exact_points, asked.exact,
      pilot.exact_standard_error, asked.exact, pilot.plain_standard_error);
}

}  // namespace

int run_tail(const SeveralRungs& s) {
  const TailQuestion& asked = *s.question.plan.tail;
  const Requirement& requirement = *s.question.plan.requirement;
  const MonteCarloPlan& plan = s.question.plan;
  const TailStudy found = run_tail_study(s.own.run(), plan, [&](const TwoLevelPlan& pilot) {
    if (!s.command.quiet) tell("{}: {}\n", s.question.mechanism->name(), forecast_sentence(pilot, asked));
    std::fflush(stdout);
  });
  if (found.interrupted) {
    if (!s.command.quiet) tell("  interrupted; what was computed is kept, the same command goes on\n");
    return kInterrupted;
  }
  const TwoLevelPlan& pilot = found.pilot;
  const TailEstimate& estimate = found.estimate;
  const Failures& failures = found.failures;
  const double before = found.search_seconds, spent = found.estimate_seconds;

  const IndependentInterval &p = estimate.bounds, &central = estimate.probability;
  std::vector<std::string> warnings = several_rungs_warnings(s);
  const std::string& searched = pilot.on_exact ? asked.exact : asked.cheap;
  if (!pilot.proposal.subset.reached)
    warnings.push_back("the search on the " + searched +
                       " rung did not reach the limit: the points are drawn from the whole scatter");
  if (estimate.effective_exceedances < 20.0)
    warnings.push_back(
        fmt::format("only {:.1f} effective points of the {} rung lie beyond the limit: the standard error is not to be "
                    "trusted, the bounds are",
                    estimate.effective_exceedances, asked.exact));
  if (pilot.control > 0.0 && estimate.disagreements < 5)
    warnings.push_back(fmt::format("the rungs disagree on {} points only: how much they do is not well known",
                                   estimate.disagreements));
  if (failures.count > 0)
    warnings.push_back(fmt::format(
        "{} points failed in all, {} of them of the estimate, where they count as beyond the limit; the first "
        "that did: {}",
        failures.count, estimate.failed, failures.reason));
  const RequirementShown shown =
      requirement_shown(requirement, p, found.within_error ? &found.within_error->bounds : nullptr, found.model_error);
  const double most = 1.0 - requirement.probability;  // that may exceed the limit
  const double enough = found.points_to_show(requirement);
  if (!shown.met_by_samples && enough > double(estimate.exact_evaluations))
    warnings.push_back(
        fmt::format("{} points on the {} rung bound the excess by {:.2g} wherever it lies; to show at most {:.2g} "
                    "takes about {:.2g} "
                    "of them: a larger budget",
                    estimate.exact_evaluations, asked.exact, p.high, most, enough));

  Json json = several_rungs_summary(s, asked.exact, warnings, found.earlier);
  json["samples"] = estimate.exact_evaluations;
  json["failed"] = estimate.failed;
  if (failures.count > 0) json["first_failure"] = {{"reason", failures.reason}};
  json["error"] = model_error_json(asked.exact, found.rung_error, found.steps);
  json["requirement"] = requirement_json(requirement, shown);
  ReportedInterval excess = reported(p);
  excess.confidence = requirement.confidence;
  json["tail"] = {{"exceedance", interval_json(excess)},
                  {"standard_error", estimate.standard_error},
                  {"effective_exceedances", estimate.effective_exceedances},
                  {"disagreements", estimate.disagreements},
                  {"control", pilot.control},
                  {"cheap",
                   {{"rung", asked.cheap},
                    {"points", estimate.cheap_evaluations},
                    {"cpu_seconds_per_sample", found.cheap_seconds},
                    {"counted_seconds_per_sample", found.costs.cheap}}},
                  {"exact",
                   {{"rung", asked.exact},
                    {"points", estimate.exact_evaluations},
                    {"cpu_seconds_per_sample", found.exact_seconds},
                    {"counted_seconds_per_sample", found.costs.exact}}},
                  {"search",
                   {{"cheap_points", pilot.cheap_evaluations},
                    {"exact_points", pilot.exact_evaluations},
                    {"cpu_seconds", before},
                    {"rung", searched},
                    {"probability", pilot.proposal.subset.probability},
                    {"cheap_probability", pilot.on_exact ? Json() : Json(pilot.proposal.subset.probability)},
                    {"limit_searched", pilot.cheap_limit}}},
                  {"forecast",
                   {{"standard_error", pilot.standard_error},
                    {"exact_alone", pilot.exact_standard_error},
                    {"plain", pilot.plain_standard_error}}},
                  {"cpu_seconds", before + spent}};
  const std::string more = overspent(spent, asked.budget);
  if (!more.empty()) json["tail"]["cpu_seconds_beyond_budget"] = more;
  json["tail"]["exceedance"]["bounds"] = "one-sided, each at this confidence";
  json["tail"]["exceedance"]["central_limit"] = {{"low", central.low}, {"high", central.high}, {"why", central.basis}};
  json["tail"]["pilot_saw_excess"] = pilot.informed;
  json["files"] = {"summary.json", "report.html", "report.json", "levels.csv"};
  write_json(s.own.out(), "summary.json", json);
  s.own.out().write("levels.csv", [&](std::ostream& out) {
    out << "level,threshold,conditional_probability,coefficient_of_variation\n";
    const auto& levels = pilot.proposal.subset.levels;
    for (std::size_t k = 0; k < levels.size(); ++k)
      out << k + 1 << ',' << exact(levels[k].threshold) << ',' << exact(levels[k].probability) << ','
          << exact(levels[k].coefficient_of_variation) << '\n';
  });

  const std::string unit = s.question.study.index.si_unit();
  const std::string sentence =
      fmt::format("{:.3g} of all exceed {} ({:.3g} to {:.3g}), unbiased for {}", p.value,
                  readable_limit(requirement.limit, unit, requirement.unit), p.low, p.high, asked.exact);
  // Not in the summary's warnings, which are the same however often a study was interrupted and however long it took: with its times there.
  if (!more.empty()) warnings.push_back(more);
  report::Document document =
      several_rungs_report(s, asked.exact, found.leaves_out, "summary.json and levels.csv beside this file", warnings);
  document.subtitle = "How rarely the " + s.question.study.index.title() + " exceeds its limit";
  document.verdict = report::Verdict{shown.met ? report::Standing::good : report::Standing::bad,
                                     sentence + "; " + requirement_words(shown, asked.exact)};
  document.facts = {{"exceed the limit", fmt::format("{:.3g}", p.value), "",
                     fmt::format("at most {:.3g} with {:g} % confidence", p.high, 100.0 * requirement.confidence)},
                    {"standard error", fmt::format("{:.2g}", estimate.standard_error), "",
                     pilot.forecasts ? fmt::format("forecast {:.2g}", pilot.standard_error) : std::string()},
                    {"effective points beyond", readable_number(estimate.effective_exceedances), "", ""},
                    {"CPU", readable(before + spent, "s"), "", "search and pilot included"}};
  report::Table table{.title = "What the same CPU would have given",
                      .caption = "Standard errors of the probability, forecast by the pilot.",
                      .columns = {{"way"}, {"standard error"}}};
  table.rows = {{asked.exact + " alone, importance sampling", pilot.exact_standard_error},
                {asked.exact + " alone, plain Monte Carlo", pilot.plain_standard_error}};
  if (pilot.control > 0.0)
    table.rows.insert(table.rows.begin(), {"both rungs, importance sampling (taken)", pilot.standard_error});
  else if (pilot.on_exact)
    table.caption +=
        fmt::format(" A sample takes {} on {} and {} on {}, which was left alone.", readable(found.costs.exact, "s"),
                    asked.exact, readable(found.costs.cheap, "s"), asked.cheap);
  else if (!pilot.informed)
    table.caption = "No point of the pilot exceeded the limit, so there is no forecast.";
  else
    table.caption += " The cheap rung found the tail; measuring it on the exact rung alone is the better buy here.";
  if (pilot.informed && !pilot.forecasts) table.caption = "The pilot was too small to forecast them.";
  document.sections.insert(
      document.sections.begin(),
      report::Section{
          .id = "tail", .title = "The tail", .items = {levels_chart(s, pilot.proposal.subset, searched), table}});
  write_report(s.own.out(), document);
  s.own.out().publish();
  for (const std::string& store : stores_of_tail(asked)) s.own.run().forget(store);
  if (!s.command.quiet) {
    tell("  {}; {}\n", sentence, requirement_words(shown, asked.exact));
    tell_warnings(warnings, s.command, *s.question.mechanism);
    tell("  report: {}\n", (s.own.out().path() / "report.html").string());
  }
  return shown.met ? kDone : kAnswerIsNo;
}

}  // namespace boresight::app
