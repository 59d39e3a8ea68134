#include "stability/stability_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "boresight/pointing/relative_text.hpp"
#include "boresight_analyses/stability/amplification.hpp"
#include "report_parts/report_parts.hpp"
#include "terminal/readable.hpp"

namespace boresight::app {
namespace {

// Colours that stand out on blue, white and orange, and on every shade from violet to yellow.
constexpr int kOnDiverging = 3, kOnViridis = 8;
constexpr double kGap = std::numeric_limits<double>::quiet_NaN();

report::Findings cases_of(const StabilityResult& result) {
  report::Findings findings{.title = "Case by case",
                            .caption =
                                "What happens, what the program does about it, and what was measured just now. "
                                "Grey: nothing on this mechanism shows it."};
  for (const FailureCase& c : result.cases) {
    const report::Agreement status = c.standing == FailureCase::Standing::behaves   ? report::Agreement::agrees
                                     : c.standing == FailureCase::Standing::differs ? report::Agreement::differs
                                                                                    : report::Agreement::explained;
    findings.items.push_back({c.name + ": " + c.happens, status, c.measured, "The program " + c.program + "."});
  }
  return findings;
}

// Decades that a hundred steps make of the growth per step, cut where colours would tell nothing more.
constexpr double kSteps = 100.0, kMostDecades = 3.0;
double decades(double growth) {
  return std::clamp(kSteps * std::log10(std::max(growth, 1e-30)), -kMostDecades, kMostDecades);
}

report::Series theory_line(const std::string& name, const std::vector<double>& x, double product, double x_scale,
                           double y_scale, double lowest, double highest, int color) {
  report::Numbers xs, ys;
  for (double v : x) {
    const double y = product / v;
    if (y < lowest || y > highest) continue;
    xs.push_back(v * x_scale);
    ys.push_back(y * y_scale);
  }
  return {.name = name, .x = xs, .y = ys, .style = report::Style::line, .color = color};
}

report::Chart growth_chart(const GrowthMap& map) {
  report::Chart chart{.title = map.method + ": growth of an undamped contact",
                      .caption = "Measured on the linear contact; the line is theory.",
                      .x = {"Contact frequency", "rad/s", true},
                      .y = {"Step", "µs", true}};
  report::Heatmap heat{.x = map.frequency, .label = "decades in 100 steps", .diverging = true};
  report::Numbers steps;
  for (std::size_t i = 0; i < map.step.size(); ++i) {
    steps.push_back(1e6 * map.step[i]);
    heat.z.emplace_back();
    for (double g : map.growth[i]) heat.z.back().push_back(decades(g));
  }
  heat.y = steps;
  chart.heatmap = std::move(heat);
  chart.series.push_back(theory_line(fmt::format("h = {:.4g} / ω", map.limit), map.frequency, map.limit, 1.0, 1e6,
                                     map.step.front(), map.step.back(), kOnDiverging));
  return chart;
}

report::Chart step_chart(const StepMap& map) {
  report::Chart chart{
      .title = "Steps on this mechanism's own motion",
      .caption = "Error of the " + map.index + " against each column's smallest steps (" + map.rung +
                 ", RK4); contact stiffness scaled from 1/64 to 64. Marks: the run was stopped. The frequency is "
                 "the one foreseen at twice the ideal reaction, so a gentle motion bears somewhat more than the "
                 "line.",
      .x = {"Contact frequency foreseen", "rad/s", true},
      .y = {"Step", "µs", true}};
  report::Heatmap heat{.x = map.frequency, .label = "error of the index", .unit = "%", .log = true};
  report::Numbers steps, stopped_x, stopped_y;
  for (std::size_t i = 0; i < map.step.size(); ++i) {
    steps.push_back(1e6 * map.step[i]);
    heat.z.emplace_back();
    for (std::size_t k = 0; k < map.frequency.size(); ++k) {
      const double error = map.error[i][k];
      heat.z.back().push_back(std::isfinite(error) ? 100.0 * std::max(error, 1e-5) : kGap);
      if (!std::isinf(error)) continue;
      stopped_x.push_back(map.frequency[k]);
      stopped_y.push_back(1e6 * map.step[i]);
    }
  }
  heat.y = steps;
  chart.heatmap = std::move(heat);
  chart.series.push_back(
      theory_line("h = 2.785 / ω", map.frequency, 2.785293563405282, 1.0, 1e6, 0.0, 1e300, kOnViridis));
  if (!stopped_x.empty())
    chart.series.push_back(
        {.name = "stopped", .x = stopped_x, .y = stopped_y, .style = report::Style::markers, .color = 6});
  return chart;
}

report::Table limit_table(const StabilityResult& result) {
  report::Table table{
      .title = "Limits of the explicit methods",
      .caption =
          "Step times the contact's frequency (vibration), or times damping over mass (damping), at which "
          "the motion begins to grow.",
      .columns = {{"Method"}, {"Motion"}, {"Theory"}, {"Measured"}, {"Difference", "%"}}};
  for (const AxisLimit& l : result.limits)
    table.rows.push_back({l.method, l.axis, l.theory, l.measured, 100.0 * (l.measured / l.theory - 1.0)});
  return table;
}

report::Chart settled_chart(const StabilityResult& result) {
  report::Chart chart{
      .title = "Contact that lasts: the price of following a vibration that has died",
      .caption =
          "A journal with the stiffest contact's mass and law, at five stiffnesses, dropped under its "
          "typical "
          "load and followed for the same time, relative tolerance 1e-4. The explicit pair sinks to its "
          "stability limit; the L-stable method steps over the settled vibration.",
      .x = {"Contact frequency at rest", "rad/s", true},
      .y = {"evaluations", "", true}};
  for (const bool explicit_pair : {true, false}) {
    report::Series series{.name = "", .style = report::Style::line_markers};
    report::Numbers x, y;
    for (const SettledStep& s : result.settled) {
      const Settling& m = explicit_pair ? s.pair : s.l_stable;
      series.name = m.method;
      if (!m.completed) continue;
      x.push_back(s.frequency);
      y.push_back(static_cast<double>(m.evaluations));
    }
    series.x = x;
    series.y = y;
    if (!x.empty()) chart.series.push_back(std::move(series));
  }
  return chart;
}

report::Table settled_table(const StabilityResult& result) {
  report::Table table{.title = "Contact that lasts",
                      .caption = "Steps times the frequency: mean and largest once contact lasts.",
                      .columns = {{"Frequency", "rad/s"},
                                  {"Method"},
                                  {"Steps"},
                                  {"Rejected"},
                                  {"Evaluations"},
                                  {"Contacts"},
                                  {"Mean step × ω"},
                                  {"Largest step × ω"},
                                  {"Outcome"}}};
  for (const SettledStep& s : result.settled)
    for (const Settling* m : {&s.pair, &s.l_stable})
      table.rows.push_back({s.frequency, m->method, m->steps, m->rejected, m->evaluations, m->contacts,
                            m->mean_step_settled, m->largest_step_settled,
                            !m->completed          ? m->why_not
                            : m->settled_at >= 0.0 ? std::string("at rest")
                                                   : std::string("still bouncing")});
  return table;
}

report::Section contact_section(const StabilityResult& result) {
  report::Section section{.id = "contact",
                          .title = "Step and contact frequency",
                          .intro =
                              "An explicit method must follow every vibration of a closed contact. Blue: it dies; "
                              "white: it stays; orange: it grows."};
  report::Panels panels{.title = "Growth over step and contact frequency", .caption = {}, .columns = 2};
  for (const GrowthMap& map : result.growth) panels.panels.push_back(growth_chart(map));
  if (!panels.panels.empty()) section.items.push_back(std::move(panels));
  if (!result.limits.empty()) section.items.push_back(limit_table(result));
  if (!result.steps.frequency.empty()) section.items.push_back(step_chart(result.steps));
  if (!result.settled.empty()) {
    section.items.push_back(settled_chart(result));
    section.items.push_back(settled_table(result));
  }
  return section;
}

report::Section baumgarte_section(const BaumgarteMap& map) {
  report::Section section{
      .id = "baumgarte",
      .title = "Baumgarte's gains",
      .intro =
          "The violation of a constraint obeys Φ'' + 2α Φ' + β² Φ = 0; each step of RK4 "
          "multiplies it by the root of the "
          "amplification matrix. Measured: the drift of " +
          map.joint +
          ", from a violated start, in the mechanism's own equations "
          "of motion. The gains and the step of Sun, Song and Wang lie at αh = 0.004, βh = 0.005: they "
          "hold, and take thousands of steps to act."};
  report::Chart chart{.title = "Drift over both gains times the step",
                      .caption = fmt::format("Blue: it dies; orange: it grows. Measured; where |R| lies "
                                             "between 0.1 and 2 it differs from theory by at most {}. "
                                             "The line is |R| = 1 in theory.",
                                             relative_text(map.largest_difference)),
                      .x = {"αh", "", true},
                      .y = {"βh", "", true}};
  report::Heatmap heat{.x = map.alpha_h, .y = map.beta_h, .label = "decades in 100 steps", .diverging = true};
  for (const auto& row : map.measured) {
    heat.z.emplace_back();
    for (double g : row) heat.z.back().push_back(decades(g));
  }
  chart.heatmap = std::move(heat);
  // The limit in theory, along rays of zeta from the bottom right to the top left.
  const MethodCoefficients rk4 = coefficients(classical_rk4());
  report::Numbers x, y;
  for (int i = 0; i <= 120; ++i) {
    const double zeta = std::pow(10.0, 3.0 - 6.0 * i / 120.0), beta_h = theoretical_limit(rk4, zeta);
    if (zeta * beta_h < map.alpha_h.front() || beta_h < map.alpha_h.front()) continue;
    x.push_back(zeta * beta_h);
    y.push_back(beta_h);
  }
  chart.series.push_back({.name = "|R| = 1, theory", .x = x, .y = y, .color = kOnDiverging});
  report::Numbers mx, my;
  for (const BaumgarteLimit& l : map.limits) {
    mx.push_back(l.zeta * l.measured);
    my.push_back(l.measured);
  }
  if (!mx.empty())
    chart.series.push_back({.name = "limit, measured", .x = mx, .y = my, .style = report::Style::markers, .color = 6});
  chart.series.push_back({.name = "Sun, Song, Wang",
                          .x = report::Numbers{0.004},
                          .y = report::Numbers{0.005},
                          .style = report::Style::markers,
                          .color = 7});
  section.items.push_back(std::move(chart));
  report::Table table{.title = "Largest stable βh of RK4",
                      .caption = {},
                      .columns = {{"α/β"}, {"Theory"}, {"Measured"}, {"Difference", "%"}}};
  for (const BaumgarteLimit& l : map.limits)
    table.rows.push_back({l.zeta, l.theory, l.measured, 100.0 * (l.measured / l.theory - 1.0)});
  section.items.push_back(std::move(table));
  return section;
}

report::Section horizon_section(const std::vector<Separation>& separations) {
  report::Section section{
      .id = "horizon",
      .title = "How long this motion can be foretold",
      .intro =
          "The same motion with the clearance changed by a whisper. Once the two runs are a tenth of the "
          "clearance apart, where the body is at a given instant is chance; its statistics are not."};
  report::Chart chart{.title = "Distance between neighbouring motions",
                      .caption = {},
                      .x = {"Time", "s"},
                      .y = {"distance over clearance", "", true}};
  report::Table table{
      .title = "Horizons",
      .caption = {},
      .columns = {
          {"Difference in clearance"}, {"Horizon", "s"}, {"RMS error differs by", "%"}, {"Maximum differs by", "%"}}};
  for (const Separation& s : separations) {
    report::Numbers distance;
    for (double d : s.distance) distance.push_back(d > 0.0 ? d : kGap);
    chart.series.push_back({.name = fmt::format("{:.0e}", s.start), .x = s.time, .y = distance});
    table.rows.push_back({s.start, s.horizon >= 0.0 ? nlohmann::json(s.horizon) : nlohmann::json("beyond the motion"),
                          100.0 * s.rms_difference, 100.0 * s.max_difference});
  }
  chart.lines = {{'y', kApart, "a tenth of the clearance"}};
  section.items.push_back(std::move(chart));
  section.items.push_back(std::move(table));
  return section;
}

}  // namespace

bool as_foreseen(const StabilityResult& result) {
  return result.largest_difference() <= kLimitTolerance &&
         std::none_of(result.cases.begin(), result.cases.end(),
                      [](const FailureCase& c) { return c.standing == FailureCase::Standing::differs; });
}

report::Document stability_report(const Command& command, const Mechanism& mechanism, const StabilityResult& result) {
  report::Document document{.title = mechanism.name(), .subtitle = "Where the methods fail", .verb = "stability"};
  if (result.interrupted)
    document.verdict = report::Verdict{report::Standing::bad, "Interrupted: only what was reached is shown."};
  else if (as_foreseen(result))
    document.verdict =
        report::Verdict{report::Standing::good,
                        fmt::format("Every limit is met within {:.2g} % of theory, and nothing fails unannounced.",
                                    100.0 * result.largest_difference())};
  else
    document.verdict = report::Verdict{report::Standing::bad, "Something does not fail as foreseen: see the cases."};
  if (!result.contacts.empty()) {
    const ContactFrequency& stiffest =
        *std::max_element(result.contacts.begin(), result.contacts.end(),
                          [](const auto& a, const auto& b) { return a.angular_frequency < b.angular_frequency; });
    document.facts.push_back({.label = "Largest stable step of RK4",
                              .value = readable(stiffest.largest_stable_step, "s"),
                              .note = fmt::format("{}: {:.4g} rad/s", stiffest.joint, stiffest.angular_frequency)});
  }
  document.facts.push_back(
      {.label = "Limits against theory",
       .value = 100.0 * result.largest_difference(),
       .unit = "%",
       .note = fmt::format("largest of {}", result.limits.size() + result.baumgarte.limits.size())});
  if (!result.separations.empty() && result.separations.front().horizon >= 0.0)
    document.facts.push_back({.label = "Predictability horizon",
                              .value = readable(result.separations.front().horizon, "s"),
                              .note = fmt::format("from a difference of {:.0e}", result.separations.front().start)});
  document.warnings = result.warnings;
  if (!result.cases.empty())
    document.sections.push_back({.id = "cases", .title = "Where methods and models fail", .items = {cases_of(result)}});
  if (!result.limits.empty()) document.sections.push_back(contact_section(result));
  if (!result.baumgarte.measured.empty()) document.sections.push_back(baumgarte_section(result.baumgarte));
  if (!result.separations.empty()) document.sections.push_back(horizon_section(result.separations));
  if (document.sections.empty())
    document.sections.push_back(
        {.id = "nothing", .title = "Nothing was computed", .items = {report::Text{"Interrupted at the start."}}});
  document.provenance = provenance_of(command, mechanism, {"several", "each part says which"});
  return document;
}

}  // namespace boresight::app
