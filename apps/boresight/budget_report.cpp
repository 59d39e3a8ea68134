#include "budget_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <numbers>

#include "pilot_parts.hpp"
#include "readable.hpp"
#include "report_parts.hpp"

namespace boresight::app {
namespace {

constexpr double kArcsecPerRadian = 180.0 / std::numbers::pi * 3600.0;

std::string percent(double share) { return fmt::format("{:g} %", 100.0 * share); }

DisplayUnit unit_of(const BudgetStudy& s, double largest) {
  if (s.study.index.si_unit() == "rad") return {"arcsec", kArcsecPerRadian};
  return display_unit(s.study.index.si_unit(), largest);
}

std::string interval_text(const BudgetStudy& s, const ReportedInterval& i) {
  return budget_value(s, i.low) + " to " + (std::isfinite(i.high) ? budget_value(s, i.high) : "no bound");
}

std::string standing_text(RuleStanding standing, double by_rule, double simulated) {
  if (simulated <= 0.0) return "fair";
  return fmt::format("{}, {:+.0f} %", to_string(standing), 100.0 * (by_rule / simulated - 1.0));
}

const BudgetLevel& headline_level(const Budget& b) {
  return *std::find_if(b.levels.begin(), b.levels.end(), [&](const BudgetLevel& l) {
    return l.index == b.headline.index && l.interpretation == b.headline.interpretation && l.axis == b.headline.axis;
  });
}

report::Table requirement_table(const BudgetStudy& s, const Budget& b) {
  report::Table table{
      .title = "Requirements",
      .caption =
          "Met only where the members show it at the confidence asked for. Margin: limit less level, over the "
          "limit. The rule's answer beside it is that of the classical table.",
      .columns = {{"Requirement"},
                  {"Limit"},
                  {"Level"},
                  {"Interval"},
                  {"Margin"},
                  {"Shown share"},
                  {"Answer"},
                  {"Classical rule"},
                  {"Source"}}};
  for (const RequirementAnswer& r : b.requirements)
    table.rows.push_back(
        {level_title(s.axes(), r.asked.index, r.asked.axis, r.asked.interpretation, r.asked.probability),
         budget_value(s, r.asked.limit), budget_value(s, r.level.level.value), interval_text(s, r.level.level),
         readable_share(r.margin() / r.asked.limit),
         fmt::format("{:.4g} % with {} confidence", 100.0 * r.compliance.shown, percent(r.asked.confidence)),
         r.compliance.met ? "met" : "not shown to be met",
         fmt::format("{} ({})", budget_value(s, r.level.by_rule), r.rule_says_met() ? "met" : "not met"),
         kFromMembers});
  return table;
}

// Numbers of a column; what is rounding beside the largest is zero.
nlohmann::json cell(double value, const DisplayUnit& unit, double largest) {
  constexpr double kRoundingShare = 1e-9;
  if (!std::isfinite(value)) return nullptr;
  return std::abs(value) < kRoundingShare * largest ? 0.0 : value * unit.per_si;
}

report::Table level_table(const BudgetStudy& s, const Budget& b) {
  const BudgetAxes axes = s.axes();
  double largest = 0.0;
  for (const BudgetLevel& l : b.levels) largest = std::max(largest, l.level.value);
  const DisplayUnit unit = unit_of(s, largest);
  report::Table table{
      .title = "Levels in " + unit.name + ", simulated and by rule",
      .caption =
          fmt::format("Levels that hold with {}; from and to: their {} interval. By rule: one axis |mean| + n_P sd, "
                      "the {} by the rule for equal axes without a mean; integrated: the Gaussian with the table's "
                      "means and deviations. Unsafe: the rule is more than {:.0f} % below what was simulated; "
                      "wasteful: more than {:.0f} % above. Sources: {}, of the rule {}.",
                      percent(b.headline.probability), percent(s.plan.confidence), axes.total,
                      100.0 * (1.0 - kUnsafeBelow), 100.0 * (kWastefulAbove - 1.0), kFromMembers, kFromClasses),
      .columns = {{"Index, axis"},
                  {"Interpretation"},
                  {"Simulated"},
                  {"from"},
                  {"to"},
                  {"By rule", "", "right"},
                  {"The rule is"},
                  {"Integrated"}}};
  const auto number = [&](double value) { return cell(value, unit, largest); };
  for (const BudgetLevel& l : b.levels)
    table.rows.push_back({std::string(to_string(l.index)) + " " + axes.name(l.axis), to_string(l.interpretation),
                          number(l.level.value), number(l.level.low), number(l.level.high), number(l.by_rule),
                          standing_text(l.standing, l.by_rule, l.level.value),
                          l.integrated ? number(*l.integrated) : nlohmann::json()});
  return table;
}

report::Chart level_chart(const BudgetStudy& s, const Budget& b) {
  const BudgetAxes axes = s.axes();
  report::Names names;
  std::vector<const BudgetLevel*> shown;
  double largest = 0.0;
  for (const BudgetLevel& l : b.levels)
    if (l.interpretation == b.headline.interpretation) {
      shown.push_back(&l);
      names.push_back(std::string(to_string(l.index)) + " " + axes.name(l.axis));
      largest = std::max(largest, l.level.value);
    }
  const DisplayUnit unit = unit_of(s, largest);
  report::Chart chart{
      .title = fmt::format("Simulated levels beside the classical rule, {}, {}", to_string(b.headline.interpretation),
                           percent(b.headline.probability)),
      .caption = fmt::format("Whiskers: {} interval of the simulated level; one that has no upper bound is drawn "
                             "without its upper half.",
                             percent(s.plan.confidence)),
      .x = {"index and axis"},
      .y = {"level", unit.name}};
  report::Series simulated{.name = "simulated", .x = names, .style = report::Style::bars, .color = 1};
  report::Series rule{.name = "classical rule", .x = names, .style = report::Style::bars, .color = 2};
  report::Numbers y, by_rule;
  for (const BudgetLevel* l : shown) {
    y.push_back(l->level.value * unit.per_si);
    by_rule.push_back(l->by_rule * unit.per_si);
    simulated.error_low.push_back(std::max(0.0, l->level.value - l->level.low) * unit.per_si);
    simulated.error_high.push_back(
        std::isfinite(l->level.high) ? std::max(0.0, l->level.high - l->level.value) * unit.per_si : 0.0);
  }
  simulated.y = y;
  rule.y = by_rule;
  chart.series = {simulated, rule};
  for (const RequirementAnswer& r : b.requirements)
    if (r.asked.index == b.headline.index && r.asked.axis == b.headline.axis)
      chart.lines.push_back(
          {'y', r.asked.limit * unit.per_si,
           "limit of " + level_title(axes, r.asked.index, r.asked.axis, r.asked.interpretation, r.asked.probability)});
  return chart;
}

// Where each bar of the waterfall begins and ends, in shares of the level.
struct WaterfallStep {
  std::string name;
  double from, to;
  int color;
};

int color_of(const std::string& kind) {
  if (kind == kClearanceKind) return 1;
  if (kind == kScatterKind) return 3;
  return kind == "joints and scatter" ? 8 : 5;
}

report::Chart waterfall_chart(const BudgetStudy& s, const Budget& b) {
  const double level = headline_level(b).level.value;
  const DisplayUnit unit = unit_of(s, level);
  report::Chart chart{
      .title = "What makes the level",
      .caption =
          "Each contribution's share of the mean square, times the level. A bar to the left takes away: it works "
          "against the others. \"Together\" is what clearances and scatter make only jointly.",
      .x = {"level", unit.name},
      .y = {"contribution"}};
  std::vector<WaterfallStep> steps;
  double at = 0.0;
  for (const Contribution& c : b.contributions) {
    steps.push_back({c.name, at, at + c.share, color_of(c.kind)});
    at += c.share;
  }
  steps.push_back({"level", 0.0, 1.0, 7});
  double nearest = 0.0, farthest = 1.0;
  for (const auto& [color, name] : std::vector<std::pair<int, std::string>>{
           {1, "clearances"}, {3, "scatter"}, {8, "together"}, {5, "external"}, {7, "level"}}) {
    report::Series series{.name = name, .style = report::Style::bars, .color = color};
    report::Numbers x;
    report::Names y;
    for (const WaterfallStep& step : steps) {
      if (step.color != color) continue;
      series.y_low.push_back(step.from * level * unit.per_si);
      x.push_back(step.to * level * unit.per_si);
      y.push_back(step.name);
      series.text.push_back(budget_value(s, (step.to - step.from) * level));
      farthest = std::max({farthest, step.from, step.to});
      nearest = std::min({nearest, step.from, step.to});
    }
    if (x.empty()) continue;
    series.x = x;
    series.y = y;
    chart.series.push_back(std::move(series));
  }
  if (!b.requirements.empty()) {
    chart.lines.push_back({'x', b.headline.limit * unit.per_si, "limit " + budget_value(s, b.headline.limit)});
    farthest = std::max(farthest, b.headline.limit / level);
  }
  constexpr double kRoomForText = 0.15;
  chart.x.range = {(nearest < 0.0 ? nearest - kRoomForText : 0.0) * level * unit.per_si,
                   (farthest + kRoomForText) * level * unit.per_si};
  return chart;
}

report::Table contribution_table(const BudgetStudy& s, const Budget& b) {
  const double level = headline_level(b).level.value;
  report::Table table{.title = "Shares",
                      .caption = "Of the mean square of the index over members and time; they add up to 100 %.",
                      .columns = {{"Contribution"}, {"Kind"}, {"Share", "%"}, {"Of the level"}, {"Source"}}};
  for (const Contribution& c : b.contributions) {
    const bool nominal = c.kind == kClearanceKind, attribution = c.kind == kScatterKind;
    table.rows.push_back({c.name, c.kind, 100.0 * c.share, budget_value(s, c.share * level),
                          nominal       ? kFromNominal
                          : attribution ? kFromAttribution
                                        : kFromMembers});
  }
  return table;
}

report::Table relief_table(const BudgetStudy& s, const Budget& b) {
  const double level = headline_level(b).level.value;
  report::Table table{
      .title = "What to tighten first",
      .caption = fmt::format("The level of {} of the members, and what it becomes if one thing is better; not a linear "
                             "guess but runs of their own. Margin then: the gain taken off the level of all members.",
                             b.attribution),
      .columns = {{"What"}, {"If"}, {"Level now"}, {"Level then"}, {"Gain"}, {"Margin then"}, {"Source"}}};
  const bool asked = !b.requirements.empty();
  for (const Relief& r : b.reliefs)
    table.rows.push_back(
        {r.name, r.action, budget_value(s, r.before), budget_value(s, r.after), budget_value(s, r.gain()),
         asked ? readable_share((b.headline.limit - level + r.gain()) / b.headline.limit) : "", kFromAttribution});
  return table;
}

std::string spread_text(const Distribution& d, const std::function<std::string(double)>& text) {
  if (d.sd() == 0.0) return text(d.mean()) + " in all";
  std::string out = fmt::format("mean {}, sd {}", text(d.mean()), text(d.sd()));
  if (std::isfinite(d.lowest()) && std::isfinite(d.highest()))
    out += fmt::format(", from {} to {}", text(d.lowest()), text(d.highest()));
  return out;
}

report::Table contributor_table(const BudgetStudy& s) {
  report::Table table{
      .title = "Contributors",
      .caption =
          "What is in the budget: clearances follow from the motion, scatter from what the study draws per member, "
          "the others from outside as the study gives them.",
      .columns = {{"Contributor"}, {"Class"}, {"Course in time"}, {"Over the members"}, {"Axes"}, {"Source"}}};
  const MechanismDescription& m = s.mechanism.description();
  for (const ClearanceDescription& c : m.clearances)
    table.rows.push_back({m.joints[static_cast<std::size_t>(c.joint)].name, kClearanceKind,
                          "the motion's own, " + readable(s.mechanism.duration(), "s"),
                          fmt::format("radial {}, axial {} where nothing else is drawn",
                                      readable(c.parameters.radial, "m"), readable(c.parameters.axial, "m")),
                          "all", kFromNominal});
  for (std::size_t g = 0; g < s.plan.groups.names.size(); ++g) {
    std::string spread;
    for (const int i : s.plan.groups.members[g]) {
      const RandomParameter& p = s.plan.inputs.parameters[static_cast<std::size_t>(i)];
      spread += (spread.empty() ? "" : "; ") + (p.name() == s.plan.groups.names[g] ? "" : p.name() + ": ") +
                spread_text(*p.distribution, [&](double v) { return readable(v, p.si_unit); });
    }
    table.rows.push_back({s.plan.groups.names[g], kScatterKind, "fixed in a member", spread, "all",
                          s.plan.posterior.empty() ? kFromAttribution : kFromCalibration});
  }
  for (const Contributor& c : s.plan.contributors) {
    std::string axes, spread, in_time = c.kind == ContributorClass::bias ? "constant" : "linear";
    if (c.recalibrated) in_time += ", anew with every observation";
    if (c.kind == ContributorClass::periodic) in_time = "period " + readable(c.period, "s");
    if (c.kind == ContributorClass::random) in_time = "correlation time " + readable(c.correlation_time, "s");
    for (std::size_t a = 0; a < s.axes().count(); ++a) {
      if (!c.parameter[a]) continue;
      axes += (axes.empty() ? "" : ", ") + s.axes().names[a];
      const std::string per = c.kind == ContributorClass::drift ? "/s" : "";
      spread = spread_text(*c.parameter[a], [&](double v) { return budget_value(s, v) + per; });
    }
    table.rows.push_back({c.name, to_string(c.kind), in_time, spread, axes, kFromClasses});
  }
  return table;
}

report::Table classical_table(const BudgetStudy& s, const ClassicalTable& t) {
  const BudgetAxes axes = s.axes();
  double largest = 0.0;
  for (const Moments& m : t.total.axes) largest = std::max({largest, std::abs(m.mean), m.sd});
  const DisplayUnit unit = unit_of(s, largest);
  report::Table table{
      .title = fmt::format("Classical table: {}, {}", to_string(t.index), to_string(t.interpretation)),
      .caption =
          "Means add linearly, deviations by root sum of squares, linearly within a group. Clearances: the "
          "motion at the medians, one joint open at a time. Scatter: what mean and variance lose with the group "
          "held at its medians. Others: by their class, with exact window filters.",
      .columns = {{"Contributor"}, {"Class"}, {"Group"}}};
  for (const std::string& name : axes.names) {
    table.columns.push_back({"mean " + name, unit.name});
    table.columns.push_back({"sd " + name, unit.name});
  }
  table.columns.push_back({"Source"});
  const auto row = [&](std::vector<nlohmann::json> cells, const std::vector<Moments>& moments, const char* source) {
    for (const Moments& m : moments) {
      cells.push_back(cell(m.mean, unit, largest));
      cells.push_back(cell(m.sd, unit, largest));
    }
    cells.emplace_back(source);
    table.rows.push_back(std::move(cells));
  };
  for (const ClassicalLine& line : t.lines)
    row({line.name, line.kind, line.group}, line.axes,
        line.kind == kClearanceKind ? kFromNominal
        : line.kind == kScatterKind ? kFromAttribution
                                    : kFromClasses);
  row({"total", "", ""}, t.total.axes, kFromClasses);
  return table;
}

report::Chart distribution_chart(const BudgetStudy& s, const Budget& b) {
  constexpr std::size_t kPoints = 600;
  std::vector<double> pooled, maxima;
  for (const std::vector<double>& member : b.headline_sizes) {
    pooled.insert(pooled.end(), member.begin(), member.end());
    maxima.push_back(*std::max_element(member.begin(), member.end()));
  }
  std::sort(pooled.begin(), pooled.end());
  std::sort(maxima.begin(), maxima.end());
  const DisplayUnit unit = unit_of(s, pooled.back());
  report::Chart chart{
      .title = fmt::format("{} {}: how much lies below", to_string(b.headline.index), s.axes().name(b.headline.axis)),
      .caption = "Mixed: members and time together. Ensemble: each member by its largest value over time.",
      .x = {"size", unit.name},
      .y = {"share at or below", "%", false, std::array{0.0, 100.5}}};
  const auto curve_of = [&](const char* name, const std::vector<double>& sorted, report::Style style) {
    report::Numbers x, y;
    const auto n = static_cast<double>(sorted.size());
    const std::size_t stride = std::max<std::size_t>(1, sorted.size() / kPoints);
    for (std::size_t k = 0; k < sorted.size(); k += stride) {
      x.push_back(sorted[k] * unit.per_si);
      y.push_back(100.0 * (static_cast<double>(k) + 1.0) / n);
    }
    x.push_back(sorted.back() * unit.per_si);
    y.push_back(100.0);
    chart.series.push_back({.name = name, .x = x, .y = y, .style = style});
  };
  curve_of("mixed", pooled, report::Style::line);
  curve_of("ensemble", maxima, report::Style::steps);
  if (!b.requirements.empty())
    chart.lines.push_back({'x', b.headline.limit * unit.per_si, "limit " + budget_value(s, b.headline.limit)});
  return chart;
}

report::Panels history_panels(const BudgetStudy& s, const Budget& b) {
  const BudgetAxes axes = s.axes();
  report::Panels panels{
      .title = "Pointing error over time",
      .caption =
          fmt::format("Shaded: where nine tenths of the first {} members lie, external errors included. Line: the "
                      "mechanism alone, every scattered parameter at its median.",
                      b.shown.size()),
      .columns = static_cast<int>(std::min<std::size_t>(3, axes.count() + 1))};
  const std::size_t n = b.nominal.error.size(), stride = std::max<std::size_t>(1, n / kPointsPerCurve);
  for (std::size_t axis = 0; axis <= axes.count(); ++axis) {
    const auto value = [&](const Vec3& e) {
      return axis < axes.count() ? e[static_cast<Eigen::Index>(axis)] : e.norm();
    };
    double largest = 0.0;
    for (const PointingHistory& h : b.shown)
      for (const Vec3& e : h.error) largest = std::max(largest, std::abs(value(e)));
    const DisplayUnit unit = unit_of(s, largest);
    std::vector<double> time, nominal;
    report::Numbers low, high;
    for (std::size_t k = 0; k < n; k += stride) {
      std::vector<double> at;
      for (const PointingHistory& h : b.shown) at.push_back(value(h.error[k]) * unit.per_si);
      std::sort(at.begin(), at.end());
      const double last = static_cast<double>(at.size() - 1);
      low.push_back(at[static_cast<std::size_t>(std::lround(0.05 * last))]);
      high.push_back(at[static_cast<std::size_t>(std::lround(0.95 * last))]);
      time.push_back(s.plan.start + static_cast<double>(k) * s.plan.sampling);
      nominal.push_back(value(b.nominal.error[k]));
    }
    report::Chart chart{.title = axes.name(axis), .x = {"Time", "s"}, .y = {"error", unit.name}};
    chart.series.push_back(
        {.name = "members", .x = time, .y = high, .style = report::Style::area, .y_low = low, .color = 1});
    chart.series.push_back(curve("mechanism at its medians", time, nominal, unit.per_si));
    chart.series.back().color = 2;
    panels.panels.push_back(std::move(chart));
  }
  return panels;
}

report::Table source_table(const BudgetStudy& s) {
  const MechanismDescription& m = s.mechanism.description();
  const std::string rung = s.rung.name + (s.step > 0.0 ? ", step " + readable(s.step, "s") : "");
  report::Table table{
      .title = "Sources",
      .caption =
          "Every table names its sources by these letters. Runs are numbers in samples.db beside this file; a "
          "member's runs and external errors follow from study, mechanism, rung, seed and number alone.",
      .columns = {{"Source"},
                  {"What"},
                  {"Runs"},
                  {"Store"},
                  {"Rung"},
                  {"Seed"},
                  {"Study"},
                  {"Study hash"},
                  {"Mechanism hash"}}};
  for (const BudgetSource& source : budget_sources(s))
    table.rows.push_back({source.letter, source.what, source.runs, source.runs.empty() ? "" : "samples.db",
                          source.runs.empty() ? "" : rung, std::to_string(s.plan.seed), s.study.file,
                          s.study.content_hash.substr(0, 12), m.content_hash.substr(0, 12)});
  return table;
}

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
  return fmt::format("Against {} simulated levels the classical rule is unsafe in {} and wasteful in {}.",
                     b.levels.size(), count(RuleStanding::unsafe), count(RuleStanding::wasteful));
}

}  // namespace

