#include "sensitivity/sensitivity_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "report_parts/report_parts.hpp"
#include "results/pilot_parts.hpp"
#include "terminal/readable.hpp"

namespace boresight::app {
namespace {

report::Chart tornado(const SensitivityStudy& s, const DisplayUnit& unit) {
  std::vector<std::size_t> order(s.local.parameters.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto swing = [&](std::size_t i) {
    const LocalSensitivity& p = s.local.parameters[i];
    const double width = std::max(std::abs(p.at_low - s.local.at_medians), std::abs(p.at_high - s.local.at_medians));
    return std::isfinite(width) ? width : 0.0;
  };
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return swing(a) > swing(b); });
  report::Chart chart{
      .title = "Tornado",
      .caption =
          "One parameter at its 5 % and at its 95 % quantile, all others at their medians: how far the index "
          "moves. Each bar is one motion.",
      .x = {"change of the index", unit.name},
      .y = {"parameter", ""},
      .height = report::height_of_bars(order.size(), 80)};
  report::Names names;
  report::Numbers low, high;
  for (const std::size_t i : order) {
    const LocalSensitivity& p = s.local.parameters[i];
    names.push_back(p.name);
    low.push_back((p.at_low - s.local.at_medians) * unit.per_si);
    high.push_back((p.at_high - s.local.at_medians) * unit.per_si);
  }
  chart.series = {{.name = "at the 5 % quantile", .x = low, .y = names, .style = report::Style::bars},
                  {.name = "at the 95 % quantile", .x = high, .y = names, .style = report::Style::bars}};
  chart.lines = {{'x', 0.0, "all at their medians"}};
  return chart;
}

// "m per kg", "m": a derivative's unit.
std::string per(const std::string& index_unit, const std::string& unit) {
  return unit == "1" || unit.empty() ? index_unit : index_unit + " per " + unit;
}

report::Section local_section(const SensitivityStudy& s) {
  const std::string& unit = s.study.index.si_unit();
  double most = 0.0;
  for (const LocalSensitivity& p : s.local.parameters)
    for (const double v : {p.at_low, p.at_high})
      if (std::isfinite(v)) most = std::max(most, std::abs(v - s.local.at_medians));
  report::Section section{
      .id = "local",
      .title = "Around the middle",
      .intro = fmt::format("With every parameter at its median the index is {}.", readable(s.local.at_medians, unit))};
  section.items.push_back(tornado(s, display_unit(unit, most)));
  report::Table table{.title = "Slopes at the medians",
                      .caption = fmt::format(
                          "Central differences with steps of 1/2, 1/4 and 1/8 of the standard deviation. Impacts make "
                          "the maximum of a motion rough: where the three differ by more than {:g} % of the largest no "
                          "slope is given, as there is none.",
                          100.0 * kSettledSlope),
                      .columns = {{"parameter"},
                                  {"median"},
                                  {"index at 5 %"},
                                  {"index at 95 %"},
                                  {"slope"},
                                  {"times sd"},
                                  {"means something"},
                                  {"exact slope of this motion"}}};
  for (const LocalSensitivity& p : s.local.parameters) {
    const double slope = p.derivative.back();
    table.rows.push_back(
        {p.name, readable_as(p.median, p.si_unit, p.unit), readable(p.at_low, unit), readable(p.at_high, unit),
         p.meaningful ? nlohmann::json(fmt::format("{:.4g} {}", slope, per(unit, p.told_unit)))
                      : nlohmann::json("none"),
         p.meaningful ? nlohmann::json(readable(slope * p.sd, unit)) : nlohmann::json(""),
         p.meaningful ? "yes" : "no: " + p.why_not,
         std::isfinite(p.exact)
             ? fmt::format("{:.4g} {}{}", p.exact, per(unit, p.told_unit), p.exact_agrees ? "" : " (does not agree)")
         : p.exact_note.empty() ? "perturbation rung only"
                                : p.exact_note});
  }
  section.items.push_back(std::move(table));
  return section;
}

report::Section scatter_section(const SensitivityStudy& s) {
  double most = 0.0;
  for (const SampleRecord& r : s.shown) most = std::max(most, std::abs(r.outcome.value));
  const DisplayUnit unit = display_unit(s.study.index.si_unit(), most);
  report::Panels panels{.title = "The index against each parameter",
                        .caption = fmt::format("{} of the samples, all parameters scattering.", s.shown.size()),
                        .columns = 3,
                        .shared_legend = false};
  for (std::size_t i = 0; i < s.plan.inputs.size(); ++i) {
    const RandomParameter& p = s.plan.inputs.parameters[i];
    double largest = 0.0;
    for (const SampleRecord& r : s.shown) largest = std::max(largest, std::abs(r.inputs[i]));
    const DisplayUnit x_unit = display_unit_as(p.si_unit, largest, p.unit);
    report::Numbers x, y;
    for (const SampleRecord& r : s.shown) {
      x.push_back(r.inputs[i] * x_unit.per_si);
      y.push_back(r.outcome.value * unit.per_si);
    }
    report::Chart chart{.title = p.name(), .x = {p.name(), x_unit.name}, .y = {"index", unit.name}};
    chart.series.push_back({.name = "samples", .x = x, .y = y, .style = report::Style::markers});
    panels.panels.push_back(std::move(chart));
  }
  return {.id = "scatter", .title = "What the numbers are made of", .items = {std::move(panels)}};
}

}  // namespace

report::Document sensitivity_report(const SensitivityStudy& s) {
  report::Document document{.title = s.mechanism.name(),
                            .subtitle = "Which parameter's scatter matters for the " + s.study.index.title(),
                            .verb = "sensitivity"};
  if (s.interrupted)
    document.verdict = report::Verdict{report::Standing::bad, "Interrupted: the same command goes on."};
  else if (s.result != nullptr)
    document.verdict = report::Verdict{report::Standing::neutral, s.result->sentence()};
  else
    document.verdict = report::Verdict{report::Standing::bad, "Too many runs failed to tell what matters."};
  if (s.result != nullptr) {
    document.facts = s.result->facts();
    document.facts.push_back({"runs", static_cast<double>(s.plan.runs()), "",
                              fmt::format("{} rows of {}", s.plan.rows, s.plan.runs_per_row())});
    document.sections.push_back(s.result->section());
  }
  if (!s.local.interrupted && std::isfinite(s.local.at_medians)) document.sections.push_back(local_section(s));
  if (!s.shown.empty()) document.sections.push_back(scatter_section(s));
  document.warnings = s.warnings;
  document.sections.push_back(
      {.id = "model", .title = "What this model leaves out", .items = {report::Text{s.leaves_out}}});
  if (s.rung.pilot) document.sections.push_back(pilot_section(*s.rung.pilot));
  document.provenance = provenance_of(s.command, s.mechanism, s.rung);
  document.provenance.push_back({"Study hash", s.study.content_hash});
  document.provenance.push_back({"Seed", static_cast<double>(s.plan.design.seed)});
  document.provenance.push_back({"Design", s.plan.design.text()});
  document.provenance.push_back({"Method", to_string(s.plan.method)});
  return document;
}

}  // namespace boresight::app
