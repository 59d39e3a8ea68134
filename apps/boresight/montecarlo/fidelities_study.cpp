// `fidelities` of a Monte Carlo study: a pilot on every rung, a forecast of the gain before anything more is spent, samples
// as the plan divides them, and the estimate that is unbiased for the first rung.
//
// Samples 0 to pilot - 1 are the pilot's, the estimate's follow. A store per rung keeps them, the first one also what a sample
// of each was counted at (counted_cost.hpp); the plan follows from the pilot's values and these alone. So a resumed study goes
// on with the plan it was begun with, and a repeated one has the same.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>
#include <ostream>

#include "boresight/io/content_hash.hpp"
#include "boresight_analyses/fidelities/fidelity_estimate.hpp"
#include "boresight_analyses/runs/counted_cost.hpp"
#include "boresight_analyses/runs/scatter_draws.hpp"
#include "montecarlo/several_rungs.hpp"
#include "report/report.hpp"
#include "results/stored_study.hpp"
#include "results/tables.hpp"
#include "terminal/exit_status.hpp"
#include "terminal/interruption.hpp"
#include "terminal/progress.hpp"
#include "terminal/readable.hpp"
#include "terminal/terminal.hpp"

namespace boresight::app {
namespace {

struct Level {
  std::string rung;
  std::unique_ptr<SampleModel> model;
  std::unique_ptr<SampleStore> store;
};

struct FidelityOutcome {
  FidelityPilot pilot;
  FidelityPlan plan;
  FidelityEstimate mean;
  std::optional<IndependentInterval> excess;  // probability of exceeding the requirement's limit
  double spent = 0.0;                         // CPU seconds of all samples, measured
  std::vector<double> measured_cost;          // CPU seconds of a sample, per rung
};

std::vector<Level> open_levels(const SeveralRungs& s) {
  ContentHash hash;
  hash.add(s.out.identity().dump());
  std::vector<Level> levels;
  for (const std::string& rung : s.question.plan.fidelities->models) {
    const std::filesystem::path file = s.out.path() / ("samples-" + rung + ".db");
    levels.push_back({rung, model_on(s, rung), nullptr});
    levels.back().store = std::make_unique<SampleStore>(
        file, std::map<std::string, std::string>{{"study", hash.hexadecimal()}}, s.question.plan.inputs.names());
    tell_of_damage(levels.back().store->damage());
    levels.back().store->use_rung(rung, levels.back().model->step());
  }
  return levels;
}

// Of a sample on each rung, in seconds: counted when the study is begun, and kept.
std::vector<double> counted_costs(const SeveralRungs& s, std::vector<Level>& levels, const SamplingDesign& design) {
  std::vector<double> costs;
  for (Level& level : levels) {
    std::string kept = level.store->fact("counted_cost");
    if (kept.empty()) {
      kept = fmt::format("{:.17g}", counted_cost(*level.model, *s.question.mechanism, s.question.plan.inputs, design));
      level.store->note("counted_cost", kept);
    }
    costs.push_back(std::stod(kept));
  }
  return costs;
}

std::string forecast_sentence(const FidelityPlan& plan, const std::string& top) {
  if (plan.models.size() == 1)
    return "forecast: nothing to gain from the cheaper rungs; the budget goes to " + top + " alone";
  return fmt::format(
      "forecast: variance {:.3g} times lower ({:.3g} to {:.3g}) than {} alone for the same CPU, pilot paid for",
      plan.gain, plan.gain_low, plan.gain_high, top);
}

// Against the first rung alone for the same CPU: its sample variance over as many samples as that pays.
double measured_gain(const FidelityOutcome& o) {
  const double variance = o.mean.standard_error * o.mean.standard_error;
  const double plain = o.plan.sd[0] * o.plan.sd[0] * o.measured_cost[0] / o.spent;
  return variance > 0.0 ? plain / variance : 0.0;
}

void write_levels(std::ostream& out, const SeveralRungs& s, const FidelityOutcome& o) {
  out << "rung,cpu_seconds_per_sample,pilot_mean,pilot_sd,correlation,samples,weight\n";
  for (std::size_t i = 0; i < o.pilot.models(); ++i) {
    const auto at = std::find(o.plan.models.begin(), o.plan.models.end(), static_cast<int>(i)) - o.plan.models.begin();
    const bool used = at < static_cast<std::ptrdiff_t>(o.plan.models.size());
    out << s.question.plan.fidelities->models[i] << ',' << exact(o.measured_cost[i]) << ',' << exact(o.plan.mean[i])
        << ',' << exact(o.plan.sd[i]) << ',' << exact(o.plan.correlation[i]) << ',' << (used ? o.plan.samples[at] : 0)
        << ',' << exact(used ? o.plan.weight[at] : 0.0) << '\n';
  }
}

report::Table levels_table(const SeveralRungs& s, const FidelityOutcome& o) {
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

report::Chart agreement_chart(const SeveralRungs& s, const FidelityOutcome& o) {
  const std::vector<std::string>& names = s.question.plan.fidelities->models;
  double most = 0.0;
  for (const auto& values : o.pilot.values)
    for (const double v : values)
      if (std::isfinite(v)) most = std::max(most, std::abs(v));
  const DisplayUnit unit = display_unit(s.question.study.index.si_unit(), most);
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
  claim_folder(s);
  std::vector<Level> levels = open_levels(s);
  const SamplingDesign design(plan.design, static_cast<int>(plan.inputs.size()));

  Progress progress(s.command.quiet, asked.budget, "s of CPU");
  double spent = 0.0;
  std::string doing;
  const MethodOptions options{.jobs = s.command.jobs,
                              .progress =
                                  [&](double cpu) {
                                    spent += cpu;
                                    progress.update(std::min(spent, asked.budget), doing);
                                  },
                              .interrupted = [] { return interrupted(); }};
  FidelityOutcome o;
  Failures failures;  // on any rung
  try {
    for (Level& level : levels) {
      doing = "pilot on " + level.rung;
      complete_samples(*level.model, plan.inputs, design, {0, asked.pilot}, *level.store, options);
      const StoredValues pilot = stored_values(*level.store, {0, asked.pilot});
      o.pilot.values.push_back(pilot.values);
      o.measured_cost.push_back(std::max(pilot.typical_cost, 1e-7));
      o.spent += pilot.spent;
      failures.add(pilot.failures);
    }
    o.pilot.cost = counted_costs(s, levels, design);
    try {
      o.plan = plan_fidelities(o.pilot, asked.budget, plan.design.seed);
    } catch (const std::invalid_argument& refusal) {
      progress.clear();
      throw ComputationError(std::string("[montecarlo] fidelities: ") + refusal.what() +
                             (failures.count > 0 ? fmt::format("; {} runs of the pilot failed", failures.count) +
                                                       first_failure_text(failures, "sample")
                                                 : ""));
    }
    progress.clear();
    if (!s.command.quiet) tell("{}: {}\n", s.question.mechanism->name(), forecast_sentence(o.plan, top));
    std::fflush(stdout);
    std::vector<std::vector<double>> values;
    for (std::size_t k = 0; k < o.plan.models.size(); ++k) {
      const Level& level = levels[static_cast<std::size_t>(o.plan.models[k])];
      const NumberRange range{asked.pilot, asked.pilot + static_cast<std::uint64_t>(o.plan.samples[k])};
      doing = fmt::format("{} samples on {}", o.plan.samples[k], level.rung);
      complete_samples(*level.model, plan.inputs, design, range, *level.store, options);
      const StoredValues stored = stored_values(*level.store, range);
      values.push_back(stored.values);
      o.spent += stored.spent;
      failures.add(stored.failures);
    }
    o.mean = estimate_fidelities(o.plan, values, plan.confidence);
    if (plan.requirement) {
      const ExcessPilot excess = excess_pilot(o.pilot, plan.requirement->limit);
      const FidelityPlan weighted = with_excess_weights(o.plan, o.pilot, excess, plan.requirement->limit);
      // Two sides at 2 c - 1 are one side at c each.
      o.excess = excess_bounds(weighted, excess_indicators(weighted, values, excess.limits),
                               2.0 * plan.requirement->confidence - 1.0);
    }
  } catch (const MethodInterrupted&) {
    progress.clear();
    if (!s.command.quiet) tell("  interrupted; what was computed is kept, the same command goes on\n");
    return kInterrupted;
  }
  progress.clear();

  RunOptions top_run = s.run;
  if (levels[0].model->step() > 0.0) top_run.step = levels[0].model->step();
  const StudySteps steps = steps_of_study(s.command, s.question.study, s.question.mechanism,
                                          {.inputs = plan.inputs,
                                           .runs = static_cast<std::uint64_t>(o.plan.samples[0]),
                                           .lanes = levels[0].model->batch() > 1},
                                          top_run, top, levels[0].store.get());
  if (steps.interrupted) {
    if (!s.command.quiet) tell("  interrupted; what was computed is kept, the same command goes on\n");
    return kInterrupted;
  }
  const double sampling = 0.5 * (o.mean.value.high - o.mean.value.low) / std::abs(o.mean.value.value);
  std::vector<std::string> warnings;
  if (o.mean.failed > 0)
    warnings.push_back(fmt::format("{} samples failed on some rung and are left out of its mean", o.mean.failed) +
                       first_failure_text(failures, "sample"));
  if (o.plan.models.size() == 1)
    warnings.push_back("the cheaper rungs do not pay: this is plain Monte Carlo on " + top +
                       ", the pilot was spent in vain");
  bool met = true;
  Json json = several_rungs_summary(s, top, warnings);
  add_earlier_cost(json, levels.front().store->earlier());
  json["samples"] = o.plan.samples[0];
  json["failed"] = o.mean.failed;
  add_first_failure(json, failures, "sample");
  json["index"]["mean"] = interval_json(reported(o.mean.value));
  json["error"] = {{"of", "mean"},
                   {"sampling", {{"relative", sampling}, {"why", o.mean.value.basis}}},
                   {"discretisation", {{"relative", number_json(steps.relative)}, {"why", steps.why}}},
                   {"rung", {{"relative", 0.0}, {"why", "unbiased for the " + top + " rung"}}},
                   {"dominant", steps.relative > sampling ? "discretisation" : "sampling"}};
  if (o.excess) {
    const IndependentInterval& p = *o.excess;
    const ReportedInterval below{1.0 - p.value,
                                 std::clamp(1.0 - p.high, 0.0, 1.0),
                                 std::clamp(1.0 - p.low, 0.0, 1.0),
                                 plan.requirement->confidence,
                                 plan.requirement->confidence,
                                 false,
                                 p.basis,
                                 "independent"};
    met = below.low >= plan.requirement->probability;
    json["requirement"] = {{"limit", plan.requirement->limit},
                           {"asked_probability", plan.requirement->probability},
                           {"confidence", plan.requirement->confidence},
                           {"met", met},
                           {"probability", interval_json(below)}};
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
  f["budget"] = asked.budget;
  f["cpu_seconds"] = o.spent;
  f["gain"] = {
      {"forecast", o.plan.gain}, {"low", o.plan.gain_low}, {"high", o.plan.gain_high}, {"measured", measured_gain(o)}};
  f["standard_error"] = o.mean.standard_error;
  json["files"] = {"summary.json", "report.html", "rungs.csv"};
  for (const std::string& rung : asked.models) json["files"].push_back("samples-" + rung + ".db");
  write_json(s.out, "summary.json", json);
  s.out.write("rungs.csv", [&](std::ostream& out) { write_levels(out, s, o); });

  report::Document document = several_rungs_report(s, top, levels.front().model->leaves_out(), warnings);
  document.subtitle = "The mean of the " + s.question.study.index.title() + ", on several rungs at once";
  const std::string sentence = fmt::format("Mean {} ± {}, unbiased for {}", readable(o.mean.value.value, unit),
                                           readable(0.5 * (o.mean.value.high - o.mean.value.low), unit), top);
  document.verdict = report::Verdict{report::Standing::neutral, sentence};
  if (o.excess)
    document.verdict =
        report::Verdict{met ? report::Standing::good : report::Standing::bad,
                        sentence + (met ? "; the requirement is met" : "; the requirement is not shown to be met")};
  document.facts = {
      {"mean", readable(o.mean.value.value, unit), "", fmt::format("{:g} % confidence", 100.0 * plan.confidence)},
      {"forecast gain", readable_number(o.plan.gain), "",
       fmt::format("{:.3g} to {:.3g}", o.plan.gain_low, o.plan.gain_high)},
      {"gain measured", readable_number(measured_gain(o)), "",
       "variance of " + top + " alone for the same CPU, over this one's"},
      {"CPU", readable(o.spent, "s"), "", "all samples, the pilot's included"}};
  document.sections.insert(
      document.sections.begin(),
      report::Section{.id = "rungs",
                      .title = "How the budget was spent",
                      .intro = "Made before anything but the pilot was spent: " + forecast_sentence(o.plan, top) + ".",
                      .items = {levels_table(s, o), agreement_chart(s, o)}});
  s.out.write("report.html", [&](std::ostream& out) { report::write_html(out, document); });
  s.out.publish();
  if (!s.command.quiet) {
    tell("  {}\n", sentence);
    tell("  gain measured: {:.3g} ({:.1f} s of CPU)\n", measured_gain(o), o.spent);
    for (std::size_t k = 0; k < o.plan.models.size(); ++k)
      tell("  {:<14} {:>8} samples, correlation {:.4f}, {} each\n",
           asked.models[static_cast<std::size_t>(o.plan.models[k])], o.plan.samples[k],
           o.plan.correlation[static_cast<std::size_t>(o.plan.models[k])],
           readable(o.measured_cost[static_cast<std::size_t>(o.plan.models[k])], "s"));
    for (const std::string& warning : warnings) tell("  warning: {}\n", warning);
    tell("  report: {}\n", (s.out.path() / "report.html").string());
  }
  return met ? kDone : kAnswerIsNo;
}

}  // namespace boresight::app
