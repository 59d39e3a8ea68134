#include "results/pilot_parts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "results/scatter_parts.hpp"
#include "terminal/readable.hpp"

namespace boresight::app {
namespace {

std::string way_of(const PilotTrial& t) {
  return t.rung + (t.lanes ? ", lanes" : t.integrator.empty() ? "" : ", " + t.integrator);
}

std::string fineness_of(const PilotTrial& t) {
  if (t.tolerance > 0.0) return fmt::format("tolerance {:.0e}", t.tolerance);
  return t.step > 0.0 ? "h = " + readable(t.step, "s") : "no steps";
}

}  // namespace

nlohmann::ordered_json pilot_json(const PilotResult& pilot) {
  nlohmann::ordered_json json;
  json["accuracy"] = pilot.accuracy;
  if (pilot.geometry) json["geometry"] = true;
  json["index"] = pilot.index;
  json["reference"] = pilot.reference;
  json["reference_error"] = number_json(pilot.reference_error);
  if (pilot.pairs > 0) json["pairs"] = pilot.pairs;
  if (pilot.scatter > 0.0) json["scatter"] = pilot.scatter;
  json["met"] = pilot.met;
  json["cpu_seconds"] = pilot.cpu_seconds;
  json["trials"] = nlohmann::ordered_json::array();
  for (std::size_t k = 0; k < pilot.trials.size(); ++k) {
    const PilotTrial& t = pilot.trials[k];
    nlohmann::ordered_json trial = {{"rung", t.rung}, {"step", t.step}};
    if (!t.integrator.empty()) trial["integrator"] = t.integrator;
    if (t.lanes) trial["lanes"] = true;
    if (t.tolerance > 0.0) trial["tolerance"] = t.tolerance;
    if (t.refusal.empty()) {
      trial["value"] = t.value;
      trial["error"] = number_json(t.error);
      trial["difference"] = t.difference;
      trial["own_estimate"] = t.estimate;
      trial["cpu_seconds"] = t.cpu_seconds;
    } else {
      trial["refused"] = t.refusal;
    }
    trial["chosen"] = static_cast<int>(k) == pilot.chosen;
    json["trials"].push_back(trial);
  }
  return json;
}

namespace {

report::Table tried_table(const PilotResult& pilot) {
  report::Table table{
      .title = "Tried",
      .caption = pilot.geometry
                     ? "The error holds with 95 % confidence. A rung's own estimate is of what is not linear in the "
                       "errors, before anything has checked it."
                     : "The error holds with 95 % confidence, what impacts scatter included. A rung's own "
                       "estimate is of what it leaves out, before anything has checked it.",
      .columns = {{"Rung"}, {"Fineness"}, {"Error", "%"}, {"Own estimate", "%"}, {"CPU", "ms"}, {"Outcome"}}};
  for (std::size_t k = 0; k < pilot.trials.size(); ++k) {
    const PilotTrial& t = pilot.trials[k];
    const bool chosen = static_cast<int>(k) == pilot.chosen;
    const char* missed = t.reference  ? (pilot.geometry ? "the reference: exact" : "the reference, at its own step")
                         : t.accepted ? "accurate enough, not cheapest"
                                      : "not accurate enough";
    if (!t.refusal.empty()) {
      table.rows.push_back({way_of(t), fineness_of(t), nullptr, nullptr, nullptr, "refused: " + t.refusal});
      continue;
    }
    table.rows.push_back({way_of(t), fineness_of(t), error_cell(t.error), error_cell(t.estimate), 1e3 * t.cpu_seconds,
                          chosen ? (pilot.met ? "taken" : "taken, not shown") : missed});
  }
  return table;
}

}  // namespace

report::Section pilot_section(const PilotResult& pilot) {
  report::Section section{.id = "pilot", .title = "How the rung was chosen", .items = {}};
  if (pilot.geometry) {
    section.items.push_back(report::Text{fmt::format(
        "Asked for: {} within {}. No joint has play, so the mechanism's geometry says all: envelope, quasistatic and "
        "perturbation add up what each error does to the pose, and multibody closes the joints of the built mechanism "
        "exactly. The pilot computed {} both ways, in {} of CPU. Of the choice: {}.",
        pilot.index, readable_share(pilot.accuracy),
        pilot.pairs > 0 ? fmt::format("{} samples of the scatter", pilot.pairs) : "the motion",
        readable(pilot.cpu_seconds, "s"), pilot.why)});
    section.items.push_back(tried_table(pilot));
    return section;
  }
  section.items.push_back(report::Text{fmt::format(
      "Asked for: {} within {}. The pilot {}, held them against multibody at half its own step (good to {}, with "
      "95 % confidence), in {} of CPU. Of the choice: {}.",
      pilot.index, readable_share(pilot.accuracy),
      pilot.pairs > 0 ? fmt::format("computed {} samples of the scatter in every way", pilot.pairs)
                      : "ran the rungs at neighbouring steps",
      readable_error(pilot.reference_error), readable(pilot.cpu_seconds, "s"), pilot.why)});
  report::Chart chart{
      .title = "Accuracy against speed",
      .caption =
          "Each mark is a rung at one step or tolerance, with 95 % confidence; down and left is better. Steps "
          "grow to the left.",
      .x = {"CPU of one run", "ms", true},
      .y = {"error of the index", "%", true}};
  std::vector<std::string> names;
  for (const PilotTrial& t : pilot.trials)
    if (std::find(names.begin(), names.end(), way_of(t)) == names.end()) names.push_back(way_of(t));
  for (const std::string& name : names) {
    report::Series series{.name = name, .style = report::Style::line_markers};
    report::Numbers x, y;
    for (const PilotTrial& t : pilot.trials) {
      if (way_of(t) != name || !t.refusal.empty() || !std::isfinite(t.error)) continue;
      x.push_back(1e3 * t.cpu_seconds);
      y.push_back(100.0 * std::max(t.error, 1e-5));
      series.text.push_back(fineness_of(t));
    }
    if (x.empty()) continue;
    series.x = std::move(x);
    series.y = std::move(y);
    chart.series.push_back(std::move(series));
  }
  chart.lines = {{'y', 100.0 * pilot.accuracy, "asked for"}};
  if (pilot.reference_error > 0.0) chart.lines.push_back({'y', 100.0 * pilot.reference_error, "the reference's own"});
  section.items.push_back(std::move(chart));

  section.items.push_back(tried_table(pilot));
  return section;
}

}  // namespace boresight::app
