#include "chart/chart_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "report_parts/report_parts.hpp"
#include "results/scatter_parts.hpp"
#include "terminal/readable.hpp"

namespace boresight::app {
namespace {

constexpr int kPapersColor = 6, kFailedColor = 5, kFrontColor = 8;

// A logarithmic axis has no zero: below this share an index agrees to all digits that mean anything.
double drawn(double error) { return std::max(error, 1e-9); }

std::vector<std::string> families_of(const std::vector<ChartPoint>& points) {
  std::vector<std::string> names;
  for (const ChartPoint& p : points)
    if (!p.papers && std::find(names.begin(), names.end(), p.family) == names.end()) names.push_back(p.family);
  return names;
}

report::Chart index_chart(const ChartResult& result, std::optional<double> accuracy) {
  report::Chart chart{
      .title = "Error of the index against CPU time",
      .caption =
          "Down and left is better; each mark is one way at one step or tolerance, finer to the right. The "
          "error is that of the median over neighbouring steps, with half their spread. Below the "
          "reference's own uncertainty nothing can be told apart.",
      .x = {"CPU of one run", "ms", true},
      .y = {"error of the index", "%", true},
      .height = 560};
  double worst = 1e-3;
  for (const std::string& name : families_of(result.points)) {
    report::Series series{.name = name, .style = report::Style::line_markers};
    report::Numbers x, y;
    for (const ChartPoint& p : result.points) {
      if (p.family != name || p.papers || !p.measured.refusal.empty()) continue;
      x.push_back(1e3 * p.measured.cpu_seconds);
      y.push_back(100.0 * drawn(p.error));
      worst = std::max(worst, p.error);
      series.text.push_back(fineness(p.setup));
    }
    if (x.empty()) continue;
    series.x = std::move(x);
    series.y = std::move(y);
    chart.series.push_back(std::move(series));
  }
  report::Series front{.name = "Pareto front", .style = report::Style::dash, .color = kFrontColor};
  report::Numbers fx, fy;
  for (std::size_t k : result.front) {
    fx.push_back(1e3 * result.points[k].measured.cpu_seconds);
    fy.push_back(100.0 * drawn(result.points[k].error));
  }
  front.x = fx;
  front.y = fy;
  if (!fx.empty()) chart.series.push_back(std::move(front));
  if (const ChartPoint* papers = result.papers()) {
    chart.lines.push_back({'x', 1e3 * papers->measured.cpu_seconds, "the setting of Sun, Song and Wang"});
    chart.series.push_back({.name = "the setting of Sun, Song and Wang",
                            .x = report::Numbers{1e3 * papers->measured.cpu_seconds},
                            .y = report::Numbers{100.0 * drawn(papers->error)},
                            .style = report::Style::markers,
                            .text = {papers->family + ", " + fineness(papers->setup)},
                            .color = kPapersColor});
  }
  report::Series failed{.name = "failed", .style = report::Style::markers, .color = kFailedColor};
  report::Numbers bx, by;
  for (const ChartPoint& p : result.points) {
    if (p.measured.refusal.empty()) continue;
    bx.push_back(1e3 * std::max(p.measured.spent_seconds, 1e-4));
    by.push_back(100.0 * 3.0 * worst);  // above all that did not fail
    failed.text.push_back(p.family + ", " + fineness(p.setup) + ": " + p.measured.refusal);
  }
  failed.x = bx;
  failed.y = by;
  if (!bx.empty()) chart.series.push_back(std::move(failed));
  chart.lines.push_back({'y', 100.0 * drawn(result.reference.uncertainty), "the reference's own uncertainty"});
  if (accuracy) chart.lines.push_back({'y', 100.0 * *accuracy, "asked for"});
  return chart;
}

report::Table front_table(const ChartResult& result) {
  report::Table table{
      .title = "The Pareto front",
      .caption = "Fastest first; each is more accurate than all that are faster.",
      .columns = {{"Way"}, {"Fineness"}, {"Error", "%"}, {"CPU", "ms"}, {"Faster than Sun, Song, Wang"}}};
  const ChartPoint* papers = result.papers();
  for (std::size_t k : result.front) {
    const ChartPoint& p = result.points[k];
    table.rows.push_back(
        {p.family, fineness(p.setup), error_cell(p.error), 1e3 * p.measured.cpu_seconds,
         papers ? nlohmann::json(fmt::format("{:.3g} times", papers->measured.cpu_seconds / p.measured.cpu_seconds))
                : nlohmann::json()});
  }
  return table;
}

report::Table all_table(const ChartResult& result) {
  report::Table table{.title = "Every way",
                      .caption = "A way's own estimate is what it says of its error before anything has checked it.",
                      .columns = {{"Way"},
                                  {"Fineness"},
                                  {"Index", result.unit},
                                  {"Error", "%"},
                                  {"Half spread", "%"},
                                  {"Own estimate", "%"},
                                  {"CPU", "ms"},
                                  {"Outcome"}}};
  for (const ChartPoint& p : result.points) {
    const std::string name = p.papers ? "Sun, Song, Wang: " + p.family : p.family;
    if (!p.measured.refusal.empty()) {
      table.rows.push_back(
          {name, fineness(p.setup), nullptr, nullptr, nullptr, nullptr, nullptr, "failed: " + p.measured.refusal});
      continue;
    }
    const double scale = std::abs(p.measured.value) > 0.0 ? 1.0 / std::abs(p.measured.value) : 0.0;
    table.rows.push_back({name, fineness(p.setup), p.measured.value, error_cell(p.error),
                          error_cell(scale * p.measured.half_spread), error_cell(p.measured.estimate),
                          1e3 * p.measured.cpu_seconds, "done"});
  }
  return table;
}

report::Section reference_section(const Reference& reference, const std::string& unit) {
  report::Section section{
      .id = "reference",
      .title = "The reference",
      .intro = fmt::format("Multibody in joint coordinates, RK4, refined until its uncertainty was known: {}. Where "
                           "impacts scatter the index, finer steps bring it no lower.",
                           readable_error(reference.uncertainty))};
  report::Table table{.title = "Refinements",
                      .caption = "Medians over neighbouring steps.",
                      .columns = {{"Step", "µs"}, {"Index", unit}, {"Half spread", unit}}};
  for (const Refinement& r : reference.refinements) table.rows.push_back({1e6 * r.step, r.value, r.half_spread});
  section.items.push_back(std::move(table));
  return section;
}

report::Section flight_section(const FreeFlight& flight) {
  report::Section section{
      .id = "flight",
      .title = "Trajectory error before the first impact",
      .intro = fmt::format("The motion up to {} of the {} before the first contact, where nothing scatters and each "
                           "method shows its own order. The error is where the boresight body ends, over the "
                           "clearance.",
                           readable(flight.end, "s"), readable(flight.first_contact, "s"))};
  if (!flight.why_not.empty()) {
    section.intro = "Nothing to compare: " + flight.why_not + ".";
    section.items.push_back(report::Text{"The chart of the index stands alone."});
    return section;
  }
  report::Chart chart{.title = "Trajectory error against CPU time",
                      .caption =
                          "Both charts are different questions: a trajectory can be right to many digits "
                          "where the index over "
                          "the run is at the mercy of impacts.",
                      .x = {"CPU of one run", "ms", true},
                      .y = {"error over clearance", "", true},
                      .height = 480};
  std::vector<std::string> names;
  for (const FlightPoint& p : flight.points)
    if (std::find(names.begin(), names.end(), p.family) == names.end()) names.push_back(p.family);
  report::Table refused{.title = "Failed", .caption = {}, .columns = {{"Way"}, {"Fineness"}, {"Why"}}};
  for (const std::string& name : names) {
    report::Series series{.name = name, .style = report::Style::line_markers};
    report::Numbers x, y;
    for (const FlightPoint& p : flight.points) {
      if (p.family != name) continue;
      if (!p.refusal.empty()) {
        refused.rows.push_back({p.family, fineness(p.setup), p.refusal});
        continue;
      }
      x.push_back(1e3 * p.cpu_seconds);
      y.push_back(std::max(p.error, 1e-17));
      series.text.push_back(fineness(p.setup));
    }
    if (x.empty()) continue;
    series.x = std::move(x);
    series.y = std::move(y);
    chart.series.push_back(std::move(series));
  }
  if (flight.rounding > 0.0) chart.lines.push_back({'y', flight.rounding, "two finest references apart"});
  if (!chart.series.empty()) section.items.push_back(std::move(chart));
  if (!refused.rows.empty()) section.items.push_back(std::move(refused));
  return section;
}

}  // namespace

std::string machine_line(const Machine& m) {
  return fmt::format("{}, {} cores, {}, {}, load {:.2g} while measuring", m.processor, m.cores, m.compiler, m.build,
                     m.load);
}

std::string left_out_sentence(const ChartResult& result, const std::string& family) {
  const bool begun =
      std::any_of(result.points.begin(), result.points.end(), [&](const ChartPoint& p) { return p.family == family; });
  return (begun ? "no time was left for other steps of " : "no time was left for ") + family;
}

std::string off_text(const ChartResult& result, const ChartPoint& point) {
  const double known = result.reference.uncertainty;
  return point.error < known ? "at most " + readable_error(point.error + known) : readable_error(point.error);
}

report::Document chart_report(const Command& command, const Mechanism& mechanism, const ChartResult& result,
                              std::optional<double> accuracy) {
  report::Document document{
      .title = mechanism.name(), .subtitle = "Accuracy against speed: " + result.index, .verb = "chart"};
  const ChartPoint* papers = result.papers();
  const double wanted = accuracy.value_or(0.01);
  const ChartPoint* best = result.cheapest_within(wanted);
  if (result.interrupted)
    document.verdict = report::Verdict{report::Standing::bad, "Interrupted: only what was reached is shown."};
  else if (best)
    document.verdict =
        report::Verdict{report::Standing::good,
                        fmt::format("Cheapest within {}: {}, {}: {} of CPU{}.", readable_share(wanted), best->family,
                                    fineness(best->setup), readable(best->measured.cpu_seconds, "s"),
                                    papers ? fmt::format(", {:.3g} times faster than the setting of Sun, Song and Wang",
                                                         papers->measured.cpu_seconds / best->measured.cpu_seconds)
                                           : std::string())};
  else
    document.verdict =
        report::Verdict{report::Standing::bad,
                        result.reference.uncertainty > wanted
                            ? fmt::format("The reference is known to {} only: what comes within {} cannot be told.",
                                          readable_error(result.reference.uncertainty), readable_share(wanted))
                            : fmt::format("No way is sure to come within {}.", readable_share(wanted))};
  for (const std::string& name : result.flight.left_out)
    document.warnings.push_back("no time was left for the flight before the first impact of " + name);
  if (result.reference.refinements.empty())
    document.facts.push_back({.label = "Reference", .value = "none yet"});
  else
    document.facts.push_back({.label = "Reference",
                              .value = readable(result.reference.value, result.unit),
                              .note = "known to " + readable_error(result.reference.uncertainty)});
  if (papers)
    document.facts.push_back({.label = "The setting of Sun, Song and Wang",
                              .value = readable(papers->measured.cpu_seconds, "s"),
                              .note = "off by " + off_text(result, *papers)});
  const auto failed = std::count_if(result.points.begin(), result.points.end(),
                                    [](const ChartPoint& p) { return !p.measured.refusal.empty(); });
  document.facts.push_back(
      {.label = "Ways tried", .value = result.points.size(), .note = fmt::format("{} failed", failed)});
  for (const std::string& name : result.left_out) document.warnings.push_back(left_out_sentence(result, name));
  report::Section index{.id = "index", .title = "Error of the index over the run"};
  if (!result.points.empty()) {
    index.items = {index_chart(result, accuracy), front_table(result), all_table(result)};
    document.sections.push_back(std::move(index));
  }
  if (result.flight.first_contact > 0.0 || !result.flight.why_not.empty())
    document.sections.push_back(flight_section(result.flight));
  if (!result.reference.refinements.empty())
    document.sections.push_back(reference_section(result.reference, result.unit));
  document.provenance = provenance_of(command, mechanism, {"all", "the chart compares them"});
  document.provenance.push_back({"Machine", machine_line(result.machine)});
  return document;
}

}  // namespace boresight::app
