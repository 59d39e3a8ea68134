#include "report_parts/report_parts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <functional>
#include <numbers>

#include "boresight/play/play_words.hpp"
#include "boresight_analyses/study/index_choice.hpp"
#include "results/assumed.hpp"
#include "results/tables.hpp"

namespace boresight::app {
namespace {

constexpr double kDegrees = 180.0 / std::numbers::pi;

using Value = std::function<double(const PoseSample&)>;

std::vector<double> values_of(const RunResult& result, const Value& value) {
  std::vector<double> values;
  values.reserve(result.boresight.samples.size());
  for (const PoseSample& sample : result.boresight.samples) values.push_back(value(sample));
  return values;
}

double largest(const std::vector<double>& values) {
  double most = 0.0;
  for (const double v : values) most = std::max(most, std::abs(v));
  return most;
}

// One panel: the same quantity of every overlay, and of the ideal motion where there is one to show.
report::Chart panel(const std::string& title, const report::Axis& y, const std::vector<Overlay>& overlays,
                    double per_si, const Value& value, const Value& ideal = {}) {
  report::Chart chart{.title = title, .caption = {}, .x = {"Time", "s"}, .y = y};
  int color = 1;
  for (const Overlay& overlay : overlays) {
    chart.series.push_back(curve(overlay.name, overlay.result->time, values_of(*overlay.result, value), per_si));
    chart.series.back().color = color;
    color = color % 8 + 1;
  }
  if (ideal) {
    const RunResult& first = *overlays.front().result;
    chart.series.push_back(curve("ideal", first.time, values_of(first, ideal), per_si));
    chart.series.back().muted = true;
  }
  return chart;
}

double largest_over(const std::vector<Overlay>& overlays, const Value& value) {
  double most = 0.0;
  for (const Overlay& overlay : overlays) most = std::max(most, largest(values_of(*overlay.result, value)));
  return most;
}

constexpr const char* kAxisName[] = {"x", "y", "z"};

// No column is so narrow that a number is broken from its sign or its unit.
std::string in_one_line(const std::string& text) {
  std::string out;
  for (const char c : text) out += c == ' ' ? std::string("\u00a0") : std::string(1, c);
  return out;
}

constexpr const char* kStated =
    " ±: what steps do and what the rung leaves out, of each figure by itself, where that was measured.";

}  // namespace

double rounding_of(const Mechanism& mechanism, const std::string& si_unit) {
  constexpr double kRounded = 1e-11, kIntegrated = 1e-8;
  const bool deviates = mechanism.clearances() > 0 || !mechanism.description().errors.empty();
  return (deviates ? kRounded : kIntegrated) * (si_unit == "m" ? mechanism.characteristic_length() : 1.0);
}

report::Series curve(const std::string& name, const std::vector<double>& time, const std::vector<double>& si_values,
                     double per_si) {
  std::vector<double> y = si_values;
  for (double& v : y) v *= per_si;
  auto [x, thin] = report::thinned(time, y, kPointsPerCurve);
  return {.name = name, .x = std::move(x), .y = std::move(thin)};
}

std::vector<Vec3> euler_angles(const std::vector<Quat>& orientations, const Mat3& home) {
  std::vector<Vec3> angles;
  angles.reserve(orientations.size());
  for (const Quat& q : orientations) {
    const Mat3 R = q.toRotationMatrix() * home.transpose();
    // R = Rz(c) Ry(b) Rx(a)
    Vec3 now(std::atan2(R(2, 1), R(2, 2)), std::asin(std::clamp(-R(2, 0), -1.0, 1.0)), std::atan2(R(1, 0), R(0, 0)));
    if (!angles.empty())
      for (const int k : {0, 2})
        now[k] += 2.0 * std::numbers::pi * std::round((angles.back()[k] - now[k]) / (2.0 * std::numbers::pi));
    angles.push_back(now);
  }
  return angles;
}

report::Panels motion_panels(const Mechanism& mechanism, const std::vector<Overlay>& overlays,
                             const std::string& caption) {
  report::Panels panels{
      .title = "Motion of the " + overlays.front().result->boresight.name, .caption = caption, .columns = 3};
  for (int k = 0; k < 3; ++k)
    panels.panels.push_back(panel(
        std::string("Position ") + kAxisName[k], {kAxisName[k], "mm"}, overlays, 1e3,
        [k](const PoseSample& s) { return s.pose.p[k]; }, [k](const PoseSample& s) { return s.ideal.p[k]; }));

  const Mat3& home = mechanism.description().bodies[mechanism.boresight_body()].axes;
  const auto angles_of = [&](const RunResult& result, bool ideal) {
    std::vector<Quat> q;
    for (const PoseSample& s : result.boresight.samples) q.push_back(ideal ? s.ideal.q : s.pose.q);
    return euler_angles(q, home);
  };
  std::vector<std::vector<Vec3>> angles;
  for (const Overlay& overlay : overlays) angles.push_back(angles_of(*overlay.result, false));
  const std::vector<Vec3> ideal_angles = angles_of(*overlays.front().result, true);
  const char* greek[] = {"α (about x)", "β (about y)", "γ (about z)"};
  for (int k = 0; k < 3; ++k) {
    report::Chart chart{
        .title = std::string("Euler angle ") + greek[k], .caption = {}, .x = {"Time", "s"}, .y = {greek[k], "deg"}};
    const auto component = [k](const std::vector<Vec3>& v) {
      std::vector<double> c;
      for (const Vec3& a : v) c.push_back(a[k]);
      return c;
    };
    for (std::size_t i = 0; i < overlays.size(); ++i) {
      chart.series.push_back(curve(overlays[i].name, overlays[i].result->time, component(angles[i]), kDegrees));
      chart.series.back().color = static_cast<int>(i % 8) + 1;
    }
    chart.series.push_back(curve("ideal", overlays.front().result->time, component(ideal_angles), kDegrees));
    chart.series.back().muted = true;
    panels.panels.push_back(std::move(chart));
  }
  for (int k = 0; k < 3; ++k)
    panels.panels.push_back(panel(
        std::string("Acceleration ") + kAxisName[k], {std::string("a") + kAxisName[k], "m/s²"}, overlays, 1.0,
        [k](const PoseSample& s) { return s.a[k]; }, [k](const PoseSample& s) { return s.ideal_a[k]; }));
  for (int k = 0; k < 3; ++k)
    panels.panels.push_back(panel(
        std::string("Angular acceleration ") + kAxisName[k], {std::string("α") + kAxisName[k], "rad/s²"}, overlays, 1.0,
        [k](const PoseSample& s) { return s.alpha[k]; }, [k](const PoseSample& s) { return s.ideal_alpha[k]; }));
  return panels;
}

report::Panels difference_panels(const Mechanism& mechanism, const std::vector<Overlay>& overlays) {
  report::Panels panels{
      .title = "Difference from the ideal motion",
      .caption = "The same motion with the ideal one taken away, in world axes: what play and standing errors do.",
      .columns = 3};
  double position = 0.0, rotation = 0.0;
  for (int k = 0; k < 3; ++k) {
    position = std::max(position, largest_over(overlays, [k](const PoseSample& s) { return s.error.displacement[k]; }));
    rotation = std::max(rotation, largest_over(overlays, [k](const PoseSample& s) { return s.error.rotation[k]; }));
  }
  const DisplayUnit length = display_unit("m", position), angle = display_unit("rad", rotation);
  for (int k = 0; k < 3; ++k)
    panels.panels.push_back(panel(std::string("Displacement error ") + kAxisName[k],
                                  {std::string("d") + kAxisName[k], length.name}, overlays, length.per_si,
                                  [k](const PoseSample& s) { return s.error.displacement[k]; }));
  if (rotation < rounding_of(mechanism, "rad"))
    panels.caption += " The rotation errors are zero to rounding and not drawn.";
  else
    for (int k = 0; k < 3; ++k)
      panels.panels.push_back(panel(std::string("Rotation error ") + kAxisName[k],
                                    {std::string("r") + kAxisName[k], angle.name}, overlays, angle.per_si,
                                    [k](const PoseSample& s) { return s.error.rotation[k]; }));
  return panels;
}

report::Panels error_panels(const Mechanism& mechanism, const std::vector<Overlay>& overlays) {
  report::Panels panels{.title = "Pointing errors over time", .caption = {}, .columns = 2};
  struct Entry {
    const char* title;
    const char* si_unit;
    Value value;
  };
  const Entry entries[] = {
      {"Position error", "m", [](const PoseSample& s) { return s.error.position; }},
      {"Boresight error", "rad", [](const PoseSample& s) { return s.error.boresight; }},
      {"Orientation error", "rad", [](const PoseSample& s) { return s.error.orientation; }},
      {"Line-of-sight error", "rad", [](const PoseSample& s) { return s.error.line_of_sight; }},
  };
  for (const Entry& entry : entries) {
    if (&entry == &entries[3] && !overlays.front().result->index.has_line_of_sight) continue;
    const double most = largest_over(overlays, entry.value);
    if (most < rounding_of(mechanism, entry.si_unit)) {
      panels.caption +=
          (panels.caption.empty() ? "" : " ") + std::string(entry.title) + ": zero to rounding, not drawn.";
      continue;
    }
    const DisplayUnit unit = display_unit(entry.si_unit, most);
    panels.panels.push_back(panel(entry.title, {"error", unit.name}, overlays, unit.per_si, entry.value));
  }
  if (panels.panels.empty())
    panels.panels.push_back(panel("Position error", {"error", "m"}, overlays, 1.0, entries[0].value));
  return panels;
}

// Of every error in the table, and from when on they count.
std::string definitions(const std::vector<Overlay>& overlays) {
  const RunResult& first = *overlays.front().result;
  std::string text;
  if (first.start > 0.0) text += " What the motion does before " + readable(first.start, "s") + " is left out.";
  for (const QuantityName& quantity : quantity_names()) {
    if (quantity.kind == PointingQuantity::line_of_sight_error && !first.index.has_line_of_sight) continue;
    std::string title = quantity.title;
    title.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(title.front())));
    text += " " + title + ": " + quantity.definition;
  }
  return text;
}

