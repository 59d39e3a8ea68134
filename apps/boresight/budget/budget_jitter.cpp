// Jitter by exposure time: the curve of RPE over its window, and the limits that stand on it.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "budget/budget_parts.hpp"
#include "report_parts/report_parts.hpp"
#include "results/scatter_parts.hpp"

namespace boresight::app {
namespace {

bool is_of(const JitterCurve& curve, const BudgetRequirement& r) {
  return r.exposure > 0.0 && r.axis == curve.asked.axis && r.interpretation == curve.asked.interpretation &&
         r.probability == curve.asked.probability;
}

report::Chart jitter_chart(const BudgetStudy& s, const Budget& b, const JitterCurve& curve) {
  double largest = 0.0;
  for (const ReportedInterval& level : curve.level) largest = std::max(largest, level.value);
  const DisplayUnit unit = budget_unit(s, largest);
  report::Chart chart{.title = fmt::format("Jitter by exposure time: RPE {}, {}, {}", s.axes().name(curve.asked.axis),
                                           to_string(curve.asked.interpretation), percent(curve.asked.probability)),
                      .caption = fmt::format(
                          "RPE over windows of this length. Whiskers: {} interval of the simulated level; one that has "
                          "no upper bound is drawn "
                          "without its upper half. The curve is of the first {} members, the answers above are of all.",
                          percent(s.plan.confidence), std::min<std::int64_t>(kMembersOfCurve, b.members)),
                      .x = {"exposure", "s", true},
                      .y = {"level", unit.name, true}};
  report::Numbers y;
  report::Series simulated{.name = "simulated", .x = curve.exposure, .style = report::Style::line_markers, .color = 1};
  for (const ReportedInterval& level : curve.level) {
    y.push_back(level.value > 0.0 ? level.value * unit.per_si : std::nan(""));
    simulated.error_low.push_back(std::max(0.0, level.value - level.low) * unit.per_si);
    simulated.error_high.push_back(std::isfinite(level.high) ? std::max(0.0, level.high - level.value) * unit.per_si
                                                             : 0.0);
  }
  simulated.y = y;
  chart.series.push_back(std::move(simulated));
  std::vector<std::pair<double, double>> limits;
  for (const RequirementAnswer& r : b.requirements)
    if (is_of(curve, r.asked)) limits.emplace_back(r.asked.exposure, r.asked.limit * unit.per_si);
  std::sort(limits.begin(), limits.end());
  report::Numbers exposure, limit;
  for (const auto& [x, value] : limits) {
    exposure.push_back(x);
    limit.push_back(value);
  }
  chart.series.push_back(
      {.name = "limits", .x = exposure, .y = limit, .style = report::Style::dash_markers, .color = 2});
  return chart;
}

}  // namespace

report::Section jitter_section(const BudgetStudy& s, const Budget& b) {
  report::Section section{.id = "jitter", .title = "Jitter by exposure time", .items = {}};
  for (const JitterCurve& curve : b.jitter) section.items.emplace_back(jitter_chart(s, b, curve));
  return section;
}

Json jitter_json(const BudgetStudy& s, const Budget& b) {
  Json json = Json::array();
  for (const JitterCurve& curve : b.jitter)
    for (std::size_t k = 0; k < curve.exposure.size(); ++k)
      json.push_back({{"axis", s.axes().name(curve.asked.axis)},
                      {"interpretation", to_string(curve.asked.interpretation)},
                      {"probability", curve.asked.probability},
                      {"exposure", curve.exposure[k]},
                      {"value", curve.level[k].value},
                      {"low", curve.level[k].low},
                      {"high", number_json(curve.level[k].high)}});
  return json;
}

}  // namespace boresight::app
