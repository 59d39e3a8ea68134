#include "sweep/sweep_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <functional>
#include <set>

#include "boresight_analyses/sweep/sweep_line.hpp"
#include "report_parts/report_parts.hpp"
#include "results/pilot_parts.hpp"
#include "sweep/drawn_combinations.hpp"
#include "sweep/published_findings.hpp"

namespace boresight::app {
namespace {

std::vector<Overlay> overlays_of(const SweepPlan& plan, const SweepResult& result) {
  std::vector<Overlay> overlays;
  for (const SweepPoint& p : result.points)
    if (p.status == SweepPoint::Status::done)
      overlays.push_back({point_name(plan, p, plan.axes.size() > 1), &p.result});
  return overlays;
}

std::string axis_label(const SweepAxis& axis) {
  std::string label = axis.parameters.front();
  for (std::size_t i = 1; i < axis.parameters.size(); ++i) label += " = " + axis.parameters[i];
  return label;
}

// Values along the first axis; one series per combination of the others. `value` in SI.
using PointValue = std::function<double(const RunResult&)>;
struct Measure {
  std::string name;
  PointValue value;
};

report::Chart against_parameter(const std::string& title, const std::string& label, const std::string& si_unit,
                                const SweepPlan& plan, const SweepResult& result,
                                const std::vector<Measure>& measures) {
  const SweepAxis& axis = plan.axes.front();
  const DisplayUnit x_unit =
      display_unit_as(axis.si_unit, *std::max_element(axis.values.begin(), axis.values.end()), axis.unit);
  double most = 0.0;
  for (const SweepPoint& p : result.points)
    if (p.status == SweepPoint::Status::done)
      for (const Measure& m : measures) most = std::max(most, std::abs(m.value(p.result)));
  const DisplayUnit y_unit = display_unit(si_unit, most);
  report::Chart chart{.title = title, .caption = {}, .x = {axis.name(), x_unit.name}, .y = {label, y_unit.name}};
  const std::size_t runs = plan.points() / axis.values.size();  // combinations of the other axes
  for (const std::size_t r : drawn_combinations(plan).combinations) {
    for (const Measure& m : measures) {
      report::Numbers x, y;
      std::vector<std::pair<double, double>> points;
      for (std::size_t i = 0; i < axis.values.size(); ++i) {
        const SweepPoint& p = result.points[i * runs + r];
        if (p.status == SweepPoint::Status::done)
          points.emplace_back(p.values.front() * x_unit.per_si, m.value(p.result) * y_unit.per_si);
      }
      std::sort(points.begin(), points.end());
      for (const auto& [px, py] : points) {
        x.push_back(px);
        y.push_back(py);
      }
      std::string name = m.name;
      if (runs > 1) {
        const SweepPoint& p = result.points[r];
        for (std::size_t k = 1; k < plan.axes.size(); ++k)
          name +=
              ", " + plan.axes[k].name() + " = " + readable_as(p.values[k], plan.axes[k].si_unit, plan.axes[k].unit);
      }
      chart.series.push_back({.name = name, .x = x, .y = y, .style = report::Style::line_markers});
    }
  }
  return chart;
}

// Why there is no panel of the boresight error, or "" where there is one.
std::string rotations_note(const Mechanism& mechanism, const SweepResult& result) {
  double rotation = 0.0;
  for (const SweepPoint& p : result.points) rotation = std::max(rotation, p.result.index.boresight_error.max);
  return rotation > rounding_of(mechanism, "rad") ? "" : "The boresight error is zero to rounding and not drawn.";
}

report::Section index_section(const Mechanism& mechanism, const Study& study, const SweepPlan& plan,
                              const SweepResult& result) {
  report::Section section{.id = "index",
                          .title = "The index against the parameter",
                          .intro = "The study's index is the " + study.index.title() + ". " + study.index.definition()};
  if (const std::string drawn = drawn_combinations(plan).sentence(plan); !drawn.empty()) section.intro += " " + drawn;
  report::Panels panels{.title = "Index", .caption = rotations_note(mechanism, result), .columns = 2};
  const auto of = [](const char* quantity, const char* statistic) {
    return [choice = IndexChoice{quantity, statistic}](const RunResult& r) { return choice.of(r.index); };
  };
  panels.panels.push_back(
      against_parameter("Position error", "position error", "m", plan, result,
                        {{"maximum", of("position_error", "max")}, {"RMS", of("position_error", "rms")}}));
  if (rotations_note(mechanism, result).empty())
    panels.panels.push_back(
        against_parameter("Boresight error", "boresight error", "rad", plan, result,
                          {{"maximum", of("boresight_error", "max")}, {"RMS", of("boresight_error", "rms")}}));
  if (std::any_of(result.points.begin(), result.points.end(),
                  [](const SweepPoint& p) { return p.result.index.has_line_of_sight; }))
    panels.panels.push_back(
        against_parameter("Line-of-sight error", "line-of-sight error", "rad", plan, result,
                          {{"maximum", of("line_of_sight_error", "max")}, {"RMS", of("line_of_sight_error", "rms")}}));
  section.items.push_back(std::move(panels));
  return section;
}

report::Section contact_section(const Mechanism& mechanism, const SweepPlan& plan, const SweepResult& result,
                                const std::vector<Overlay>& overlays) {
  report::Section section{
      .id = "contact", .title = "Contacts and accelerations", .intro = drawn_combinations(plan).sentence(plan)};
  report::Chart peaks =
      against_parameter("Peak acceleration of the platform", "peak acceleration", "m/s^2", plan, result,
                        {{"x", [](const RunResult& r) { return r.platform_acceleration_max.x(); }},
                         {"y", [](const RunResult& r) { return r.platform_acceleration_max.y(); }},
                         {"z", [](const RunResult& r) { return r.platform_acceleration_max.z(); }}});
  peaks.caption = "Per world axis, the ideal motion's own acceleration included, from every accepted step.";
  section.items.push_back(std::move(peaks));
  report::Panels panels{
      .title = "What the joint goes through", .caption = {}, .columns = 3, .shared_legend = plan.axes.size() > 1};
  if (mechanism.clearances() > 0) {
    panels.panels.push_back(
        against_parameter("Free flight", "share of the time, %", "1", plan, result,
                          {{"free flight", [](const RunResult& r) { return 100.0 * free_flight_share(r); }}}));
    panels.panels.push_back(against_parameter("Impacts", "contacts begun", "1", plan, result, {{"impacts", impacts}}));
    panels.panels.push_back(against_parameter("Deepest penetration", "penetration", "m", plan, result,
                                              {{"deepest", [](const RunResult& r) {
                                                  double most = 0.0;
                                                  for (const ContactSummary& c : r.contact)
                                                    most = std::max(most, c.max_penetration);
                                                  return most;
                                                }}}));
    section.items.push_back(std::move(panels));
    section.items.push_back(contact_table(overlays));
  }
  return section;
}

report::Section findings_section(const std::vector<PublishedFinding>& published) {
  report::Findings findings{.title = "Statement by statement",
                            .caption =
                                "Every verdict is a comparison of this sweep's own numbers; the dimensions "
                                "are ours, as the paper gives none."};
  for (const PublishedFinding& f : published) {
    const report::Agreement status = f.verdict == PublishedFinding::Verdict::agrees    ? report::Agreement::agrees
                                     : f.verdict == PublishedFinding::Verdict::differs ? report::Agreement::differs
                                                                                       : report::Agreement::explained;
    findings.items.push_back({f.statement, status, f.measured, f.why});
  }
  return {.id = "findings",
          .title = "What the paper found, and what this sweep finds",
          .intro =
              "Sun, Song, Wang: Dynamic modeling and analysis of 3-RRCP parallel pointing mechanism with "
              "clearance, sections 4 and 5.",
          .items = {std::move(findings)}};
}

std::vector<report::Fact> headline(const Study& study, const SweepPlan& plan, const SweepResult& result) {
  const SweepPoint *least = nullptr, *most = nullptr;
  for (const SweepPoint& p : result.points) {
    if (p.status != SweepPoint::Status::done) continue;
    if (!least || study.index.of(p.result.index) < study.index.of(least->result.index)) least = &p;
    if (!most || study.index.of(p.result.index) > study.index.of(most->result.index)) most = &p;
  }
  std::vector<report::Fact> facts = {{.label = "Points", .value = result.points.size()}};
  if (!least) return facts;
  const auto value = [&](const SweepPoint& p) {
    return readable(study.index.of(p.result.index), study.index.si_unit());
  };
  facts.push_back({.label = "Smallest index", .value = value(*least), .note = "at " + point_name(plan, *least, true)});
  facts.push_back({.label = "Largest index", .value = value(*most), .note = "at " + point_name(plan, *most, true)});
  return facts;
}

std::vector<std::string> warnings_of(const SweepPlan& plan, const SweepResult& result) {
  std::vector<std::string> warnings;
  for (const SweepPoint& p : result.points)
    if (p.status == SweepPoint::Status::failed)
      warnings.push_back(point_name(plan, p, true) + ": failed: " + p.failure);
  for (const std::string& warning : told_of_points(plan, result)) warnings.push_back(warning);
  constexpr std::size_t kShown = 12;
  if (warnings.size() > kShown) {
    const std::size_t more = warnings.size() - kShown;
    warnings.resize(kShown);
    warnings.push_back(fmt::format("and {} more, in summary.json", more));
  }
  return warnings;
}

}  // namespace

std::string point_name(const SweepPlan& plan, const SweepPoint& point, bool with_parameters) {
  std::string name;
  for (std::size_t i = 0; i < plan.axes.size(); ++i) {
    name += i ? ", " : "";
    if (with_parameters) name += plan.axes[i].name() + " = ";
    name += readable_as(point.values[i], plan.axes[i].si_unit, plan.axes[i].unit);
  }
  return name;
}

std::vector<std::string> told_of_points(const SweepPlan& plan, const SweepResult& result) {
  struct Told {
    std::string kind, text;
    std::size_t points = 0;
  };
  std::vector<Told> told;
  std::size_t done = 0;
  for (const SweepPoint& p : result.points) {
    if (p.status != SweepPoint::Status::done) continue;
    ++done;
    std::vector<std::string> here;  // a point counts once for each
    for (const std::string& warning : p.result.warnings) {
      std::string kind;
      for (const char letter : warning)
        if (letter != '.' && std::isdigit(static_cast<unsigned char>(letter)) == 0) kind += letter;
      if (std::find(here.begin(), here.end(), kind) != here.end()) continue;
      here.push_back(kind);
      auto known = std::find_if(told.begin(), told.end(), [&](const Told& other) { return other.kind == kind; });
      if (known == told.end()) known = told.insert(told.end(), {kind, point_name(plan, p, true) + ": " + warning, 0});
      ++known->points;
    }
  }
  std::vector<std::string> warnings;
  for (const Told& one : told)
    warnings.push_back(one.points > 1 ? fmt::format("{} (at {} of {} points)", one.text, one.points, done) : one.text);
  return warnings;
}

report::Document sweep_report(const Command& command, const Study& study, const Mechanism& mechanism,
                              const RungChoice& rung, const std::string& leaves_out, const SweepPlan& plan,
                              const SweepResult& result) {
  const bool papers = plan.findings == "sun-3-rrcpr";
  std::string swept;
  for (const SweepAxis& axis : plan.axes) swept += (swept.empty() ? "" : " by ") + axis_label(axis);
  report::Document document{.title = mechanism.name(), .subtitle = "Sweep over " + swept, .verb = "sweep"};
  if (result.interrupted)
    document.verdict =
        report::Verdict{report::Standing::bad, "Interrupted: only the points that were finished are shown."};
  if (result.failed > 0 && !result.interrupted)
    document.verdict = report::Verdict{report::Standing::bad, fmt::format("{} of {} points failed; see the warnings.",
                                                                          result.failed, result.points.size())};
  document.facts = headline(study, plan, result);
  document.warnings = warnings_of(plan, result);
  document.provenance = provenance_of(command, mechanism, rung);
  document.provenance.push_back({"Study hash", study.content_hash});

  std::vector<Overlay> overlays = overlays_of(plan, result);
  if (!overlays.empty()) {
    document.sections.push_back(index_section(mechanism, study, plan, result));
    std::vector<Overlay> drawn = overlays;
    drawn.erase(std::remove_if(drawn.begin(), drawn.end(), [](const Overlay& o) { return o.result->time.empty(); }),
                drawn.end());
    if (!drawn.empty() && drawn.size() <= kMostOverlaid)
      document.sections.push_back(
          {.id = "motion",
           .title = "Motion, point over point",
           .items = {
               motion_panels(mechanism, drawn,
                             std::string("Position of the centre of mass in the world, Z-Y-X Euler angles from home, "
                                         "accelerations in world axes") +
                                 (papers ? ": the twelve panels of Sun et al., Fig. 6 and Fig. 7." : ".")),
               difference_panels(mechanism, drawn), error_panels(mechanism, drawn)}});
    document.sections.push_back(contact_section(mechanism, plan, result, overlays));
    if (papers) {
      const std::vector<PublishedFinding> published = published_findings(mechanism, plan, result);
      if (!published.empty()) document.sections.push_back(findings_section(published));
    }
    document.sections.push_back({.id = "table", .title = "Every point", .items = {index_table(overlays)}});
  }
  document.sections.push_back(
      {.id = "model", .title = "What this model leaves out", .items = {report::Text{leaves_out}}});
  if (rung.pilot) document.sections.push_back(pilot_section(*rung.pilot));
  return document;
}

}  // namespace boresight::app