report::Table index_table(const std::vector<Overlay>& overlays) {
  report::Table table{.title = "Indices",
                      .caption = "Statistics over time, from every accepted step. Angles also in arcseconds." +
                                 (!overlays.empty() && overlays.front().stated ? std::string(kStated) : "") +
                                 definitions(overlays),
                      .columns = {{"Motion"},
                                  {"Error"},
                                  {"Maximum"},
                                  {"at", "s"},
                                  {"RMS"},
                                  {"Mean"},
                                  {"99.73 % below"},
                                  {"Maximum in arcseconds"}}};
  const bool one = overlays.size() == 1;
  if (one) table.columns.erase(table.columns.begin());
  for (const Overlay& overlay : overlays) {
    for (const QuantityName& quantity : quantity_names()) {
      if (quantity.kind == PointingQuantity::line_of_sight_error && !overlay.result->index.has_line_of_sight) continue;
      const Statistics& s = overlay.result->index.*quantity.statistics;
      const auto text = [&](double value, const char* statistic) {
        const std::string uncertainty =
            overlay.stated && *statistic != '\0' ? overlay.stated({quantity.name, statistic}) : "";
        return readable(value, quantity.si_unit) + (uncertainty.empty() ? "" : " " + in_one_line(uncertainty));
      };
      std::vector<nlohmann::json> row = {overlay.name,       quantity.title,       text(s.max, "max"), s.time_of_max,
                                         text(s.rms, "rms"), text(s.mean, "mean"), text(s.p9973, ""),  nullptr};
      if (std::string(quantity.si_unit) == "rad") row.back() = readable_arcsec(s.max);
      if (one) row.erase(row.begin());
      table.rows.push_back(std::move(row));
    }
  }
  return table;
}