std::vector<BudgetSource> budget_sources(const BudgetStudy& s) {
  const BudgetRuns& r = s.runs;
  const std::string to = " to ";
  const std::uint64_t slots = 1 + r.groups() + r.joints();
  const std::string every = slots > 1 && r.rows() > 1 ? fmt::format(", one in {}", slots) : "";
  std::vector<BudgetSource> sources = {
      {kFromMembers,
       fmt::format("the {} members: the mechanism as drawn, with each member's external errors", s.plan.members),
       std::to_string(r.drawn(0)) + to + std::to_string(r.drawn(r.rows() - 1)) + every},
      {kFromNominal, "the mechanism with every scattered parameter at its median; of several clearances each alone",
       r.drawn(0) == 1 ? "0" : "0" + to + std::to_string(r.drawn(0) - 1)},
      {kFromAttribution,
       fmt::format("the first {} members in all variants: groups held, clearances halved", r.attribution()),
       std::to_string(r.drawn(0)) + to + std::to_string(r.drawn(r.attribution()) - 1)},
      {kFromClasses,
       "formulas of ECSS-E-ST-60-10C from the study's contributors, and the clearances' and groups' moments", ""}};
  if (!s.plan.posterior.empty())
    sources.push_back({kFromCalibration, "what scatters: " + posterior_origin(s.plan), ""});
  return sources;
}

