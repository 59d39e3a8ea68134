#include "pilot_parts.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "readable.hpp"

namespace boresight::app {
namespace {

std::string way_of(const PilotTrial& t) { return t.integrator.empty() ? t.rung : t.rung + ", " + t.integrator; }

std::string fineness_of(const PilotTrial& t) {
  if (t.tolerance > 0.0) return fmt::format("tolerance {:.0e}", t.tolerance);
  return t.step > 0.0 ? "h = " + readable(t.step, "s") : "no steps";
}

}  // namespace

nlohmann::ordered_json pilot_json(const PilotResult& pilot) {
  nlohmann::ordered_json json;
  json["accuracy"] = pilot.accuracy;
  json["index"] = pilot.index;
  json["reference"] = pilot.reference;
  json["reference_error"] = pilot.reference_error;
  json["met"] = pilot.met;
  json["cpu_seconds"] = pilot.cpu_seconds;
  json["trials"] = nlohmann::ordered_json::array();
  for (std::size_t k = 0; k < pilot.trials.size(); ++k) {
    const PilotTrial& t = pilot.trials[k];
    nlohmann::ordered_json trial = {{"rung", t.rung}, {"step", t.step}};
    if (!t.integrator.empty()) trial.update({{"integrator", t.integrator}, {"tolerance", t.tolerance}});
    if (t.refusal.empty()) {
      trial["value"] = t.value;
      trial["error"] = t.error;
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

report::Section pilot_section(const PilotResult& pilot) {
  report::Section section{.id = "pilot", .title = "How the rung was chosen", .items = {}};
  section.items.push_back(report::Text{
      fmt::format("Asked for: {} within {}. The pilot ran the rungs at neighbouring steps, held them against multibody at half "
                  "its own step (good to {}), and took {}.",
                  pilot.index, readable_share(pilot.accuracy), readable_share(pilot.reference_error), pilot.why)});
  report::Chart chart{.title = "Accuracy against speed",
                      .caption = "Each mark is a rung at one step or tolerance; down and left is better. Steps grow to the left.",
                      .x = {"CPU of one run", "ms", true},
                      .y = {"error of the index", "%", true}};
  std::vector<std::string> names;
  for (const PilotTrial& t : pilot.trials)
    if (std::find(names.begin(), names.end(), way_of(t)) == names.end()) names.push_back(way_of(t));
  for (const std::string& name : names) {
    report::Series series{.name = name, .style = report::Style::line_markers};
    report::Numbers x, y;
    for (const PilotTrial& t : pilot.trials) {
      if (way_of(t) != name || !t.refusal.empty()) continue;
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

  report::Table table{.title = "Tried",
                      .caption = "The error includes half the scatter of single runs. A rung's own estimate is what it says "
                                 "before anything has checked it.",
                      .columns = {{"Rung"}, {"Fineness"}, {"Error", "%"}, {"Own estimate", "%"}, {"CPU", "ms"}, {"Outcome"}}};
  for (std::size_t k = 0; k < pilot.trials.size(); ++k) {
    const PilotTrial& t = pilot.trials[k];
    const bool chosen = static_cast<int>(k) == pilot.chosen;
    const char* missed = t.reference ? "the reference, at its own step" : "not accurate enough";
    if (!t.refusal.empty()) {
      table.rows.push_back({way_of(t), fineness_of(t), nullptr, nullptr, nullptr,
                            "refused: " + t.refusal});
      continue;
    }
    table.rows.push_back({way_of(t), fineness_of(t), 100.0 * t.error,
                          100.0 * t.estimate, 1e3 * t.cpu_seconds,
                          chosen ? (pilot.met ? "taken" : "taken: the nearest there is") : missed});
  }
  section.items.push_back(std::move(table));
  return section;
}

}  // namespace boresight::app