report::Table contact_table(const std::vector<Overlay>& overlays) {
  report::Table table{.title = "Contacts",
                      .caption =
                          "An impact is a contact begun. Contact laws hold up to the speed in the last column but one "
                          "(Love 1944; Sun et al., Eq. 26); faster impacts are counted.",
                      .columns = {{"Motion"},
                                  {"Joint"},
                                  {"In contact", "%"},
                                  {"Impacts"},
                                  {"Deepest penetration", "µm"},
                                  {"Largest force of one contact", "kN"},
                                  {"Largest load", "kN"},
                                  {"Fastest impact", "mm/s"},
                                  {"Valid up to", "mm/s"},
                                  {"Faster than valid"}}};
  const bool one = overlays.size() == 1;
  if (one) table.columns.erase(table.columns.begin());
  for (const Overlay& overlay : overlays) {
    for (const ContactSummary& c : overlay.result->contact) {
      std::vector<nlohmann::json> row = {overlay.name,
                                         c.joint,
                                         100.0 * c.contact_fraction,
                                         c.impacts,
                                         1e6 * c.max_penetration,
                                         1e-3 * c.max_force,
                                         1e-3 * c.max_load,
                                         1e3 * c.max_impact_speed,
                                         1e3 * c.validity_speed,
                                         c.impact_speed_above_validity};
      if (one) row.erase(row.begin());
      table.rows.push_back(std::move(row));
    }
  }
  return table;
}

