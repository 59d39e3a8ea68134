#include "montecarlo/montecarlo_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <iterator>
#include <regex>

#include "boresight/keys/letters.hpp"
#include "report_parts/report_parts.hpp"
#include "results/pilot_parts.hpp"
#include "results/scatter_parts.hpp"
#include "terminal/readable.hpp"

namespace boresight::app {
namespace {

// Finite values, ascending.
std::vector<double> sorted_values(const MonteCarloStudy& s) {
  std::vector<double> values;
  for (const double value : s.result.values)
    if (std::isfinite(value)) values.push_back(value);
  std::sort(values.begin(), values.end());
  return values;
}

DisplayUnit unit_for(const MonteCarloStudy& s, const std::vector<double>& sorted) {
  return display_unit_as(s.study.index.si_unit(), sorted.empty() ? 0.0 : sorted.back(), written_unit(s.plan));
}

// Whether a line for the limit leaves the samples room: far from all of them it would press them into a corner of the chart.
bool is_near(double limit, double lowest, double highest) {
  const double room = 1.5 * (highest - lowest);
  return limit >= lowest - room && limit <= highest + room;
}
bool limit_is_drawn(const MonteCarloStudy& s, const std::vector<double>& sorted) {
  return s.plan.requirement && is_near(s.plan.requirement->limit, sorted.front(), sorted.back());
}
// For the caption, where no line says it.
std::string far_limit(const MonteCarloStudy& s, const std::vector<double>& sorted) {
  if (!s.plan.requirement || limit_is_drawn(s, sorted)) return "";
  const double limit = s.plan.requirement->limit;
  return fmt::format(" The required limit, {}, lies far {} all samples and is not drawn.",
                     readable_limit(limit, s.study.index.si_unit(), s.plan.requirement->unit),
                     limit > sorted.back() ? "above" : "below");
}

std::vector<report::Line> level_lines(const MonteCarloStudy& s, const std::vector<double>& sorted,
                                      const DisplayUnit& unit) {
  std::vector<report::Line> lines;
  if (limit_is_drawn(s, sorted)) lines.push_back({'x', s.plan.requirement->limit * unit.per_si, "required"});
  for (const char* name : {"p50", "p95", "p99.73"}) {
    const double value = s.estimates.of(name).interval.value;
    if (std::isfinite(value)) lines.push_back({'x', value * unit.per_si, name});
  }
  return lines;
}

// Bins by Freedman and Diaconis (1981).
report::Chart histogram(const MonteCarloStudy& s, const std::vector<double>& sorted, const DisplayUnit& unit) {
  report::Chart chart{.title = "How the index is distributed",
                      .caption = "Each bar is the share of samples in its bin." + far_limit(s, sorted),
                      .x = {s.study.index.title(), unit.name},
                      .y = {"share of samples", "%"}};
  const std::size_t n = sorted.size();
  const double spread = sorted[(3 * n) / 4] - sorted[n / 4], range = sorted.back() - sorted.front();
  const double wanted = spread > 0.0 ? range / (2.0 * spread / std::cbrt(static_cast<double>(n))) : 1.0;
  const auto bins = static_cast<std::size_t>(std::clamp(std::ceil(wanted), 5.0, 80.0));
  const double width =
      range > 0.0 ? range / static_cast<double>(bins) : std::max(std::abs(sorted.front()), 1e-12) * 1e-3;
  report::Numbers x(bins), y(bins, 0.0);
  for (std::size_t b = 0; b < bins; ++b) x[b] = (sorted.front() + (static_cast<double>(b) + 0.5) * width) * unit.per_si;
  for (const double value : sorted)
    y[std::min(bins - 1, static_cast<std::size_t>((value - sorted.front()) / width))] += 100.0 / static_cast<double>(n);
  chart.series.push_back({.name = "samples", .x = x, .y = y, .style = report::Style::bars});
  chart.lines = level_lines(s, sorted, unit);
  return chart;
}

report::Chart distribution_function(const MonteCarloStudy& s, const std::vector<double>& sorted,
                                    const DisplayUnit& unit) {
  report::Chart chart{
      .title = "Share of samples below",
      .caption = "Level bars are the intervals of the quantiles. Failed samples count as above everything.",
      .x = {s.study.index.title(), unit.name},
      .y = {"share below", "%"}};
  const double all = static_cast<double>(s.result.values.size());
  report::Numbers x, y;
  const std::size_t every = std::max<std::size_t>(1, sorted.size() / 1500);
  for (std::size_t i = 0; i < sorted.size(); ++i) {
    const bool tail = i + 200 >= sorted.size();
    if (i % every != 0 && !tail) continue;
    x.push_back(sorted[i] * unit.per_si);
    y.push_back(100.0 * static_cast<double>(i + 1) / all);
  }
  chart.series.push_back({.name = "samples", .x = x, .y = y, .style = report::Style::steps});
  report::Series bars{.name = "intervals", .style = report::Style::line_markers};
  report::Numbers bx, by;
  for (const Headline& h : headlines()) {
    const ReportedInterval& i = s.estimates.of(h.name).interval;
    if (h.probability == 0.0 || !std::isfinite(i.value)) continue;
    const double low = std::isfinite(i.low) ? i.low : sorted.front(),
                 high = std::isfinite(i.high) ? i.high : sorted.back();
    for (const double value : {low, i.value, high, std::nan("")}) {
      bx.push_back(value * unit.per_si);
      by.push_back(100.0 * h.probability);
      bars.text.push_back(std::string(h.name) + ": " +
                          readable_interval(i, s.study.index.si_unit(), written_unit(s.plan)));
    }
  }
  bars.x = bx;
  bars.y = by;
  chart.series.push_back(std::move(bars));
  if (limit_is_drawn(s, sorted)) chart.lines.push_back({'x', s.plan.requirement->limit * unit.per_si, "required"});
  if (s.plan.requirement) chart.lines.push_back({'y', 100.0 * s.plan.requirement->probability, "required"});
  return chart;
}

report::Chart convergence(const MonteCarloStudy& s, const std::vector<double>& sorted, const DisplayUnit& unit) {
  report::Chart chart{.title = headline_title(s.estimates.headline) + ": how the estimate settled",
                      .caption = fmt::format("The estimate and its {} interval from the first samples alone.",
                                             readable_share(s.plan.confidence)),
                      .x = {"samples", "", true},
                      .y = {s.estimates.headline, unit.name}};
  report::Series band{.name = "interval", .style = report::Style::area};
  report::Series line{.name = "estimate", .style = report::Style::line_markers};
  report::Numbers x, low, high, lx, ly;
  for (const ConvergencePoint& p : s.estimates.convergence) {
    if (!std::isfinite(p.interval.value)) continue;
    lx.push_back(static_cast<double>(p.samples));
    ly.push_back(p.interval.value * unit.per_si);
    if (!std::isfinite(p.interval.low) || !std::isfinite(p.interval.high)) continue;
    x.push_back(static_cast<double>(p.samples));
    low.push_back(p.interval.low * unit.per_si);
    high.push_back(p.interval.high * unit.per_si);
  }
  if (!x.empty()) {
    band.x = x;
    band.y = high;
    band.y_low = low;
    chart.series.push_back(std::move(band));
  }
  line.x = lx;
  line.y = ly;
  chart.series.push_back(std::move(line));
  if (limit_is_drawn(s, sorted)) chart.lines = {{'y', s.plan.requirement->limit * unit.per_si, "required"}};
  return chart;
}

report::Table estimate_table(const MonteCarloStudy& s, const DisplayUnit& unit) {
  report::Table table{
      .title = "Estimates",
      .caption = fmt::format("Intervals at {} confidence; an empty end is not bounded by so few samples.",
                             readable_share(s.plan.confidence)),
      .columns = {{"Of the index"}, {"Value", unit.name}, {"Low", unit.name}, {"High", unit.name}, {"Basis"}}};
  const auto cell = [&](double v) { return std::isfinite(v) ? nlohmann::json(v * unit.per_si) : nlohmann::json(); };
  for (const NamedEstimate& e : s.estimates.index)
    table.rows.push_back({headline_title(e.name), cell(e.interval.value), cell(e.interval.low), cell(e.interval.high),
                          e.interval.basis});
  return table;
}

report::Table error_table(const MonteCarloStudy& s) {
  report::Table table{
      .title = "What each number is uncertain by",
      .caption = {},
      .columns = {{"Of the index"}, {"Sampling", "%"}, {"Discretisation", "%"}, {"Rung", "%"}, {"Dominates"}}};
  for (const ErrorStatement& e : s.estimates.errors)
    table.rows.push_back({headline_title(e.of), error_cell(e.sampling.relative), error_cell(e.discretisation.relative),
                          error_cell(e.rung.relative), e.dominant});
  if (!s.estimates.errors.empty())
    table.caption = "Sampling: the wider side of the interval; empty: not bounded. Discretisation: " +
                    s.estimates.errors.front().discretisation.why + ". Rung: " + s.estimates.errors.front().rung.why +
                    ".";
  return table;
}

report::Panels scatter(const MonteCarloStudy& s, const std::vector<double>& sorted, const DisplayUnit& unit) {
  const double top = sorted.back();
  report::Panels panels{
      .title = "The index against each parameter",
      .caption = s.shown.failed.empty()
                     ? fmt::format("{} samples, spread evenly over the study.", s.shown.done.size())
                     : fmt::format("{} samples, spread evenly over the study; failed ones are drawn at the "
                                   "top edge, where they lie along the parameter.",
                                   s.shown.done.size()),
      .columns = 2};
  for (std::size_t p = 0; p < s.plan.inputs.size(); ++p) {
    const RandomParameter& random = s.plan.inputs.parameters[p];
    double largest = 0.0;
    for (const SampleRecord& r : s.shown.done) largest = std::max(largest, std::abs(r.inputs[p]));
    const DisplayUnit x_unit = display_unit_as(random.si_unit, largest, random.unit);
    report::Chart chart{.title = random.name(), .x = {random.name(), x_unit.name}, .y = {"index", unit.name}};
    const auto add = [&](const std::string& name, const std::vector<SampleRecord>& records, bool failed) {
      report::Series series{.name = name, .style = report::Style::markers};
      report::Numbers x, y;
      for (const SampleRecord& r : records) {
        x.push_back(r.inputs[p] * x_unit.per_si);
        y.push_back((failed ? top : r.outcome.value) * unit.per_si);
        series.text.push_back("sample " + std::to_string(r.number) + (failed ? ": " + r.outcome.message : ""));
      }
      series.x = x;
      series.y = y;
      if (!records.empty()) chart.series.push_back(std::move(series));
    };
    add("samples", s.shown.done, false);
    add("failed", s.shown.failed, true);
    if (limit_is_drawn(s, sorted)) chart.lines = {{'y', s.plan.requirement->limit * unit.per_si, "required"}};
    panels.panels.push_back(std::move(chart));
  }
  return panels;
}

// The distribution with its numbers as people read them.
std::string short_text(const std::string& text) {
  static const std::regex number("-?[0-9]+\\.?[0-9]*(e[-+]?[0-9]+)?");
  if (text.starts_with("fit(")) return text;
  std::string out;
  auto at = text.cbegin();
  const auto is_of_a_word = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0; };
  for (std::sregex_iterator m(text.begin(), text.end(), number), end; m != end; ++m) {
    const auto first = text.cbegin() + m->position(), last = first + m->length();
    // Not within a word, as digits of a hash are.
    if ((first != text.cbegin() && is_of_a_word(*std::prev(first))) || (last != text.cend() && is_of_a_word(*last)))
      continue;
    out.append(at, first);
    out += fmt::format("{:.4g}", std::strtod(m->str().c_str(), nullptr));
    at = last;
  }
  out.append(at, text.cend());
  constexpr std::size_t kLong = 160;
  return shortened(out, kLong, kLong, " ...");
}

report::Table input_table(const MonteCarloStudy& s) {
  report::Table table{
      .title = "What scatters",
      .caption = "The design's coordinates become values by each distribution's quantile function.",
      .columns = {{"Parameter"}, {"Distribution"}, {"Mean"}, {"Standard deviation"}, {"0.1 % below"}, {"0.1 % above"}}};
  for (std::size_t i = 0; i < s.plan.inputs.size(); ++i) {
    const RandomParameter& p = s.plan.inputs.parameters[i];
    std::string paths;
    for (const std::string& path : p.paths) paths += (paths.empty() ? "" : " = ") + path;
    const auto text = [&](double v) { return readable_as(v, p.si_unit, p.unit); };
    table.rows.push_back({paths,
                          short_text(s.plan.inputs.text_of(i)) + (p.told_unit() == "1" ? "" : ", in " + p.si_unit),
                          text(p.distribution->mean()), text(p.distribution->sd()),
                          text(p.distribution->quantile(0.001)), text(p.distribution->upper_quantile(0.001))});
  }
  return table;
}

report::Table failed_table(const MonteCarloStudy& s) {
  report::Table table{.title = fmt::format("{} failed samples", s.estimates.failed),
                      .caption = s.shown.failed.size() < s.estimates.failed
                                     ? fmt::format("The first {}; all are in the store.", s.shown.failed.size())
                                     : "Kept in the store with their inputs; they count as bad in every bound.",
                      .columns = {{"Sample"}}};
  for (const RandomParameter& p : s.plan.inputs.parameters) table.columns.push_back({p.name()});
  table.columns.push_back({"Why"});
  for (const SampleRecord& r : s.shown.failed) {
    std::vector<nlohmann::json> row = {r.number};
    for (std::size_t p = 0; p < r.inputs.size(); ++p)
      row.push_back(readable_as(r.inputs[p], s.plan.inputs.parameters[p].si_unit, s.plan.inputs.parameters[p].unit));
    row.push_back(r.outcome.message);
    table.rows.push_back(std::move(row));
  }
  return table;
}

std::vector<report::Fact> facts_of(const MonteCarloStudy& s) {
  std::vector<report::Fact> facts = {
      {.label = "Samples", .value = s.estimates.samples, .note = to_string(s.result.ended)},
      {.label = "Failed", .value = s.estimates.failed}};
  for (const std::string& name : {std::string("p50"), std::string("p95"), std::string("p99.73")}) {
    const ReportedInterval& i = s.estimates.of(name).interval;
    if (std::isfinite(i.value))
      facts.push_back({.label = headline_title(name),
                       .value = readable_as(i.value, s.study.index.si_unit(), written_unit(s.plan)),
                       .note = readable_interval(i, s.study.index.si_unit(), written_unit(s.plan))});
  }
  if (s.estimates.requirement) {
    const ReportedInterval& p = s.estimates.requirement->probability;
    if (std::isfinite(p.value))
      facts.push_back({.label = "Share within the limit",
                       .value = readable_share(p.value),
                       .note = s.estimates.requirement->judgement.by == Judgement::By::nothing
                                   ? std::string()
                                   : fmt::format("at least {} with {} confidence", readable_share(p.low),
                                                 readable_share(s.plan.requirement->confidence))});
  }
  return facts;
}

}  // namespace

