// `fidelities` of a Monte Carlo study: what it found (fidelities/fidelity_study.hpp), as files and words.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <ostream>

#include "boresight_analyses/fidelities/fidelity_study.hpp"
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

std::string forecast_sentence(const FidelityPlan& plan, const std::string& top) {
  if (plan.models.size() == 1 && plan.raised())
    return "forecast: the requirement takes the whole budget for samples on " + top;
  if (plan.models.size() == 1)
    return "forecast: nothing to gain from the cheaper rungs; the budget goes to " + top + " alone";
  return fmt::format(
      "forecast: variance {:.3g} times lower ({:.3g} to {:.3g}) than {} alone for the same CPU, pilot paid for",
      plan.gain, plan.gain_low, plan.gain_high, top);
}

// What a requirement makes of the plan; "" where it is the mean's.
std::string requirement_of_plan(const FidelityPlan& plan, const std::string& top) {
  if (!plan.raised()) return "";
  return fmt::format(
      "for the requirement {} has {}{}, where the mean alone would give it {}: it is shown by {} or more, with none "
      "beyond the limit",
      top, how_many(static_cast<std::size_t>(plan.samples.front()), "sample"),
      plan.models.size() == 1 ? ", and the whole budget" : "", plan.for_the_mean, plan.fewest);
}

void write_levels(std::ostream& out, const SeveralRungs& s, const FidelityStudy& o) {
  out << "rung,cpu_seconds_per_sample,pilot_mean,pilot_sd,correlation,samples,weight\n";
  for (std::size_t i = 0; i < o.pilot.models(); ++i) {
    const auto at = std::find(o.plan.models.begin(), o.plan.models.end(), static_cast<int>(i)) - o.plan.models.begin();
    const bool used = at < static_cast<std::ptrdiff_t>(o.plan.models.size());
    out << s.question.plan.fidelities->models[i] << ',' << exact(o.measured_cost[i]) << ',' << exact(o.plan.mean[i])
        << ',' << exact(o.plan.sd[i]) << ',' << exact(o.plan.correlation[i]) << ',' << (used ? o.plan.samples[at] : 0)
        << ',' << exact(used ? o.plan.weight[at] : 0.0) << '\n';
  }
}

report::Table levels_table(const SeveralRungs& s, const FidelityStudy& o) {
  report::Table table{
      .title = "Rungs",
      .caption =
          "What the pilot saw, and what the plan made of it. A rung without samples does not pay: its correlation "
          "with the first one is too low for its cost.",
      .columns = {{"rung"}, {"CPU per sample", "ms"}, {"correlation"}, {"pilot"}, {"samples"}, {"weight"}}};
  for (std::size_t i = 0; i < o.pilot.models(); ++i) {
    const auto at = std::find(o.plan.models.begin(), o.plan.models.end(), static_cast<int>(i)) - o.plan.models.begin();
    const bool used = at < static_cast<std::ptrdiff_t>(o.plan.models.size());
    table.rows.push_back({s.question.plan.fidelities->models[i], 1e3 * o.measured_cost[i], o.plan.correlation[i],
                          static_cast<double>(o.plan.pilot_samples), static_cast<double>(used ? o.plan.samples[at] : 0),
                          used ? nlohmann::json(o.plan.weight[at]) : nlohmann::json()});
  }
  return table;
}

report::Chart agreement_chart(const SeveralRungs& s, const FidelityStudy& o) {
  const std::vector<std::string>& names = s.question.plan.fidelities->models;
  double most = 0.0;
  for (const auto& values : o.pilot.values)
    for (const double v : values)
      if (std::isfinite(v)) most = std::max(most, std::abs(v));
  const DisplayUnit unit = display_unit_as(s.question.study.index.si_unit(), most, written_unit(s.question.plan));
  report::Chart chart{
      .title = "The pilot: every rung against " + names[0],
      .caption =
          "One point per sample. What counts is how closely a rung follows, not whether it agrees: a shift or a "
          "factor is taken out.",
      .x = {"index on the " + names[0] + " rung", unit.name},
      .y = {"index on the other rung", unit.name}};
  const auto scaled = [&](const std::vector<double>& values) {
    report::Numbers n;
    for (const double v : values) n.push_back(v * unit.per_si);
    return n;
  };
  for (std::size_t i = 1; i < names.size(); ++i)
    chart.series.push_back({.name = fmt::format("{} (correlation {:.4f})", names[i], o.plan.correlation[i]),
                            .x = scaled(o.pilot.values[0]),
                            .y = scaled(o.pilot.values[i]),
                            .style = report::Style::markers});
  return chart;
}

}  // namespace

