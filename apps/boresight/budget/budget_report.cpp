#include "budget/budget_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>

#include "budget/budget_parts.hpp"
#include "report_parts/report_parts.hpp"
#include "results/pilot_parts.hpp"
#include "terminal/readable.hpp"

namespace boresight::app {
namespace {

std::string index_titles(const BudgetPlan& plan) {
  std::string text;
  for (const ErrorIndex index : plan.indices())
    text += fmt::format("{}{}: {}", text.empty() ? "" : "; ", to_string(index), title_of(index));
  text += ".";
  const Windows& w = plan.windows;
  if (w.window > 0.0) text += " Windows of " + readable(w.window, "s");
  if (w.separation > 0.0) text += ", separated by " + readable(w.separation, "s");
  if (w.observation > 0.0) text += ", within observations of " + readable(w.observation, "s");
  return w.window > 0.0 ? text + "." : text;
}

std::string counted_unsafe(const Budget& b) {
  const auto count = [&](RuleStanding standing) {
    return std::count_if(b.levels.begin(), b.levels.end(),
                         [&](const BudgetLevel& l) { return l.standing == standing; });
  };
  const auto open = count(RuleStanding::in_doubt);
  return fmt::format("Against {} simulated levels the classical rule is unsafe in {} and wasteful in {}.{}",
                     b.levels.size(), count(RuleStanding::unsafe), count(RuleStanding::wasteful),
                     open > 0 ? fmt::format(" In {} the members are too few to tell whether it is fair.", open) : "");
}

}  // namespace

std::vector<BudgetSource> budget_sources(const BudgetStudy& s) {
  const BudgetRuns& r = s.runs;
  const std::string to = " to ";
  const std::uint64_t slots = 1 + r.groups() + r.joints();
  const std::string every = slots > 1 && r.rows() > 1 ? fmt::format(", one in {}", slots) : "";
  std::vector<BudgetSource> sources = {
      {kFromMembers,
       fmt::format(
           "the {} members: the mechanism as drawn{}, with each member's external errors", s.plan.members,
           s.plan.through ? ", its error through the loop's transfer functions (settled where a history begins)" : ""),
       std::to_string(r.drawn(0)) + to + std::to_string(r.drawn(r.rows() - 1)) + every},
      {kFromNominal,
       "the mechanism with every scattered parameter at its median; of several clearances, or with standing errors, "
       "each "
       "clearance alone",
       r.drawn(0) == 1 ? "0" : "0" + to + std::to_string(r.drawn(0) - 1)},
      {kFromAttribution,
       fmt::format("the first {} members in all variants: groups held, clearances halved", r.attribution()),
       std::to_string(r.drawn(0)) + to + std::to_string(r.drawn(r.attribution()) - 1)},
      {kFromClasses,
       "formulas of ECSS-E-ST-60-10C from the study's contributors, the windows' filters integrated over their "
       "spectra, and "
       "the clearances' and groups' moments",
       ""}};
  const bool of_errors = std::any_of(s.plan.contributors.begin(), s.plan.contributors.end(),
                                     [](const Contributor& c) { return c.of_error.has_value(); });
  if (of_errors || !s.plan.known.empty())
    sources.push_back({kFromInfluence,
                       "columns of influence of the standing errors along the commanded motion: to first order, "
                       "quasi-static",
                       ""});
  if (!s.plan.posterior.empty())
    sources.push_back({kFromCalibration, "what scatters: " + posterior_origin(s.plan), ""});
  return sources;
}

std::string posterior_origin(const BudgetPlan& plan) {
  const std::string file = plan.posterior + " (" + plan.posterior_hash.substr(0, 12) + ")";
  std::ifstream stream(std::filesystem::path(plan.posterior).parent_path() / "summary.json");
  const nlohmann::json made_by = nlohmann::json::parse(stream, nullptr, false);
  if (!made_by.is_object() || made_by.value("verb", nlohmann::json()) != "calibrate" || !made_by.contains("data"))
    return file + "; there is no summary.json of calibrate in its folder, so which data made it is not known";
  const auto named = [&](const char* pointer) {
    const nlohmann::json found = made_by.value(nlohmann::json::json_pointer(pointer), nlohmann::json("unknown"));
    return found.is_string() ? found.get<std::string>() : found.dump();
  };
  std::string data;
  for (const nlohmann::json& one : made_by["data"])
    data += (data.empty() ? "" : ", ") + (one.is_string() ? one.get<std::string>() : one.dump());
  return fmt::format("{}, fitted by {} ({}) to the data {} ({})", file, named("/study/file"),
                     named("/study/hash").substr(0, 12), data, named("/identity/options/data").substr(0, 12));
}

std::string level_title(const BudgetAxes& axes, ErrorIndex index, std::size_t axis, Interpretation interpretation,
                        double probability) {
  return fmt::format("{}, {}, {}, {}", to_string(index), axes.name(axis), to_string(interpretation),
                     percent(probability));
}

std::string requirement_title(const BudgetStudy& s, const BudgetRequirement& r) {
  const std::string over = r.exposure > 0.0 ? " over " + readable(r.exposure, "s") : "";
  return fmt::format("{}{}, {}, {}, {}", to_string(r.index), over, s.axes().name(r.axis), to_string(r.interpretation),
                     percent(r.probability));
}

const RequirementAnswer* headline_answer(const Budget& b) {
  const auto at = std::find_if(b.requirements.begin(), b.requirements.end(),
                               [](const RequirementAnswer& r) { return r.asked.exposure == 0.0; });
  return at == b.requirements.end() ? nullptr : &*at;
}

std::string budget_value(const BudgetStudy& s, double value) {
  const std::string written = s.plan.written_unit();
  if (written.empty() && s.study.index.si_unit() == "rad") return readable_arcsec(value);
  return readable_as(value, s.study.index.si_unit(), written);
}

std::string budget_value(const BudgetStudy& s, double value, const std::string& written) {
  return written.empty() ? budget_value(s, value) : readable_as(value, s.study.index.si_unit(), written);
}

std::string budget_limit(const BudgetStudy& s, double value, const std::string& written) {
  return readable_limit(value, s.study.index.si_unit(), written);
}

std::string requirement_sentence(const BudgetStudy& s, const RequirementAnswer& r) {
  const auto in_its_unit = [&](double value) { return budget_value(s, value, r.asked.unit); };
  std::string text =
      fmt::format("{}: {}, limit {}: {}", requirement_title(s, r.asked), in_its_unit(r.level.level.value),
                  budget_limit(s, r.asked.limit, r.asked.unit), r.compliance.met ? "met" : "not shown to be met");
  if (r.compliance.met)
    text += fmt::format(" with {} confidence, margin {}", percent(r.asked.confidence),
                        readable_share(r.margin() / r.asked.limit));
  else if (r.met_by_members)
    text += fmt::format(
        ": the members show it, the model does not. The {} rung and its steps may be off by up to {} of a member's "
        "mechanism; a more exact "
        "rung may show it",
        s.rung.name, readable_error(r.model_error));
  else if (r.margin() < 0.0)
    text += fmt::format(", {} above the limit", readable_share(-r.margin() / r.asked.limit));
  else
    text += r.judgement.by == Judgement::By::nothing
                ? std::string(": the members do not contradict it")
                : fmt::format(
                      ": the members do not contradict it, and show {:.4g} % with {} confidence; more of them "
                      "may show it",
                      100.0 * r.compliance.shown, percent(r.asked.confidence));
  return r.judgement.why.empty() ? text : text + " (" + r.judgement.why + ")";
}

std::string budget_verdict(const BudgetStudy& s) {
  const Budget& b = *s.budget;
  if (b.requirements.empty()) {
    const BudgetLevel& l = headline_level(b);
    return fmt::format("{}: {} ({}). No requirement was asked for.",
                       level_title(s.axes(), l.index, l.axis, l.interpretation, b.headline.probability),
                       budget_value(s, l.level.value), interval_text(s, l.level));
  }
  const auto met =
      std::count_if(b.requirements.begin(), b.requirements.end(), [](const auto& r) { return r.compliance.met; });
  std::string text =
      b.requirements.size() == 1 ? "" : fmt::format("{} of {} requirements met. ", met, b.requirements.size());
  const auto unmet =
      std::find_if(b.requirements.begin(), b.requirements.end(), [](const auto& r) { return !r.compliance.met; });
  text += requirement_sentence(s, unmet == b.requirements.end() ? b.requirements.front() : *unmet) + ".";
  if (!b.reductions.empty() && b.reductions.front().gain() > 0.0)
    text += fmt::format(" Tighten first: {}; {} takes {} off the {} {}.", b.reductions.front().name,
                        b.reductions.front().action, budget_value(s, b.reductions.front().gain()),
                        to_string(b.headline.index), s.axes().name(b.headline.axis));
  return text;
}

report::Document budget_report(const BudgetStudy& s) {
  report::Document document{
      .title = s.mechanism.name(),
      .subtitle = fmt::format("Pointing budget of the {}, {} members", s.study.index.quantity_title(), s.plan.members),
      .verb = "budget"};
  document.warnings = s.warnings;
  document.provenance = provenance_of(s.command, s.mechanism, s.rung);
  document.provenance.back() = {
      "Data", fmt::format("summary.json, levels.csv, classical.csv, contributions.csv{}; samples.db holds every run",
                          s.budget && !s.budget->spectral.empty() ? ", spectra.csv" : "")};
  document.provenance.push_back({"Study", s.study.file});
  document.provenance.push_back({"Study hash", s.study.content_hash});
  document.provenance.push_back({"Seed", std::to_string(s.plan.seed)});
  if (!s.budget) {
    document.verdict = report::Verdict{report::Standing::bad,
                                       "Interrupted before all runs were there. The same command goes on from here."};
    return document;
  }
  const Budget& b = *s.budget;
  const BudgetLevel& headline = headline_level(b);
  document.verdict = report::Verdict{b.requirements.empty() ? report::Standing::neutral
                                     : b.met()              ? report::Standing::good
                                                            : report::Standing::bad,
                                     budget_verdict(s)};
  document.facts.push_back({.label = fmt::format("{} {}", to_string(b.headline.index), s.axes().name(b.headline.axis)),
                            .value = budget_value(s, headline.level.value),
                            .note = fmt::format("{}, {}; {}", to_string(b.headline.interpretation),
                                                percent(b.headline.probability), interval_text(s, headline.level))});
  if (const RequirementAnswer* answer = headline_answer(b)) {
    document.facts.push_back({.label = "Limit", .value = budget_limit(s, b.headline.limit, b.headline.unit)});
    document.facts.push_back(
        {.label = "Margin", .value = readable_share(answer->margin() / b.headline.limit), .note = "of the limit"});
  }
  const std::string doubt = rule_doubt(s, headline);
  document.facts.push_back({.label = "Classical rule",
                            .value = budget_value(s, headline.by_rule),
                            .note = standing_text(headline.standing, headline.by_rule, headline.level.value) +
                                    (doubt.empty() ? "" : "; " + doubt)});
  document.facts.push_back({.label = "Members", .value = b.members, .note = fmt::format("{} failed", b.failed)});

  report::Section answers{.id = "answer", .title = "The budget", .intro = index_titles(s.plan), .items = {}};
  if (!b.requirements.empty()) answers.items.emplace_back(requirement_table(s, b));
  answers.items.emplace_back(level_chart(s, b));
  document.sections.push_back(std::move(answers));
  if (!b.contributions.empty())
    document.sections.push_back({.id = "contributions",
                                 .title = "Who contributes, and what to tighten first",
                                 .intro = (headline_answer(b) ? "Shares and gains are of the first requirement: "
                                                              : "Shares and gains are of ") +
                                          level_title(s.axes(), b.headline.index, b.headline.axis,
                                                      b.headline.interpretation, b.headline.probability) +
                                          ".",
                                 .items = {waterfall_chart(s, b), contribution_table(s, b), relief_table(s, b)}});
  report::Section classical{.id = "classical",
                            .title = "Simulated, and the classical table",
                            .intro = counted_unsafe(b),
                            .items = {level_table(s, b), contributor_table(s)}};
  for (const ClassicalTable& t : b.tables)
    if (t.interpretation == b.headline.interpretation) classical.items.emplace_back(classical_table(s, t));
  document.sections.push_back(std::move(classical));
  if (!b.parts.empty()) document.sections.push_back(tree_section(s, b));
  if (!b.jitter.empty()) document.sections.push_back(jitter_section(s, b));
  if (!b.spectral.empty()) document.sections.push_back(spectra_section(s, b));
  document.sections.push_back({.id = "histories",
                               .title = "The histories behind it",
                               .items = {distribution_chart(s, b), history_panels(s, b)}});
  document.sections.push_back(
      {.id = "model",
       .title = "What this model leaves out",
       .items = {report::Text{
           s.leaves_out +
           fmt::format(
               "\n\nBy its own estimate the rung is off by {} for what it leaves out, mean over the runs. By its "
               "steps: {} ({}). The intervals above are of sampling alone.",
               readable_error(s.model_error),
               std::isfinite(s.steps.relative) ? readable_error(s.steps.relative) : "not measured", s.steps.why)}}});
  document.sections.push_back({.id = "sources", .title = "Where each number comes from", .items = {source_table(s)}});
  if (s.rung.pilot) document.sections.push_back(pilot_section(*s.rung.pilot));
  return document;
}

}  // namespace boresight::app
