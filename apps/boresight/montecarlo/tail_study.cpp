// `tail` of a Monte Carlo study: how likely the index exceeds the requirement's limit where that is rare. Subset simulation
// finds the excess on the cheap rung, importance sampling measures it, the exact rung corrects it; forecast before it is spent.
// The budget is divided by counted costs (counted_cost.hpp), so the same study gives the same numbers again.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <ostream>

#include "boresight_analyses/runs/counted_cost.hpp"
#include "boresight_analyses/tails/two_level_pilot.hpp"
#include "montecarlo/several_rungs.hpp"
#include "report/report.hpp"
#include "results/tables.hpp"
#include "terminal/exit_status.hpp"
#include "terminal/interruption.hpp"
#include "terminal/progress.hpp"
#include "terminal/readable.hpp"
#include "terminal/terminal.hpp"

namespace boresight::app {
namespace {

report::Chart levels_chart(const SeveralRungs& s, const SubsetResult& subset) {
  double most = 0.0;
  for (const SubsetLevel& level : subset.levels) most = std::max(most, std::abs(level.threshold));
  const DisplayUnit unit = display_unit(s.question.study.index.si_unit(), most);
  report::Chart chart{
      .title = "How the excess was found",
      .caption = "Subset simulation on the cheap rung: each level starts from the worst tenth of the one before.",
      .x = {"index", unit.name},
      .y = {"probability of exceeding it, cheap rung", "", true}};
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

}  // namespace

int run_tail(const SeveralRungs& s) {
  const TailQuestion& asked = *s.question.plan.tail;
  const Requirement& requirement = *s.question.plan.requirement;
  const MonteCarloPlan& plan = s.question.plan;
  const int dimensions = static_cast<int>(plan.inputs.size());
  claim_folder(s);
  const auto cheap_model = model_on(s, asked.cheap), exact_model = model_on(s, asked.exact);

  Progress progress(s.command.quiet, asked.budget, "s of CPU");
  double spent = 0.0;
  Failures failures;
  std::string doing = "finding the excess";
  const MethodOptions options{.jobs = s.command.jobs,
                              .progress =
                                  [&](double cpu) {
                                    spent += cpu;
                                    progress.update(std::min(spent, asked.budget), doing);
                                  },
                              .interrupted = [] { return interrupted(); },
                              .failed =
                                  [&](std::uint64_t, const Outcome& outcome) {
                                    // In the order in which they fail: the first that is told of is the one to tell.
                                    failures.see(failures.count, outcome);
                                  }};
  const auto cheap_costs = std::make_shared<std::vector<double>>(),
             exact_costs = std::make_shared<std::vector<double>>();
  const BatchModel cheap = on_normal_space(*cheap_model, plan.inputs, options, cheap_costs);
  const BatchModel exact_rung = on_normal_space(*exact_model, plan.inputs, options, exact_costs);
  ProposalOptions proposal;
  proposal.subset.seed = plan.design.seed;
  std::optional<TwoLevelPlan> pilot;
  TailEstimate estimate;
  double before = 0.0;
  TwoLevelCosts costs;
  try {
    const SamplingDesign design(plan.design, dimensions);
    costs = {counted_cost(*cheap_model, *s.question.mechanism, plan.inputs, design),
             counted_cost(*exact_model, *s.question.mechanism, plan.inputs, design)};
    pilot = two_level_pilot(cheap, exact_rung, dimensions, requirement.limit, static_cast<std::int64_t>(asked.pilot),
                            costs, asked.budget, proposal);
    before = spent;
    progress.clear();
    if (!s.command.quiet && !pilot->informed)
      tell("{}: no point of the pilot exceeds the limit on {}: no forecast, the budget goes to {} points there\n",
           s.question.mechanism->name(), asked.exact, pilot->exact_points);
    else if (!s.command.quiet)
      tell(
          "{}: about {:.2g} exceed; forecast: standard error {:.2g} with {} points on {} and {} on {} "
          "({:.2g} on {} alone, {:.2g} by plain Monte Carlo for the same CPU)\n",
          s.question.mechanism->name(), pilot->probability, pilot->standard_error, pilot->cheap_points, asked.cheap,
          pilot->exact_points, asked.exact, pilot->exact_standard_error, asked.exact, pilot->plain_standard_error);
    std::fflush(stdout);
    spent = 0.0;
    doing = "measuring it";
    const TailOptions tail{.confidence = 2.0 * requirement.confidence - 1.0, .seed = plan.design.seed};
    estimate =
        pilot->control > 0.0
            ? two_level_importance_sampling(cheap, exact_rung, requirement.limit, pilot->proposal.mixture,
                                            pilot->cheap_points, pilot->exact_points, pilot->control, tail)
            : importance_sampling(exact_rung, requirement.limit, pilot->proposal.mixture, pilot->exact_points, tail);
  } catch (const MethodInterrupted&) {
    progress.clear();
    if (!s.command.quiet) tell("  interrupted: a tail study begins anew\n");
    return kInterrupted;
  }
  progress.clear();

  const IndependentInterval &p = estimate.bounds, &central = estimate.probability;
  std::vector<std::string> warnings;
  if (!pilot->proposal.subset.reached)
    warnings.push_back("the search on the " + asked.cheap +
                       " rung did not reach the limit: the points are drawn from the whole scatter");
  if (estimate.effective_exceedances < 20.0)
    warnings.push_back(
        fmt::format("only {:.1f} effective points of the {} rung lie beyond the limit: the standard error is not to be "
                    "trusted, the bounds are",
                    estimate.effective_exceedances, asked.exact));
  if (pilot->control > 0.0 && estimate.disagreements < 5)
    warnings.push_back(fmt::format("the rungs disagree on {} points only: how much they do is not well known",
                                   estimate.disagreements));
  if (failures.count > 0)
    warnings.push_back(fmt::format(
        "{} points failed in all, {} of them of the estimate, where they count as beyond the limit; the first "
        "that did: {}",
        failures.count, estimate.failed, failures.reason));
  const ReportedInterval below{1.0 - p.value,          1.0 - p.high, 1.0 - p.low, requirement.confidence,
                               requirement.confidence, false,        p.basis,     "independent"};
  const double most = 1.0 - requirement.probability;  // that may exceed the limit
  const bool met = p.high <= most;
  // Where half of the capital is at stake on every point: see betting_mean.hpp.
  const double enough = central.value < most ? std::log(2.0 / (1.0 - requirement.confidence)) * estimate.most_weight /
                                                   (most - central.value)
                                             : 0.0;
  if (!met && enough > double(estimate.exact_evaluations))
    warnings.push_back(
        fmt::format("{} points on the {} rung bound the excess by {:.2g} wherever it lies; to show at most {:.2g} "
                    "takes about {:.2g} "
                    "of them: a larger budget",
                    estimate.exact_evaluations, asked.exact, p.high, most, enough));

  Json json = several_rungs_summary(s, asked.exact, warnings);
  json["samples"] = estimate.exact_evaluations;
  json["failed"] = estimate.failed;
  if (failures.count > 0) json["first_failure"] = {{"reason", failures.reason}};
  json["requirement"] = {{"limit", requirement.limit},
                         {"asked_probability", requirement.probability},
                         {"confidence", requirement.confidence},
                         {"met", met},
                         {"probability", interval_json(below)}};
  ReportedInterval excess = reported(p);
  excess.confidence = requirement.confidence;
  json["tail"] = {{"exceedance", interval_json(excess)},
                  {"standard_error", estimate.standard_error},
                  {"effective_exceedances", estimate.effective_exceedances},
                  {"disagreements", estimate.disagreements},
                  {"control", pilot->control},
                  {"cheap",
                   {{"rung", asked.cheap},
                    {"points", estimate.cheap_evaluations},
                    {"cpu_seconds_per_sample", median(*cheap_costs)},
                    {"counted_seconds_per_sample", costs.cheap}}},
                  {"exact",
                   {{"rung", asked.exact},
                    {"points", estimate.exact_evaluations},
                    {"cpu_seconds_per_sample", median(*exact_costs)},
                    {"counted_seconds_per_sample", costs.exact}}},
                  {"search",
                   {{"cheap_points", pilot->cheap_evaluations},
                    {"exact_points", pilot->exact_evaluations},
                    {"cpu_seconds", before},
                    {"cheap_probability", pilot->proposal.subset.probability},
                    {"limit_searched", pilot->cheap_limit}}},
                  {"forecast",
                   {{"standard_error", pilot->standard_error},
                    {"exact_alone", pilot->exact_standard_error},
                    {"plain", pilot->plain_standard_error}}},
                  {"cpu_seconds", before + spent}};
  json["tail"]["exceedance"]["bounds"] = "one-sided, each at this confidence";
  json["tail"]["exceedance"]["central_limit"] = {{"low", central.low}, {"high", central.high}, {"why", central.basis}};
  json["tail"]["pilot_saw_excess"] = pilot->informed;
  json["files"] = {"summary.json", "report.html", "levels.csv"};
  write_json(s.out, "summary.json", json);
  s.out.write("levels.csv", [&](std::ostream& out) {
    out << "level,threshold,conditional_probability,coefficient_of_variation\n";
    const auto& levels = pilot->proposal.subset.levels;
    for (std::size_t k = 0; k < levels.size(); ++k)
      out << k + 1 << ',' << exact(levels[k].threshold) << ',' << exact(levels[k].probability) << ','
          << exact(levels[k].coefficient_of_variation) << '\n';
  });

  const std::string unit = s.question.study.index.si_unit();
  const std::string sentence = fmt::format("{:.3g} of all exceed {} ({:.3g} to {:.3g}), unbiased for {}", p.value,
                                           readable(requirement.limit, unit), p.low, p.high, asked.exact);
  report::Document document = several_rungs_report(s, asked.exact, exact_model->leaves_out(), warnings);
  document.subtitle = "How rarely the " + s.question.study.index.title() + " exceeds its limit";
  document.verdict =
      report::Verdict{met ? report::Standing::good : report::Standing::bad,
                      sentence + (met ? "; the requirement is met" : "; the requirement is not shown to be met")};
  document.facts = {{"exceed the limit", fmt::format("{:.3g}", p.value), "",
                     fmt::format("at most {:.3g} with {:g} % confidence", p.high, 100.0 * requirement.confidence)},
                    {"standard error", fmt::format("{:.2g}", estimate.standard_error), "",
                     fmt::format("forecast {:.2g}", pilot->standard_error)},
                    {"effective points beyond", readable_number(estimate.effective_exceedances), "", ""},
                    {"CPU", readable(before + spent, "s"), "", "search and pilot included"}};
  report::Table table{.title = "What the same CPU would have given",
                      .caption = "Standard errors of the probability, forecast by the pilot.",
                      .columns = {{"way"}, {"standard error"}}};
  table.rows = {{asked.exact + " alone, importance sampling", pilot->exact_standard_error},
                {asked.exact + " alone, plain Monte Carlo", pilot->plain_standard_error}};
  if (pilot->control > 0.0)
    table.rows.insert(table.rows.begin(), {"both rungs, importance sampling (taken)", pilot->standard_error});
  else
    table.caption += " The cheap rung found the tail; measuring it on the exact rung alone is the better buy here.";
  document.sections.insert(
      document.sections.begin(),
      report::Section{.id = "tail", .title = "The tail", .items = {levels_chart(s, pilot->proposal.subset), table}});
  s.out.write("report.html", [&](std::ostream& out) { report::write_html(out, document); });
  s.out.publish();
  if (!s.command.quiet) {
    tell("  {}\n", sentence);
    for (const std::string& warning : warnings) tell("  warning: {}\n", warning);
    tell("  report: {}\n", (s.out.path() / "report.html").string());
  }
  return met ? kDone : kAnswerIsNo;
}

}  // namespace boresight::app
