#include "allocate/allocate_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "boresight/pointing/relative_text.hpp"
#include "report_parts/report_parts.hpp"
#include "terminal/readable.hpp"

namespace boresight::app {
namespace {

// "F1" of "clearance.F1.radial", "rod1.length" of "error.rod1.length".
std::string label_of(const std::string& path) {
  constexpr std::string_view kError = "error.", kClearance = "clearance.", kRadial = ".radial";
  if (path.starts_with(kError)) return path.substr(kError.size());
  if (!path.starts_with(kClearance) || !path.ends_with(kRadial)) return path;
  return path.substr(kClearance.size(), path.size() - kClearance.size() - kRadial.size());
}

bool has_errors(const AllocationPlan& plan) {
  return std::any_of(plan.entries.begin(), plan.entries.end(), [](const AllocationEntry& e) { return e.is_error; });
}

std::string index_text(const AllocateStudy& s, double value) {
  return std::isfinite(value) ? readable_as(value, s.study.index.si_unit(), s.plan.requirement.unit) : "none";
}

std::string limit_text(const AllocateStudy& s) {
  return readable_limit(s.plan.requirement.limit, s.study.index.si_unit(), s.plan.requirement.unit);
}

std::vector<const Allocation*> all_of(const AllocateStudy& s) {
  return {&s.result.chosen, &s.result.worst_case, &s.result.root_sum_square};
}

report::Table comparison_table(const AllocateStudy& s) {
  report::Table table{
      .title = "Beside what the classical rules would choose",
      .caption = fmt::format("The same limit, {}. Share within it: by the {} samples of the search, scaled to "
                             "the confirming rung; least limit: kept with the room that a confirmation "
                             "needs.",
                             limit_text(s), s.plan.samples),
      .columns = {{"judged by"}, {"price"}, {"share within the limit"}, {"least limit kept"}, {"verdict"}}};
  for (const Allocation* a : all_of(s)) {
    const bool none = !a->feasible && a != &s.result.chosen;
    table.rows.push_back({a->judged_by, none ? nlohmann::json("no set") : nlohmann::json(a->price),
                          none ? "" : readable_share(a->share_within), none ? "" : index_text(s, a->reached),
                          standing_of(s, *a)});
  }
  return table;
}

report::Table option_table(const AllocateStudy& s) {
  report::Table table{
      .title = has_errors(s.plan) ? "The choice, joint by joint and part by part" : "The choice, joint by joint",
      .caption =
          "Share of the error: of the index' variance, to first order, slopes averaged over the samples. Saving: by "
          "the next cheaper option of this one alone.",
      .columns = {{has_errors(s.plan) ? "joint or error" : "joint"},
                  {"chosen"},
                  {"price"},
                  {"share of cost", "%"},
                  {"share of error", "%"},
                  {"saving"}}};
  if (s.result.worst_case.feasible) table.columns.push_back({"worst case"});
  if (s.result.root_sum_square.feasible) table.columns.push_back({"root-sum-square"});
  for (std::size_t j = 0; j < s.result.shares.size(); ++j) {
    const AllocationShare& share = s.result.shares[j];
    std::vector<nlohmann::json> row = {label_of(share.joint),
                                       option_text(s, s.result.chosen, j),
                                       share.price,
                                       100.0 * share.cost_share,
                                       100.0 * share.error_share,
                                       share.next_saving > 0.0 ? nlohmann::json(share.next_saving) : nlohmann::json()};
    for (const Allocation* a : {&s.result.worst_case, &s.result.root_sum_square})
      if (a->feasible) row.emplace_back(option_text(s, *a, j));
    table.rows.push_back(std::move(row));
  }
  return table;
}

report::Chart share_chart(const AllocateStudy& s) {
  report::Chart chart{.title = "Where the error comes from and where the money goes",
                      .x = {has_errors(s.plan) ? "joint or error" : "joint", ""},
                      .y = {"share", "%"}};
  report::Names joints;
  report::Numbers error, cost;
  for (const AllocationShare& share : s.result.shares) {
    joints.push_back(label_of(share.joint));
    error.push_back(100.0 * share.error_share);
    cost.push_back(100.0 * share.cost_share);
  }
  chart.series.push_back({.name = "error", .x = joints, .y = error, .style = report::Style::bars});
  chart.series.push_back({.name = "cost", .x = joints, .y = cost, .style = report::Style::bars});
  return chart;
}

report::Chart front_chart(const AllocateStudy& s) {
  double most = s.plan.requirement.limit;
  for (const CostPoint& p : s.result.front) most = std::max(most, p.limit);
  const DisplayUnit unit = display_unit_as(s.study.index.si_unit(), most, s.plan.requirement.unit);
  report::Chart chart{.title = "What accuracy costs",
                      .caption =
                          "The line: the cheapest set for each limit, by the samples of the search; between two sets "
                          "there is none. The points: what a set keeps by the runs that judged it, with the "
                          "room that the search left it.",
                      .x = {"limit of the " + s.study.index.title(), unit.name},
                      .y = {"price", ""}};
  std::vector<CostPoint> front = s.result.front;
  std::sort(front.begin(), front.end(), [](const CostPoint& a, const CostPoint& b) { return a.limit < b.limit; });
  report::Numbers x, y;
  for (const CostPoint& p : front)
    if (p.feasible) {
      x.push_back(p.limit * unit.per_si);
      y.push_back(p.price);
    }
  chart.series.push_back({.name = "cheapest", .x = x, .y = y, .style = report::Style::steps});
  for (const Allocation* a : all_of(s))
    if (a->feasible)
      chart.series.push_back({.name = a == &s.result.chosen ? "chosen" : a->judged_by,
                              .x = report::Numbers{a->reached * unit.per_si},
                              .y = report::Numbers{a->price},
                              .style = report::Style::markers});
  chart.lines.push_back({'x', s.plan.requirement.limit * unit.per_si, "required"});
  return chart;
}

report::Table confirmation_table(const AllocateStudy& s) {
  report::Table table{
      .title = "Confirmation",
      .caption =
          "Factor: the index of the confirming rung over that of the linear deviation, as the search of this "
          "round took it.",
      .columns = {{"round"},
                  {"rung"},
                  {"factor"},
                  {"price"},
                  {"samples"},
                  {"failed"},
                  {"within the limit"},
                  {"at least"},
                  {"least limit shown"},
                  {"outcome"}}};
  for (std::size_t k = 0; k < s.result.confirmations.size(); ++k) {
    const AllocationConfirmation& c = s.result.confirmations[k];
    table.rows.push_back({k + 1, c.rung, c.factor, c.price, c.samples, c.failed, readable_share(c.share_within),
                          readable_share(c.share_low), index_text(s, c.reached),
                          !c.met     ? "not met"
                          : c.agrees ? "met"
                                     : "met with room"});
  }
  return table;
}

}  // namespace

std::string requirement_text(const AllocateStudy& s) {
  return fmt::format("{} at or below {} in {:g} % of all cases, with {:g} % confidence", s.study.index.title(),
                     limit_text(s), 100.0 * s.plan.requirement.probability, 100.0 * s.plan.requirement.confidence);
}

std::string option_text(const AllocateStudy& s, const Allocation& a, std::size_t joint) {
  const AllocationEntry& entry = s.plan.entries[joint];
  if (entry.is_continuous())
    return a.tolerance.empty() ? "" : readable_as(a.tolerance[joint], entry.unit(), entry.said_in);
  return a.choice.empty() ? "" : entry.options[static_cast<std::size_t>(a.choice[joint])].name;
}

std::string standing_of(const AllocateStudy& s, const Allocation& a) {
  if (&a == &s.result.chosen) return a.feasible ? "chosen" : "the tightest there is";
  if (!a.feasible) return "finds nothing that keeps the limit";
  if (!a.meets) return fmt::format("unsafe: only {} within the limit", readable_share(a.share_within));
  if (s.result.chosen.feasible && a.price > s.result.chosen.price * (1.0 + 1e-6)) {
    const double times = a.price / s.result.chosen.price;
    return "wasteful: " +
           (times < kSaidAsMultiple ? relative_text(times - 1.0, 3) + " dearer" : relative_text(times, 3, "the price"));
  }
  if (s.result.chosen.feasible && a.price < s.result.chosen.price * (1.0 - 1e-6))
    return fmt::format(
        "cheaper, and meets it by the samples of the search, but too closely for {} fresh samples to show it",
        s.plan.confirm);
  return "meets the requirement";
}

std::string allocate_sentence(const AllocateStudy& s) {
  if (s.result.interrupted) return "Interrupted; the same command goes on and reuses what was computed.";
  if (!s.result.feasible)
    return fmt::format("Infeasible: no allocation {} to keep {}. The best that was reached is {}, for {:.4g}: {}.",
                       s.result.converged ? "can be shown" : "was found", requirement_text(s),
                       index_text(s, s.result.best_reachable), s.result.chosen.price,
                       s.result.confirmations[s.result.confirmed_by].sentence);
  return fmt::format(
      "The cheapest choice{} costs {:.5g} and keeps the {}. {}{}.", s.result.chosen.proven ? "" : " that was found",
      s.result.chosen.price, requirement_text(s),
      s.result.chosen.proven ? "By the linear deviation, scaled as this rung's samples asked for, nothing cheaper "
                               "keeps the limit with the "
                               "room that a confirmation needs. "
      : s.result.chosen.finished && s.plan.scattered() > s.plan.linear_inputs.size()
          ? "Nothing cheaper was found; part of what scatters besides counts as one factor there, so that something "
            "cheaper "
            "may keep the limit. "
      : s.result.chosen.finished ? "Nothing cheaper was found near it; that nothing is elsewhere is not proven. "
      : s.result.chosen.bound > 0.0
          ? fmt::format(
                "No choice below {:.5g} keeps the limit with the room that this confirmation needs; between the "
                "two the search ended before it had looked everywhere. ",
                s.result.chosen.bound)
          : "",
      s.result.confirmations[s.result.confirmed_by].sentence);
}

std::string last_micro_sentence(const AllocateStudy& s) {
  const double costs = s.result.last_micrometre;
  const std::string step = s.study.index.si_unit() == "m" ? "1 µm" : "1 µrad", typed = index_text(s, kLastMicro);
  const bool alike = s.plan.requirement.unit.ends_with("rad") || s.study.index.si_unit() == "m" || typed == step;
  return fmt::format("keeping the limit by {}{} tighter costs {}", step, alike ? "" : " (" + typed + ")",
                     costs > 0.0 ? fmt::format("{:.4g} more", costs) : "nothing more");
}

report::Document allocate_report(const AllocateStudy& s) {
  report::Document document{
      .title = s.mechanism.name(), .subtitle = "Allocation: " + requirement_text(s), .verb = "allocate"};
  document.verdict =
      report::Verdict{s.result.feasible && !s.result.interrupted ? report::Standing::good : report::Standing::bad,
                      allocate_sentence(s)};
  document.warnings = s.warnings;
  document.provenance = provenance_of(s.command, s.mechanism, s.rung);
  document.provenance.back() = {"Data",
                                "summary.json and allocation.csv beside this file; confirmation.db holds every sample"};
  document.provenance.push_back({"Study hash", s.study.content_hash});
  const Allocation& a = s.result.chosen;
  document.facts = {
      {.label = "Price", .value = a.price},
      {.label = "Least limit kept", .value = index_text(s, a.reached), .note = "by the samples of the search"},
      {.label = has_errors(s.plan) ? "Joints and errors" : "Joints", .value = s.plan.entries.size()}};
  if (s.result.feasible && std::isfinite(s.result.last_micrometre))
    document.facts.push_back({.label = s.study.index.si_unit() == "m" ? "The last micrometre" : "The last microradian",
                              .value = s.result.last_micrometre,
                              .note = "what keeping the limit by that much tighter costs"});
  if (!s.result.shares.empty())
    document.sections.push_back({.id = "choice", .title = "What to order", .items = {option_table(s), share_chart(s)}});
  if (!a.choice.empty() || !a.tolerance.empty())
    document.sections.push_back(
        {.id = "rules",
         .title = "Against worst case and root-sum-square",
         .intro = "The worst case adds all gaps and errors at their largest and all in one direction; the "
                  "root-sum-square takes the index at the mean gaps and the normal law about it.",
         .items = {comparison_table(s)}});
  if (s.result.front.size() > 1)
    document.sections.push_back({.id = "front", .title = "Cost and accuracy", .items = {front_chart(s)}});
  if (!s.result.confirmations.empty())
    document.sections.push_back({.id = "confirmation", .title = "How sure it is", .items = {confirmation_table(s)}});
  document.sections.push_back({.id = "model",
                               .title = "What this model leaves out",
                               .items = {report::Text{fmt::format(
                                   "The search sums the error linearly over the joints, as journals at rest under the "
                                   "ideal reactions displace the "
                                   "platform{}; against its own rung that is off by {}. Impacts come in by the "
                                   "factor {:.4g}, measured on the {} rung "
                                   "and taken as one for all samples; the confirmation does without either.\n\n{}",
                                   has_errors(s.plan) ? ", and over the parts' own errors" : "",
                                   relative_text(s.result.misfit), s.result.factor, s.rung.name, s.leaves_out)}}});
  return document;
}

}  // namespace boresight::app
