#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "budget/budget_parts.hpp"
#include "report_parts/report_parts.hpp"

namespace boresight::app {
namespace {

// Where each bar of the waterfall begins and ends, in shares of the level.
struct WaterfallStep {
  std::string name;
  double from, to;
  int color;
};

int color_of(const std::string& kind) {
  if (kind == kClearanceKind) return 1;
  if (is_of_group(kind)) return 3;
  if (is_by_influence(kind)) return 4;
  return kind == "joints and scatter" ? 8 : 5;
}

}  // namespace

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
  const DisplayUnit unit = budget_unit(s, largest);
  report::Chart chart{
      .title = fmt::format("Simulated levels and the classical rule, {}, {}", to_string(b.headline.interpretation),
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
    if (r.asked.index == b.headline.index && r.asked.axis == b.headline.axis && r.asked.exposure == 0.0)
      chart.lines.push_back(
          {'y', r.asked.limit * unit.per_si,
           "limit of " + level_title(axes, r.asked.index, r.asked.axis, r.asked.interpretation, r.asked.probability)});
  return chart;
}

report::Chart waterfall_chart(const BudgetStudy& s, const Budget& b) {
  const double level = headline_level(b).level.value;
  const DisplayUnit unit = budget_unit(s, level);
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
           {1, "clearances"}, {3, "scatter"}, {4, "standing errors"}, {8, "together"}, {5, "external"}, {7, "level"}}) {
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
  if (headline_answer(b) != nullptr) {
    chart.lines.push_back(
        {'x', b.headline.limit * unit.per_si, "limit " + budget_limit(s, b.headline.limit, b.headline.unit)});
    farthest = std::max(farthest, b.headline.limit / level);
  }
  constexpr double kRoomForText = 0.15;
  chart.x.range = {(nearest < 0.0 ? nearest - kRoomForText : 0.0) * level * unit.per_si,
                   (farthest + kRoomForText) * level * unit.per_si};
  return chart;
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
  const DisplayUnit unit = budget_unit(s, pooled.back());
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
  if (headline_answer(b) != nullptr)
    chart.lines.push_back(
        {'x', b.headline.limit * unit.per_si, "limit " + budget_limit(s, b.headline.limit, b.headline.unit)});
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
    const DisplayUnit unit = budget_unit(s, largest);
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

}  // namespace boresight::app
