#include "laws/laws_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "boresight/contact/law_range.hpp"
#include "terminal/readable.hpp"
#include "terminal/terminal.hpp"

namespace boresight::app {
namespace {

report::Table restitution_table(const std::vector<NormalLawRow>& rows) {
  report::Table table{
      .title = "Restitution returned for the one asked for",
      .caption = "Measured: one impact of a free mass, integrated until it parts. Empty: cannot be asked for.",
      .columns = {{"Law"}}};
  for (const double e : asked_restitutions()) table.columns.push_back({fmt::format("{}", e)});
  for (const NormalLawRow& row : rows) {
    std::vector<nlohmann::json> cells = {row.entry->name};
    for (const double returned : row.returned)
      cells.push_back(std::isnan(returned) ? nlohmann::json() : nlohmann::json(returned));
    table.rows.push_back(std::move(cells));
  }
  return table;
}

report::Chart restitution_chart(const std::vector<NormalLawRow>& rows) {
  report::Chart chart{.title = "Error of the restitution",
                      .caption =
                          "Returned less asked for. Laws for cylinders take the exact factor (Pereira's: Lankarani and "
                          "Nikravesh's), which is the same whatever the elastic curve.",
                      .x = {"restitution asked for", ""},
                      .y = {"returned - asked", ""},
                      .height = 460};
  for (const NormalLawRow& row : rows) {
    if (row.entry->geometry != ContactGeometry::point) continue;
    report::Series series{.name = row.entry->name, .x = asked_restitutions(), .style = report::Style::line_markers};
    std::vector<double> error;
    for (std::size_t k = 0; k < row.returned.size(); ++k) error.push_back(row.returned[k] - asked_restitutions()[k]);
    series.y = error;
    series.hidden = row.entry->name == std::string("hertz");
    chart.series.push_back(std::move(series));
  }
  return chart;
}

report::Chart loops(const std::vector<NormalLawRow>& rows, const LawsSubject& s, bool hertz) {
  report::Chart chart{
      .title =
          hertz ? "Force against penetration: Hertz's geometry" : "Force against penetration: cylinders and springs",
      .caption =
          fmt::format("One impact of {} at {}, restitution asked for {}: up on the way in, down on the way out; the "
                      "area between is what the law dissipates.",
                      readable(s.mass, "kg"), readable(s.speed, "m/s"), s.parameters.contact.restitution),
      .x = {"penetration", "µm"},
      .y = {"force", "N"},
      .height = 460};
  for (const NormalLawRow& row : rows) {
    if ((row.entry->geometry == ContactGeometry::point) != hertz) continue;
    std::vector<double> d, F;
    for (const ImpactSample& p : row.path) {
      d.push_back(1e6 * p.penetration);
      F.push_back(p.force);
    }
    chart.series.push_back({.name = row.entry->name, .x = d, .y = F, .muted = row.entry->name == std::string("hertz")});
  }
  return chart;
}

report::Chart elastic_chart(const std::vector<NormalLawRow>& rows, const LawsSubject& s) {
  report::Chart chart{
      .title = "Elastic force of the same joint by each geometry",
      .caption = fmt::format("Journal of {} in a sleeve {} longer in radius and {} long: what Hertz's point, "
                             "the line laws and the conformal law say of the same depth.",
                             readable(s.parameters.journal_radius, "m"), readable(s.parameters.radial, "m"),
                             readable(s.parameters.sleeve_length, "m")),
      .x = {"penetration", "µm"},
      .y = {"force", "N"},
      .height = 420};
  bool hertz_drawn = false;
  for (const NormalLawRow& row : rows) {
    if (row.entry->geometry == ContactGeometry::point && std::exchange(hertz_drawn, true)) continue;
    std::vector<double> d;
    for (const double p : row.penetration) d.push_back(1e6 * p);
    chart.series.push_back({.name = row.entry->geometry == ContactGeometry::point ? "hertz (point)" : row.entry->name,
                            .x = d,
                            .y = row.force});
  }
  return chart;
}

report::Chart friction_chart(const std::vector<FrictionLawRow>& rows) {
  report::Chart chart{.title = "Steady friction over the normal force",
                      .caption = "LuGre's is the steady curve; below it, its bristles hold.",
                      .x = {"sliding speed", "mm/s", true},
                      .y = {"friction / normal force", ""},
                      .height = 420};
  for (const FrictionLawRow& row : rows) {
    std::vector<double> v;
    for (const double speed : row.speed) v.push_back(1e3 * speed);
    chart.series.push_back(
        {.name = row.entry->name, .x = v, .y = row.force, .hidden = row.entry->kind == FrictionKind::none});
  }
  return chart;
}

}  // namespace

std::string range_of(const NormalLawRow& row, const LawsSubject& s) {
  std::string text;
  switch (make_normal_law(row.entry->name, "", s.parameters).curve) {
    case ElasticCurve::point:
      text = "patch up to 15 degrees each side, shorter than the sleeve";
      break;
    case ElasticCurve::logarithmic:
      text = "line contact up to 15 degrees each side";
      break;
    case ElasticCurve::conformal:
      text = "line contact from 15 to 90 degrees each side";
      break;
    case ElasticCurve::power:
      text = "clearance 0.005 to 10 mm";
      break;
    case ElasticCurve::linear:
      text = "a spring: any";
      break;
  }
  return text;
}

report::Document laws_report(const Command& command, const LawsSubject& s, const std::vector<NormalLawRow>& normal,
                             const std::vector<FrictionLawRow>& friction) {
  report::Document document{.title = "Contact and friction laws",
                            .subtitle = s.mechanism.empty() ? "for the default pin" : s.joint + " of " + s.mechanism,
                            .verb = "laws"};
  document.warnings = s.warnings;
  document.facts = {{.label = "Contact laws", .value = normal.size()},
                    {.label = "Friction laws", .value = friction.size()}};
  if (!s.contact_law.empty()) {
    document.facts.push_back({.label = "The joint uses", .value = s.contact_law, .note = s.friction_law + " friction"});
    document.facts.push_back({.label = "Largest load of the ideal motion",
                              .value = readable(s.largest_load, "N"),
                              .note = fitting_law(s.parameters, s.largest_load) + " fits as a line contact"});
  }
  report::Table contact{.title = "Contact laws",
                        .caption =
                            "h: damping factor in F = K d^1.5 (1 + h d'/d0'); e: restitution asked for; f: force per "
                            "length; E: composite modulus; dR: radial clearance.",
                        .columns = {{"Law"},
                                    {"Formula"},
                                    {"Source"},
                                    {"Holds for"},
                                    {"e within 0.02 from"},
                                    {"Depth", "µm"},
                                    {"Force", "N"},
                                    {"Returned"}}};
  for (const NormalLawRow& row : normal)
    contact.rows.push_back({row.entry->name, row.entry->formula, row.entry->source, range_of(row, s),
                            row.good_from > 1.0 ? nlohmann::json() : nlohmann::json(row.good_from), 1e6 * row.one.depth,
                            row.one.force, row.one.restitution});
  report::Table sliding{
      .title = "Friction laws",
      .caption =
          "v: sliding speed; v_s, v_d, v_st: static, dynamic and Stribeck speed; mu, mu_s: kinetic and "
          "static "
          "coefficient; z: bristle deflection.",
      .columns = {{"Law"}, {"Friction over normal force"}, {"Source"}, {"Static peak"}, {"Holds a load at rest"}}};
  for (const FrictionLawRow& row : friction)
    sliding.rows.push_back(
        {row.entry->name, row.entry->formula, row.entry->source, row.entry->peak, row.entry->sticks});
  document.sections = {
      {.id = "contact",
       .title = "Contact",
       .intro = fmt::format("Depth, force and restitution of the last columns are of one impact of {} at {}.",
                            readable(s.mass, "kg"), readable(s.speed, "m/s")),
       .items = {std::move(contact), restitution_table(normal), restitution_chart(normal)}},
      {.id = "force",
       .title = "Force",
       .items = {loops(normal, s, true), loops(normal, s, false), elastic_chart(normal, s)}},
      {.id = "friction", .title = "Friction", .items = {std::move(sliding), friction_chart(friction)}}};
  document.provenance = {{"Version", BORESIGHT_VERSION},
                         {"Command", "boresight laws" + (command.file.empty() ? "" : " " + shell_word(command.file))}};
  if (!s.hash.empty()) document.provenance.push_back({"Mechanism hash", s.hash});
  return document;
}

}  // namespace boresight::app