int run_fidelities(const SeveralRungs& s) {
  const FidelityQuestion& asked = *s.question.plan.fidelities;
  const MonteCarloPlan& plan = s.question.plan;
  const std::string& top = asked.models.front();
  const std::string unit = s.question.study.index.si_unit();
  const FidelityStudy o = run_fidelity_study(s.own.run(), plan, [&](const FidelityPlan& planned) {
    if (!s.command.quiet) tell("{}: {}\n", s.question.mechanism->name(), forecast_sentence(planned, top));
    if (const std::string raised = requirement_of_plan(planned, top); !s.command.quiet && !raised.empty())
      tell("  {}\n", raised);
    std::fflush(stdout);
  });
  if (o.interrupted) {
    if (!s.command.quiet) tell("  interrupted; what was computed is kept, the same command goes on\n");
    return kInterrupted;
  }
  const StudySteps& steps = o.steps;
  const double known_steps =
      std::isnan(steps.relative) ? 0.0 : steps.relative;  // what was not measured does not stand first
  const double sampling = 0.5 * (o.mean.value.high - o.mean.value.low) / std::abs(o.mean.value.value);
  std::vector<std::string> warnings = several_rungs_warnings(s);
  if (o.mean.failed > 0)
    warnings.push_back(fmt::format("{} samples failed on some rung and are left out of its mean", o.mean.failed) +
                       first_failure_text(o.failures, "sample"));
  if (o.plan.models.size() == 1 && !o.plan.raised())
    warnings.push_back("the cheaper rungs do not pay: this is plain Monte Carlo on " + top +
                       ", the pilot was spent in vain");
  std::optional<RequirementShown> requirement;
  // Where the budget does not pay what the requirement takes, the plan serves the mean.
  if (o.excess && !(o.excess->high <= 1.0 - plan.requirement->probability) && !o.plan.can_show())
    warnings.push_back(fmt::format(
        "the budget leaves {} on {}, too few to show the requirement, which takes {} or more whatever they give: a "
        "larger budget, or plain samples, without fidelities, judge it",
        how_many(static_cast<std::size_t>(o.plan.samples[0]), "sample"), top,
        fewest_to_show(plan.requirement->probability, plan.requirement->confidence).alone));
  Json json = several_rungs_summary(s, top, warnings, o.earlier);
  json["samples"] = o.plan.samples[0];
  json["failed"] = o.mean.failed;
  add_first_failure(json, o.failures, "sample");
  json["index"]["mean"] = interval_json(reported(o.mean.value));
  json["error"] = {{"of", "mean"},
                   {"sampling", {{"relative", sampling}, {"why", o.mean.value.basis}}},
                   {"dominant", sampling >= std::max(known_steps, o.rung_error) ? "sampling"
                                : o.rung_error >= known_steps                   ? "rung"
                                                                                : "discretisation"}};
  json["error"].update(model_error_json(top, o.rung_error, steps));
  if (o.excess) {
    requirement = requirement_shown(*plan.requirement, *o.excess,
                                    o.excess_within_error ? &*o.excess_within_error : nullptr, o.model_error);
    json["requirement"] = requirement_json(*plan.requirement, *requirement);
  }
  Json& f = json["fidelities"];
  for (std::size_t i = 0; i < asked.models.size(); ++i)
    f["rungs"].push_back({{"rung", asked.models[i]},
                          {"cpu_seconds_per_sample", o.measured_cost[i]},
                          {"counted_seconds_per_sample", o.pilot.cost[i]},
                          {"correlation", o.plan.correlation[i]},
                          {"samples", 0},
                          {"weight", 0.0}});
  for (std::size_t k = 0; k < o.plan.models.size(); ++k) {
    Json& rung = f["rungs"][static_cast<std::size_t>(o.plan.models[k])];
    rung["samples"] = o.plan.samples[k];
    rung["weight"] = o.plan.weight[k];
  }
  f["pilot"] = {{"samples", o.plan.pilot_samples},
                {"failed", o.plan.pilot_failed},
                {"counted_seconds", o.pilot.spent()},
                {"cpu_seconds", static_cast<double>(o.pilot.samples()) *
                                    std::accumulate(o.measured_cost.begin(), o.measured_cost.end(), 0.0)}};
  if (o.plan.fewest > 0)
    f["requirement"] = {{"fewest_samples", o.plan.fewest}, {"samples_for_the_mean", o.plan.for_the_mean}};
  f["budget"] = asked.budget;
  f["cpu_seconds"] = o.spent;
  const std::string more = overspent(o.spent, asked.budget);
  if (!more.empty()) f["cpu_seconds_beyond_budget"] = more;
  f["gain"] = {
      {"forecast", o.plan.gain}, {"low", o.plan.gain_low}, {"high", o.plan.gain_high}, {"measured", o.measured_gain()}};
  f["standard_error"] = o.mean.standard_error;
  json["files"] = {"summary.json", "report.html", "report.json", "rungs.csv"};
  for (const std::string& rung : asked.models) json["files"].push_back(store_of_rung(rung));
  write_json(s.own.out(), "summary.json", json);
  s.own.out().write("rungs.csv", [&](std::ostream& out) { write_levels(out, s, o); });

  // Not in the summary's warnings, which are the same however often a study was interrupted and however long it took: with its times there.
  if (!more.empty()) warnings.push_back(more);
  report::Document document = several_rungs_report(
      s, top, o.leaves_out,
      "summary.json and rungs.csv beside this file; a samples-RUNG.db for each rung holds every sample, the pilot's "
      "first (boresight export DIR: CSV)",
      warnings);
  document.subtitle = "The mean of the " + s.question.study.index.title() + ", on several rungs at once";
  const auto shown = [&, written = written_unit(plan)](double value) { return readable_as(value, unit, written); };
  const std::string sentence = fmt::format("Mean {} ± {}, unbiased for {}", shown(o.mean.value.value),
                                           shown(0.5 * (o.mean.value.high - o.mean.value.low)), top);
  document.verdict = report::Verdict{report::Standing::neutral, sentence};
  if (requirement)
    document.verdict = report::Verdict{requirement->met ? report::Standing::good : report::Standing::bad,
                                       sentence + "; " + requirement_words(*requirement, top)};
  document.facts = {{"mean", shown(o.mean.value.value), "", fmt::format("{:g} % confidence", 100.0 * plan.confidence)},
                    {"forecast gain", readable_number(o.plan.gain), "",
                     fmt::format("{:.3g} to {:.3g}", o.plan.gain_low, o.plan.gain_high)},
                    {"gain measured", readable_number(o.measured_gain()), "",
                     "variance of " + top + " alone for the same CPU, over this one's"},
                    {"CPU", readable(o.spent, "s"), "", "all samples, the pilot's included"}};
  document.sections.insert(
      document.sections.begin(),
      report::Section{.id = "rungs",
                      .title = "How the budget was spent",
                      .intro = "Made before anything but the pilot was spent: " + forecast_sentence(o.plan, top) +
                               (o.plan.raised() ? "; " + requirement_of_plan(o.plan, top) : "") + ".",
                      .items = {levels_table(s, o), agreement_chart(s, o)}});
  write_report(s.own.out(), document);
  s.own.out().publish();
  if (!s.command.quiet) {
    tell("  {}\n", sentence);
    if (requirement) {
      tell(
          "  {} at or below {} in {:g} % of all cases: {}; by the samples of {} at least {:.4g} % with {:g} % "
          "confidence\n",
          s.question.study.index.title(), readable_limit(plan.requirement->limit, unit, plan.requirement->unit),
          100.0 * plan.requirement->probability, requirement->met ? "met" : "not shown to be met", top,
          100.0 * requirement->share.low, 100.0 * plan.requirement->confidence);
      if (requirement->met_by_samples && !requirement->met) tell("  {}\n", requirement_words(*requirement, top));
    }
    tell("  gain measured: {:.3g} ({:.1f} s of CPU)\n", o.measured_gain(), o.spent);
    for (std::size_t k = 0; k < o.plan.models.size(); ++k)
      tell("  {:<14} {:>8} samples, correlation {:.4f}, {} each\n",
           asked.models[static_cast<std::size_t>(o.plan.models[k])], o.plan.samples[k],
           o.plan.correlation[static_cast<std::size_t>(o.plan.models[k])],
           readable(o.measured_cost[static_cast<std::size_t>(o.plan.models[k])], "s"));
    tell_warnings(warnings, s.command, *s.question.mechanism);
    tell("  report: {}\n", (s.own.out().path() / "report.html").string());
  }
  return requirement && !requirement->met ? kAnswerIsNo : kDone;
}

}  // namespace boresight::app