std::string headline_title(const std::string& name) {
  if (name == "mean") return "mean";
  if (name == "sd") return "standard deviation";
  return name.substr(1) + " % lie below";
}

std::string written_unit(const MonteCarloPlan& plan) { return plan.requirement ? plan.requirement->unit : ""; }

std::string readable_interval(const ReportedInterval& i, const std::string& si_unit, const std::string& written) {
  const auto text = [&](double value) {
    return std::isfinite(value) ? readable_as(value, si_unit, written) : std::string("no bound");
  };
  return text(i.low) + " to " + text(i.high);
}

std::string verdict_sentence(const MonteCarloStudy& s) {
  const Requirement& asked = *s.plan.requirement;
  const RequirementVerdict& found = *s.estimates.requirement;
  std::string text =
      fmt::format("Wanted: {} at or below {} in {} of all cases, with {} confidence: {}.", s.study.index.title(),
                  readable_limit(asked.limit, s.study.index.si_unit(), asked.unit),
                  fmt::format("{:g} %", 100.0 * asked.probability), fmt::format("{:g} %", 100.0 * asked.confidence),
                  found.met ? "met" : "not shown to be met");
  if (std::isfinite(found.probability.value) && found.judgement.by == Judgement::By::nothing)
    text += fmt::format(" The share is {}.", readable_near_all(found.probability.value));
  else if (std::isfinite(found.probability.value))
    text += fmt::format(" The share is {}, and at least {} with {} confidence.",
                        readable_near_all(found.probability.value), readable_near_all(found.probability.low),
                        found.judgement.confidence == asked.confidence
                            ? "this"
                            : fmt::format("{:.5g} %", 100.0 * found.judgement.confidence));
  if (!found.judgement.why.empty()) {
    std::string why = found.judgement.why;
    why.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(why.front())));
    text += " " + why + ".";
  }
  if (found.met_by_samples && !found.met)
    text += fmt::format(
        " The samples show it, the model does not: the {} rung and its steps may be off by {}, and if every sample "
        "were larger by what may be "
        "missed of it, the share would be {}. A more exact rung may show it.",
        s.rung.name, readable_error(found.model_error), readable_near_all(found.within_error->value));
  else if (!found.met && found.judgement.by != Judgement::By::nothing && found.probability.value >= asked.probability)
    text +=
        s.plan.design.kind == SamplingKind::random
            ? " The samples do not contradict it; more of them may show it."
            : " The samples do not contradict it. A study of more samples, with another seed and in a folder of its "
              "own, may show it.";
  return text;
}

