#include "verdict.hpp"

#include <regex>

namespace boresight::gauntlet {

Json to_json(const Verdict& v) {
  Json json = {{"scene", v.scene}, {"family", v.family}, {"compared", v.compared}, {"refused", v.refused}, {"cpu", v.cpu_seconds}};
  json["faults"] = json["refusals"] = json["claims"] = Json::array();
  for (const Fault& f : v.faults) json["faults"].push_back({f.kind, f.stage, f.text});
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
  for (const Json& f : json.at("faults")) v.faults.push_back({f[0], f[1], f[2]});
  for (const Json& r : json.at("refusals")) v.refusals.push_back({r[0], r[1]});
  for (const Json& c : json.at("claims")) v.claims.push_back({c[0], c[1], c[2].is_null() ? 0.0 : c[2].get<double>(), c[3].is_null() ? 0.0 : c[3].get<double>()});
  return v;
}

std::string normalised(std::string reason) {
  static const std::regex number(R"([-+]?[0-9][0-9.,]*(e[-+]?[0-9]+)?)"), quoted("\"[^\"]*\""),
      name(R"(\b(frame|motor|bearing|bar|j|crank|rod|slider|leg|platform|link|joint|body|[A-Z])#[a-z]?\b)"), unit(R"(# (ns|us|µs|ms|s|nm|um|µm|mm|m|N|kN|rad|deg)\b)");
  reason = std::regex_replace(reason, quoted, "\"..\"");
  reason = std::regex_replace(reason, number, "#");
  reason = std::regex_replace(reason, unit, "#");
  return std::regex_replace(reason, name, "NAME");
}

}  // namespace boresight::gauntlet
