#include "verdict.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <regex>
#include <sstream>
#include <stdexcept>

namespace boresight::gauntlet {

Json to_json(const Verdict& v) {
  Json json = {{"scene", v.scene},
               {"family", v.family},
               {"compared", v.compared},
               {"refused", v.refused},
               {"cpu", v.cpu_seconds}};
  json["faults"] = json["refusals"] = json["claims"] = Json::array();
  for (const Fault& f : v.faults) json["faults"].push_back({f.kind, f.stage, f.text, f.unclaimed});
  for (const Refusal& r : v.refusals) json["refusals"].push_back({r.stage, r.reason});
  for (const Claim& c : v.claims) json["claims"].push_back({c.stage, c.figure, c.actual, c.stated});
  return json;
}

Verdict verdict_from(const Json& json) {
  Verdict v;
  v.scene = json.at("scene");
  v.family = json.at("family");
  v.compared = json.at("compared");
  v.refused = json.at("refused");
  v.cpu_seconds = json.at("cpu");
  for (const Json& f : json.at("faults"))
    v.faults.push_back({.unclaimed = f[3], .kind = f[0], .stage = f[1], .text = f[2]});
  for (const Json& r : json.at("refusals")) v.refusals.push_back({r[0], r[1]});
  for (const Json& c : json.at("claims"))
    v.claims.push_back(
        {c[0], c[1], c[2].is_null() ? 0.0 : c[2].get<double>(), c[3].is_null() ? 0.0 : c[3].get<double>()});
  return v;
}

bool has_new_fault(const Verdict& v) {
  return std::any_of(v.faults.begin(), v.faults.end(), [](const Fault& f) { return !f.known; });
}

KnownFaults::KnownFaults(const std::string& file) {
  std::ifstream in(file);
  if (!in) throw std::runtime_error("cannot read " + file);
  for (std::string line; std::getline(in, line);) {
    if (line.empty() || line[0] == '#') continue;
    std::stringstream cells(line);
    Entry entry;
    for (std::string* cell : {&entry.scene, &entry.kind, &entry.stage}) {
      std::getline(cells, *cell, '|');
      cell->erase(0, cell->find_first_not_of(' '));
      cell->erase(cell->find_last_not_of(' ') + 1);
    }
    entries_.push_back(entry);
  }
}

void KnownFaults::mark(Verdict& v) {
  const std::string scene = v.scene.rfind("seed ", 0) == 0 ? v.scene : std::filesystem::path(v.scene).stem().string();
  for (const Entry& e : entries_) {
    if (e.scene != scene) continue;
    bool met = false;
    for (Fault& f : v.faults)
      if (f.kind == e.kind && f.stage == e.stage) met = f.known = true;
    if (!met) gone_.push_back(e.scene + " | " + e.kind + " | " + e.stage);
  }
}

std::string normalised(std::string reason) {
  static const std::regex number(R"([-+]?[0-9][0-9.,]*(e[-+]?[0-9]+)?)"), quoted("\"[^\"]*\""),
      name(R"(\b(frame|motor|bearing|bar|j|crank|rod|slider|leg|platform|link|joint|body|[A-Z])#[a-z]?\b)"),
      unit(R"(# (ns|us|µs|ms|s|nm|um|µm|mm|m|N|kN|rad|deg)\b)");
  reason = std::regex_replace(reason, quoted, "\"..\"");
  reason = std::regex_replace(reason, number, "#");
  reason = std::regex_replace(reason, unit, "#");
  return std::regex_replace(reason, name, "NAME");
}

}  // namespace boresight::gauntlet