report::Document montecarlo_report(const MonteCarloStudy& s) {
  report::Document document{
      .title = s.mechanism.name(),
      .subtitle = "Scatter of the " + s.study.index.title() + ", " + std::to_string(s.estimates.samples) + " samples",
      .verb = "montecarlo"};
  if (s.result.ended == Ended::interrupted)
    document.verdict =
        report::Verdict{report::Standing::bad, "Interrupted: the samples so far. The same command goes on from here."};
  else if (s.estimates.requirement)
    document.verdict = report::Verdict{s.estimates.requirement->met ? report::Standing::good : report::Standing::bad,
                                       verdict_sentence(s)};
  document.facts = facts_of(s);
  document.warnings = s.warnings;
  document.provenance = provenance_of(s.command, s.mechanism, s.rung);
  document.provenance.back() = {
      "Data", "summary.json beside this file; samples.db holds every sample (boresight export DIR: CSV)"};
  document.provenance.push_back({"Study hash", s.study.content_hash});
  document.provenance.push_back({"Design", s.plan.design.text()});
  document.provenance.push_back({"One sample again", s.replay + " NUMBER"});

  const std::vector<double> sorted = sorted_values(s);
  if (!sorted.empty()) {
    const DisplayUnit unit = unit_for(s, sorted);
    document.sections.push_back(
        {.id = "distribution",
         .title = "The index and its scatter",
         .intro = "The study's index is the " + s.study.index.title() + ".",
         .items = {histogram(s, sorted, unit), distribution_function(s, sorted, unit), estimate_table(s, unit)}});
    document.sections.push_back(
        {.id = "error", .title = "How sure the numbers are", .items = {convergence(s, sorted, unit), error_table(s)}});
    document.sections.push_back(
        {.id = "parameters", .title = "What it hangs on", .items = {scatter(s, sorted, unit), input_table(s)}});
  }
  if (s.estimates.failed > 0)
    document.sections.push_back({.id = "failed", .title = "Failed samples", .items = {failed_table(s)}});
  document.sections.push_back(
      {.id = "model", .title = "What this model leaves out", .items = {report::Text{s.leaves_out}}});
  if (s.rung.pilot) document.sections.push_back(pilot_section(*s.rung.pilot));
  return document;
}

}  // namespace boresight::app