namespace {

JointType type_of(const Mechanism& mechanism, int clearance) {
  const MechanismDescription& m = mechanism.description();
  return m.joints[m.clearances[clearance].joint].type;
}

}  // namespace

bool is_ball(const Mechanism& mechanism, int clearance) {
  return type_of(mechanism, clearance) == JointType::spherical;
}
bool is_pad(const Mechanism& mechanism, int clearance) { return type_of(mechanism, clearance) == JointType::planar; }
bool may_tilt(const Mechanism& mechanism, int clearance) {
  return mechanism.description().clearances[static_cast<std::size_t>(clearance)].axes == JournalAxes::free;
}
bool is_slider(const Mechanism& mechanism, int clearance) {
  return mechanism.description().clearances[static_cast<std::size_t>(clearance)].guide == GuideShape::rectangular;
}

report::Chart orbit_chart(const std::string& joint, bool ball, bool tilts, double radial_clearance,
                          const RunResult& result, std::size_t clearance) {
  const DisplayUnit unit = display_unit("m", radial_clearance);
  report::Chart chart{
      .title = joint + (ball ? ": ball in socket" : ": journal in sleeve"),
      .caption = ball ? "Path of the ball's centre, seen along y of the socket. Contact begins at a sphere, of which "
                        "the circle is the outline."
                      : std::string("Path of the journal's centre seen along the joint's axis. ") +
                            (tilts ? "At the circle contact begins where the axes are parallel. A tilted journal "
                                     "touches at an end of the sleeve while its centre is still within."
                                   : "Contact begins at the circle."),
      .x = {ball ? "x of the socket" : "x of the sleeve", unit.name},
      .y = {ball ? "z of the socket" : "z of the sleeve", unit.name},
      .equal_axes = true};
  // Every point of a path matters, so it is cut down evenly; 4000 points draw a second of motion.
  const auto& samples = result.clearances[clearance];
  const std::size_t stride = std::max<std::size_t>(1, samples.size() / 4000);
  std::vector<double> x, z;
  for (std::size_t i = 0; i < samples.size(); i += stride) {
    x.push_back(samples[i].offset.x() * unit.per_si);
    z.push_back(samples[i].offset.z() * unit.per_si);
  }
  chart.series.push_back({.name = ball ? "ball's centre" : "journal centre", .x = x, .y = z});
  if (!x.empty())
    chart.series.push_back({.name = "start",
                            .x = report::Numbers{x.front()},
                            .y = report::Numbers{z.front()},
                            .style = report::Style::markers});
  chart.circles.push_back(
      {.r = radial_clearance * unit.per_si, .label = "clearance " + readable(radial_clearance, "m")});
  return chart;
}

