#include "boresight_analyses/runs/stored_pilot.hpp"

#include <cstdio>
#include <cstdlib>
#include <nlohmann/json.hpp>

namespace boresight {
namespace {

// One list of the fields for both ways. JSON has no infinities: numbers are words.
struct ToJson {
  nlohmann::json& json;
  void operator()(const char* key, double value) const {
    char text[40];
    std::snprintf(text, sizeof text, "%.17g", value);
    json[key] = text;
  }
  void operator()(const char* key, const std::string& value) const { json[key] = value; }
  void operator()(const char* key, bool value) const { json[key] = value; }
  void operator()(const char* key, int value) const { json[key] = value; }
  void operator()(const char* key, std::size_t value) const { json[key] = value; }
};

struct FromJson {
  const nlohmann::json& json;
  void operator()(const char* key, double& value) const {
    value = std::strtod(json.at(key).get<std::string>().c_str(), nullptr);
  }
  template <typename T>
  void operator()(const char* key, T& value) const {
    value = json.at(key).get<T>();
  }
};

template <typename Field, typename Trial>
void fields_of_trial(const Field& field, Trial& t) {
  field("rung", t.rung), field("step", t.step), field("integrator", t.integrator), field("tolerance", t.tolerance);
  field("lanes", t.lanes), field("value", t.value), field("error", t.error), field("difference", t.difference);
  field("estimate", t.estimate), field("cpu_seconds", t.cpu_seconds), field("pairs", t.pairs),
      field("refusal", t.refusal);
  field("accepted", t.accepted), field("reference", t.reference);
}

template <typename Field, typename Pilot>
void fields_of_pilot(const Field& field, Pilot& p) {
  field("accuracy", p.accuracy), field("geometry", p.geometry), field("index", p.index), field("unit", p.unit),
      field("reference", p.reference);
  field("reference_error", p.reference_error), field("scatter", p.scatter), field("pairs", p.pairs),
      field("chosen", p.chosen);
  field("met", p.met), field("cpu_seconds", p.cpu_seconds), field("why", p.why);
}

template <typename Field, typename Error>
void fields_of_error(const Field& field, Error& e) {
  field("probability", e.probability), field("error", e.error);
}

}  // namespace

std::string text_of(const PilotResult& pilot) {
  nlohmann::json json;
  fields_of_pilot(ToJson{json}, pilot);
  json["trials"] = json["errors"] = nlohmann::json::array();
  for (const PilotTrial& trial : pilot.trials) fields_of_trial(ToJson{json["trials"].emplace_back()}, trial);
  for (const PilotResult::ErrorOfStatistic& error : pilot.errors)
    fields_of_error(ToJson{json["errors"].emplace_back()}, error);
  return json.dump();
}

std::optional<PilotResult> pilot_of_text(const std::string& text) {
  try {
    const nlohmann::json json = nlohmann::json::parse(text);
    PilotResult pilot;
    fields_of_pilot(FromJson{json}, pilot);
    for (const nlohmann::json& trial : json.at("trials")) fields_of_trial(FromJson{trial}, pilot.trials.emplace_back());
    for (const nlohmann::json& error : json.at("errors")) fields_of_error(FromJson{error}, pilot.errors.emplace_back());
    if (pilot.chosen < -1 || pilot.chosen >= static_cast<int>(pilot.trials.size())) return {};
    return pilot;
  } catch (const std::exception&) {
    return {};
  }
}

}  // namespace boresight