std::string posterior_origin(const BudgetPlan& plan) {
  const std::string file = plan.posterior + " (" + plan.posterior_hash.substr(0, 12) + ")";
  std::ifstream stream(std::filesystem::path(plan.posterior).parent_path() / "summary.json");
  const nlohmann::json made_by = nlohmann::json::parse(stream, nullptr, false);
  if (!made_by.is_object() || made_by.value("verb", nlohmann::json()) != "calibrate" || !made_by.contains("data"))
    return file + "; no calibrate's summary.json is beside it, so which data made it is not known";
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

std::string budget_value(const BudgetStudy& s, double value) {
  return s.study.index.si_unit() == "rad" ? readable_arcsec(value) : readable(value, s.study.index.si_unit());
}

std::string requirement_sentence(const BudgetStudy& s, const RequirementAnswer& r) {
  std::string text =
      fmt::format("{}: {}, limit {}: {}",
                  level_title(s.axes(), r.asked.index, r.asked.axis, r.asked.interpretation, r.asked.probability),
                  budget_value(s, r.level.level.value), budget_value(s, r.asked.limit),
                  r.compliance.met ? "met" : "not shown to be met");
  if (r.compliance.met)
    return text + fmt::format(" with {} confidence, margin {}", percent(r.asked.confidence),
                              readable_share(r.margin() / r.asked.limit));
  if (r.margin() < 0.0) return text + fmt::format(", {} above the limit", readable_share(-r.margin() / r.asked.limit));
  return text +
         fmt::format(
             ": the members do not contradict it, and show {:.4g} % with {} confidence; more of them may show it",
             100.0 * r.compliance.shown, percent(r.asked.confidence));
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
  if (!b.reliefs.empty() && b.reliefs.front().gain() > 0.0)
    text += fmt::format(" Tighten first: {}; {} takes {} off the {} {}.", b.reliefs.front().name,
                        b.reliefs.front().action, budget_value(s, b.reliefs.front().gain()),
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
      "Data", "summary.json, levels.csv, classical.csv, contributions.csv; samples.db holds every run"};
  document.provenance.push_back({"Study", s.study.file});
  document.provenance.push_back({"Study hash", s.study.content_hash});
  document.provenance.push_back({"Seed", std::to_string(s.plan.seed)});
  if (!s.budget) {
    document.verdict =
        report::Verdict{report::Standing::bad, "Interrupted before all runs were there. --resume goes on from here."};
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
  if (!b.requirements.empty()) {
    document.facts.push_back({.label = "Limit", .value = budget_value(s, b.headline.limit)});
    document.facts.push_back({.label = "Margin",
                              .value = readable_share(b.requirements.front().margin() / b.headline.limit),
                              .note = "of the limit"});
  }
  document.facts.push_back({.label = "Classical rule",
                            .value = budget_value(s, headline.by_rule),
                            .note = standing_text(headline.standing, headline.by_rule, headline.level.value)});
  document.facts.push_back({.label = "Members", .value = b.members, .note = fmt::format("{} failed", b.failed)});

  report::Section answers{.id = "answer", .title = "The budget", .intro = index_titles(s.plan), .items = {}};
  if (!b.requirements.empty()) answers.items.emplace_back(requirement_table(s, b));
  answers.items.emplace_back(level_chart(s, b));
  document.sections.push_back(std::move(answers));
  if (!b.contributions.empty())
    document.sections.push_back({.id = "contributions",
                                 .title = "Who contributes, and what to tighten first",
                                 .intro = "Shares and gains are of the first requirement: " +
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
  document.sections.push_back({.id = "histories",
                               .title = "The histories behind it",
                               .items = {distribution_chart(s, b), history_panels(s, b)}});
  document.sections.push_back(
      {.id = "model",
       .title = "What this model leaves out",
       .items = {report::Text{
           s.leaves_out +
           fmt::format("\n\nBy its own estimate the rung is off by {} for what it leaves out and by {} for its steps, "
                       "means over the runs; the intervals above are of sampling alone.",
                       readable_share(s.model_error), readable_share(s.discretisation_error))}}});
  document.sections.push_back({.id = "sources", .title = "Where each number comes from", .items = {source_table(s)}});
  if (s.rung.pilot) document.sections.push_back(pilot_section(*s.rung.pilot));
  return document;
}

}  // namespace boresight::app