report::Strip contact_strip(const Mechanism& mechanism, const RunResult& result) {
  const PartsInPlay parts = parts_in_play(mechanism.description());
  bool balls = false, pads = false, journals = false, sliders = false;
  for (int c = 0; c < mechanism.clearances(); ++c)
    (is_ball(mechanism, c) ? balls : is_pad(mechanism, c) ? pads : is_slider(mechanism, c) ? sliders : journals) = true;
  const bool several = balls + pads + journals + sliders > 1;
  report::Strip strip{.title = "Contact state",
                      .caption = fmt::format("Where {} {} touches {} {}, sample by sample.", several ? "each" : "the",
                                             parts.insert, several ? "its" : "the", parts.seat),
                      .x = {"Time", "s"},
                      .states = {{"free", "free flight", true}}};
  std::string around;
  for (const auto& [there, seat] :
       {std::pair{journals, "bore"}, std::pair{balls, "socket"}, std::pair{sliders, "guide"}})
    if (there) around += (around.empty() ? "" : " or ") + std::string(seat);
  if (!around.empty()) strip.states.push_back({"radial", around});
  if (journals || pads)
    strip.states.push_back({"axial", !pads ? "end face" : journals ? "end face or face of the slot" : "face"});
  if (journals) strip.states.push_back({"both", "bore and end face"});
  static const char* const state[] = {"free", "radial", "axial", "both"};
  for (std::size_t c = 0; c < result.clearances.size(); ++c) {
    report::StripRow row{
        .name = joint_of_clearance(mechanism, static_cast<int>(c)), .start = {}, .end = {}, .state = {}};
    const auto& samples = result.clearances[c];
    for (std::size_t i = 0; i < samples.size(); ++i) {
      const int now = std::clamp(samples[i].contact, 0, 3);
      if (row.state.empty() || row.state.back() != state[now]) {
        if (!row.end.empty()) row.end.back() = result.time[i];
        row.start.push_back(result.time[i]);
        row.end.push_back(result.time[i]);
        row.state.emplace_back(state[now]);
      } else {
        row.end.back() = result.time[i];
      }
    }
    strip.rows.push_back(std::move(row));
  }
  return strip;
}

std::vector<report::Provenance> provenance_of(const Command& command, const Mechanism& mechanism,
                                              const RungChoice& rung) {
  std::string settings;
  for (const Setting& setting : command.settings)
    settings += (settings.empty() ? "" : ", ") + setting.path + " = " + setting.value;
  std::string assumed;
  for (const std::string& sentence : in_words(assumed_by(command, mechanism)))
    assumed += (assumed.empty() ? "" : "; ") + sentence;
  return {{"Program", std::string("boresight ") + BORESIGHT_VERSION},
          {"Verb", command.verb},
          {"File", command.file},
          {"Mechanism", mechanism.name()},
          {"Content hash", mechanism.description().content_hash},
          {"Settings", settings.empty() ? "none" : settings},
          {"Assumed", assumed.empty() ? "nothing that results hang on" : assumed},
          {"Rung", rung.name + ": " + rung.why},
          {"Data", "summary.json and the CSV tables beside this file, in SI with all digits"}};
}

}  // namespace boresight::app
