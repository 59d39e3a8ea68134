#include "run/run_report.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <functional>

#include "report_parts/mechanism_view.hpp"
#include "report_parts/report_parts.hpp"
#include "report_parts/step_error_parts.hpp"
#include "results/pilot_parts.hpp"
#include "results/scatter_parts.hpp"
#include "results/tables.hpp"

namespace boresight::app {
namespace {

std::vector<report::Fact> headline(const RunResult& result, const MeasuredError& measured, double size) {
  const PointingIndices& index = result.index;
  // What is known of each one's own error, and then what else there is to it.
  const auto note = [&](const char* quantity, const char* statistic, const std::string& more) {
    const std::string uncertainty = stated_error_text(measured, result, {quantity, statistic}, size);
    return uncertainty + (uncertainty.empty() || more.empty() ? "" : ", ") + more;
  };
  std::vector<report::Fact> facts = {
      {.label = "Position error, maximum",
       .value = readable(index.position_error.max, "m"),
       .note = note("position_error", "max", fmt::format("at {:.3f} s", index.position_error.time_of_max))},
      {.label = "Position error, RMS",
       .value = readable(index.position_error.rms, "m"),
       .note = note("position_error", "rms", "")},
      {.label = "Boresight error, maximum",
       .value = readable(index.boresight_error.max, "rad"),
       .note = note("boresight_error", "max", readable_arcsec(index.boresight_error.max))},
  };
  if (index.has_line_of_sight)
    facts.push_back({.label = "Line-of-sight error, maximum",
                     .value = readable(index.line_of_sight_error.max, "rad"),
                     .note = note("line_of_sight_error", "max", readable_arcsec(index.line_of_sight_error.max))});
  for (const ContactSummary& c : result.contact)
    facts.push_back({.label = c.joint + ", in contact",
                     .value = readable_share(c.contact_fraction),
                     .note = fmt::format("{}, {} at most", how_many(c.impacts, "impact"), readable(c.max_force, "N"))});
  facts.push_back({.label = "Peak acceleration",
                   .value = readable(result.platform_acceleration_max.maxCoeff(), "m/s^2"),
                   .note = "largest of the three axes"});
  return facts;
}

// One quantity of a clearance joint over time.
report::Chart joint_chart(const std::string& title, const std::string& label, const std::string& si_unit,
                          const RunResult& result, std::size_t clearance,
                          const std::function<double(const ClearanceSample&)>& value) {
  std::vector<double> values;
  for (const ClearanceSample& s : result.clearances[clearance]) values.push_back(value(s));
  double most = 0.0;
  for (const double v : values) most = std::max(most, std::abs(v));
  const DisplayUnit unit = display_unit(si_unit, most);
  report::Chart chart{.title = title, .caption = {}, .x = {"Time", "s"}, .y = {label, unit.name}};
  chart.series.push_back(curve(label, result.time, values, unit.per_si));
  return chart;
}

report::Section joint_section(const Mechanism& mechanism, const RunResult& result, std::size_t c) {
  const std::string joint = joint_of_clearance(mechanism, static_cast<int>(c));
  const ClearanceParameters& p = mechanism.parameters().clearance[c];
  const bool ball = is_ball(mechanism, static_cast<int>(c)), pad = is_pad(mechanism, static_cast<int>(c)),
             slider = is_slider(mechanism, static_cast<int>(c)), tilts = may_tilt(mechanism, static_cast<int>(c)),
             corners = pad && has_corners(p);
  const MechanismDescription& m = mechanism.description();
  // Along its axis it goes where the mechanism has it, past no end faces.
  const bool slides = slides_along_axis(m.joints[static_cast<std::size_t>(m.clearances[c].joint)].type);
  report::Section section{
      .id = fmt::format("joint-{}", c + 1),
      .title = "Joint " + joint,
      .intro = ball  ? fmt::format("A ball in its socket: play {}.", readable(p.radial, "m"))
               : pad ? fmt::format(
                           "A pad in its slot: gap {} on each side, {}.", readable(p.axial, "m"),
                           corners ? fmt::format("{} wide and {} long", readable(p.width, "m"), readable(p.length, "m"))
                                   : "radius " + readable(p.pad_radius, "m"))
               : slider ? fmt::format("A slider in its guide: gap {} on each side along its width of {}, {} "
                                      "along its height of {}; {} long.",
                                      readable(p.width_gap, "m"), readable(p.width, "m"), readable(p.height_gap, "m"),
                                      readable(p.height, "m"), readable(p.length, "m"))
               : slides ? fmt::format("Radial clearance {}; it slides freely along its axis.", readable(p.radial, "m"))
                        : fmt::format("Radial clearance {}, axial clearance {} per side.", readable(p.radial, "m"),
                                      readable(p.axial, "m"))};
  if (slider)
    section.items.push_back(guide_chart(joint, p, result, c));
  else if (!pad)
    section.items.push_back(orbit_chart(joint, ball, tilts, p.radial, result, c));

  report::Panels panels{.title = joint + " over time",
                        .caption = "Penetration and force are drawn with their peaks kept.",
                        .columns = 2,
                        .shared_legend = false};
  report::Chart axial = joint_chart(ball  ? "Offset along y"
                                    : pad ? "Offset along the normal"
                                          : "Axial offset",
                                    ball  ? "y of the socket"
                                    : pad ? "along the normal"
                                          : "along the axis",
                                    "m", result, c, [](const ClearanceSample& s) { return s.offset.y(); });
  const DisplayUnit axial_unit{axial.y.unit, axial.y.unit == "mm"   ? 1e3
                                             : axial.y.unit == "µm" ? 1e6
                                             : axial.y.unit == "nm" ? 1e9
                                             : axial.y.unit == "pm" ? 1e12
                                                                    : 1.0};
  if (tilts && !ball && !slides)
    axial.caption = corners ? "A tilted pad touches a face with a corner while its centre is still within the lines."
                    : pad   ? "A tilted pad touches a face with its rim while its centre is still within the lines."
                            : "A tilted journal touches an end face with its edge while its centre is still within the "
                              "lines.";
  if (!ball && !slides)
    axial.lines = {{'y', p.axial * axial_unit.per_si, pad ? "face" : "end face"},
                   {'y', -p.axial * axial_unit.per_si, pad ? "face" : "end face"}};
  panels.panels = {joint_chart("Penetration", "penetration", "m", result, c,
                               [](const ClearanceSample& s) { return std::max(0.0, s.penetration); }),
                   joint_chart("Contact force", "normal force", "N", result, c,
                               [](const ClearanceSample& s) { return s.normal_force; })};
  // Across its normal a pad slides as the mechanism has it.
  if (slider) {
    panels.panels.push_back(joint_chart("Offset along the width", "along the width", "m", result, c,
                                        [](const ClearanceSample& s) { return s.offset.x(); }));
    panels.panels.push_back(joint_chart("Offset along the height", "along the height", "m", result, c,
                                        [](const ClearanceSample& s) { return s.offset.z(); }));
  } else if (!pad)
    panels.panels.push_back(joint_chart(
        ball ? "Offset" : "Radial offset", "distance of the centres", "m", result, c,
        [ball](const ClearanceSample& s) { return ball ? s.offset.norm() : std::hypot(s.offset.x(), s.offset.z()); }));
  if (!slides) panels.panels.push_back(std::move(axial));
  section.items.push_back(std::move(panels));
  return section;
}

report::Panels event_histograms(const RunResult& result) {
  std::vector<double> speed, duration, force;
  for (const ContactEvent& e : result.events) {
    speed.push_back(1e3 * e.start_speed);
    duration.push_back(1e3 * e.duration);
    force.push_back(1e-3 * e.max_force);
  }
  report::Panels panels{.title = "How the contacts are spread",
                        .caption = "Every contact of the motion, whichever joint.",
                        .columns = 3,
                        .shared_legend = false};
  const auto histogram = [&](const char* title, const char* label, const char* unit,
                             const std::vector<double>& values) {
    report::Chart chart{.title = title, .caption = {}, .x = {label, unit}, .y = {"contacts", ""}};
    chart.series.push_back({.name = label, .x = values, .style = report::Style::histogram});
    return chart;
  };
  panels.panels = {histogram("Approach speed", "speed", "mm/s", speed),
                   histogram("Duration", "duration", "ms", duration), histogram("Largest force", "force", "kN", force)};
  // Of several joints, the law that holds least far.
  double valid = 0.0;
  std::string joint;
  for (const ContactSummary& c : result.contact)
    if (c.validity_speed > 0.0 && std::isfinite(c.validity_speed) && (valid == 0.0 || 1e3 * c.validity_speed < valid)) {
      valid = 1e3 * c.validity_speed;
      joint = result.contact.size() > 1 ? " of " + c.joint : "";
    }
  if (valid > 0.0 && !speed.empty() && valid < 1.5 * *std::max_element(speed.begin(), speed.end()))
    panels.panels[0].lines.push_back({'x', valid, "the contact law" + joint + " holds up to here"});
  return panels;
}

report::Table hardest_contacts(const Mechanism& mechanism, const RunResult& result) {
  constexpr std::size_t kShown = 12;
  std::vector<const ContactEvent*> events;
  for (const ContactEvent& e : result.events) events.push_back(&e);
  const std::size_t shown = std::min(kShown, events.size());
  std::partial_sort(events.begin(), events.begin() + static_cast<std::ptrdiff_t>(shown), events.end(),
                    [](const ContactEvent* a, const ContactEvent* b) { return a->max_force > b->max_force; });
  report::Table table{.title = fmt::format("The {} hardest contacts", shown),
                      .caption = fmt::format("Of {}; all of them are in events.csv.", events.size()),
                      .columns = {{"Joint"},
                                  {"Where"},
                                  {"Start", "s"},
                                  {"Duration", "ms"},
                                  {"Approach", "mm/s"},
                                  {"Parting", "mm/s"},
                                  {"Penetration", "µm"},
                                  {"Force", "kN"}}};
  for (std::size_t i = 0; i < shown; ++i) {
    const ContactEvent& e = *events[i];
    table.rows.push_back({joint_of_clearance(mechanism, e.clearance), to_string(e.place), e.start, 1e3 * e.duration,
                          1e3 * e.start_speed, 1e3 * e.end_speed, 1e6 * e.max_penetration, 1e-3 * e.max_force});
  }
  return table;
}

report::Section cost_section(const RunResult& result, const std::optional<Predictability>& predictability) {
  const RunCost& cost = result.cost;
  report::Table table{.title = "What it cost", .caption = {}, .columns = {{"What"}, {"Value"}}};
  table.rows = {{"Integrator", result.integrator},
                {"Steps", cost.steps},
                {"Rejected steps", cost.rejected_steps},
                {"Right-hand sides", cost.evaluations},
                {"CPU", readable(cost.cpu_seconds, "s")},
                {"CPU per right-hand side",
                 cost.evaluations > 0 ? readable(cost.cpu_seconds / static_cast<double>(cost.evaluations), "s") : "-"},
                {"Largest constraint drift", fmt::format("{:.3g} m or rad", result.constraint_drift)}};
  if (result.energy_error != 0.0)
    table.rows.push_back(
        {"Energy balance, largest error", fmt::format("{:.3g} of the largest energy", result.energy_error)});
  report::Section section{.id = "cost", .title = "Cost and numerical quality", .items = {std::move(table)}};
  if (predictability)
    section.items.push_back(report::Text{predictability->measured
                                             ? "Predictability: " + predictability_sentence(*predictability) + "."
                                             : "Predictability was not measured: " + predictability->refusal});
  return section;
}

// What the rung leaves out, by how much it thinks that matters, and what the other rungs say where they were asked.
report::Section model_section(const Mechanism& mechanism, const std::string& leaves_out, const RunResult& result,
                              const std::vector<Compared>& others, const std::optional<AxesComparison>& axes,
                              const std::string& steps) {
  report::Section section{.id = "model", .title = "What this model leaves out", .items = {report::Text{leaves_out}}};
  const ErrorEstimate& error = result.error;
  if (!error.basis.empty()) {
    std::vector<std::string> shares;
    for (const QuantityName& quantity : quantity_names())
      if (quantity.kind != PointingQuantity::line_of_sight_error || result.index.has_line_of_sight)
        shares.push_back(fmt::format("{} ({})", readable_error(error.model_of(quantity.kind)), quantity.title));
    section.items.push_back(report::Text{
        fmt::format("By its own estimate what is left out puts the indices off by about {}. Taken from: {}.",
                    fmt::join(shares, ", "), error.basis)});
  }
  if (!result.interrupted) section.items.push_back(report::Text{"Steps: " + steps + "."});
  if (axes) section.items.push_back(report::Text{axes->sentence});
  if (others.empty()) {
    section.items.push_back(report::Text{"Run with --compare to see the other rungs over this one."});
    return section;
  }
  report::Table table{.title = "The other rungs on this scene",
                      .caption = fmt::format("Differences against the {} rung above.", result.rung),
                      .columns = {{"Rung"},
                                  {"Position max", "%"},
                                  {"Position RMS", "%"},
                                  {"Boresight max", "%"},
                                  {"Boresight RMS", "%"},
                                  {"CPU", "ms"},
                                  {"Own estimate of its error in position", "%"},
                                  {"in boresight", "%"},
                                  {"Remark"}}};
  const auto change = [&](double other, double own, const char* si_unit) -> nlohmann::json {
    if (std::max(own, other) <= rounding_of(mechanism, si_unit)) return nullptr;  // nothing on both
    return error_cell(other / own - 1.0);
  };
  for (const Compared& other : others) {
    if (!other.refusal.empty()) {
      table.rows.push_back({other.rung, nullptr, nullptr, nullptr, nullptr, nullptr, nullptr, nullptr, other.refusal});
      continue;
    }
    const PointingIndices &a = other.result.index, &b = result.index;
    table.rows.push_back({other.rung, change(a.position_error.max, b.position_error.max, "m"),
                          change(a.position_error.rms, b.position_error.rms, "m"),
                          change(a.boresight_error.max, b.boresight_error.max, "rad"),
                          change(a.boresight_error.rms, b.boresight_error.rms, "rad"),
                          1e3 * other.result.cost.cpu_seconds,
                          error_cell(other.result.error.model_of(PointingQuantity::position_error)),
                          error_cell(other.result.error.model_of(PointingQuantity::boresight_error)), ""});
  }
  section.items.push_back(std::move(table));
  return section;
}

}  // namespace

std::string predictability_sentence(const Predictability& found) {
  const std::string twin = fmt::format("a start {} off", readable(kStartOffset, "m"));
  if (!found.parted)
    return fmt::format("{} stays within {} of the clearance over the whole motion", twin, readable_share(kPartedShare));
  const std::string indices = fmt::format("the indices, which differ by {} (max) and {} (RMS) between the two",
                                          readable_error(found.max_difference), readable_error(found.rms_difference));
  if (!(found.horizon > 0.0))
    return fmt::format("the clearance is so small that {} is a good part of it: judge {}", twin, indices);
  return fmt::format(
      "by perturbation, the trajectory is predictable up to {}, where {} parts by {} of the clearance; past it judge "
      "{}",
      readable(found.horizon, "s"), twin, readable_share(kPartedShare), indices);
}

nlohmann::ordered_json predictability_json(const Predictability& found) {
  if (!found.measured) return {{"refused", found.refusal}};
  return {{"horizon", found.horizon},
          {"parted", found.parted},
          {"growth_rate", found.growth},
          {"start_offset", kStartOffset},
          {"parted_share_of_clearance", kPartedShare},
          {"position_error_max_difference", found.max_difference},
          {"position_error_rms_difference", found.rms_difference}};
}

report::Document run_report(const Command& command, const Mechanism& mechanism, const RungChoice& rung,
                            const std::string& leaves_out, const RunResult& result, const std::vector<Compared>& others,
                            const std::optional<AxesComparison>& axes,
                            const std::optional<Predictability>& predictability, const MeasuredError& measured,
                            const std::string& steps) {
  report::Document document{
      .title = mechanism.name(),
      .subtitle = fmt::format("One motion of {} on the {} rung{}", readable(result.end_time, "s"), result.rung,
                              result.formulation.empty() ? "" : ", " + result.formulation + " formulation"),
      .verb = "run"};
  if (result.interrupted)
    document.verdict = report::Verdict{
        report::Standing::bad, fmt::format("Interrupted at {} of {}: what follows is the part that was reached.",
                                           readable(result.end_time, "s"), readable(mechanism.duration(), "s"))};
  document.facts = headline(result, measured, mechanism.characteristic_length());
  document.warnings = result.warnings;
  document.provenance = provenance_of(command, mechanism, rung);

  std::vector<Overlay> overlay = {{others.empty() ? "with clearance" : result.rung, &result}};
  if (measured.measured)
    overlay.front().stated = [&](const IndexChoice& of) {
      return stated_error_text(measured, result, of, mechanism.characteristic_length());
    };
  for (const Compared& other : others)
    if (other.refusal.empty()) overlay.push_back({other.rung, &other.result});
  report::Section errors{.id = "errors", .title = "Pointing error", .items = {index_table(overlay)}};
  if (!result.time.empty()) {
    errors.items.push_back(error_panels(mechanism, overlay));
    errors.items.push_back(difference_panels(mechanism, overlay));
  }
  document.sections.push_back(std::move(errors));
  if (!result.time.empty()) {
    report::Section motion{.id = "motion", .title = "Motion"};
    if (!result.frames.empty()) motion.items.push_back(mechanism_view(mechanism, result));
    motion.items.push_back(motion_panels(mechanism, overlay,
                                         "Position of the centre of mass in the world, Z-Y-X Euler angles from home, "
                                         "and accelerations in world axes."));
    document.sections.push_back(std::move(motion));
  }
  if (mechanism.clearances() > 0) {
    report::Section contact{.id = "contact", .title = "Contact", .items = {contact_table(overlay)}};
    if (!result.time.empty()) contact.items.push_back(contact_strip(mechanism, result));
    if (!result.events.empty()) {
      contact.items.push_back(event_histograms(result));
      contact.items.push_back(hardest_contacts(mechanism, result));
    }
    document.sections.push_back(std::move(contact));
    if (!result.time.empty())
      for (std::size_t c = 0; c < result.clearances.size(); ++c)
        document.sections.push_back(joint_section(mechanism, result, c));
  }
  document.sections.push_back(model_section(mechanism, leaves_out, result, others, axes, steps));
  if (rung.pilot) document.sections.push_back(pilot_section(*rung.pilot));
  document.sections.push_back(cost_section(result, predictability));
  return document;
}

}  // namespace boresight::app
