#include "results/summary.hpp"

#include <fmt/format.h>

#include <ctime>
#include <ostream>

#include "boresight_analyses/study/index_choice.hpp"
#include "results/assumed.hpp"
#include "results/pilot_parts.hpp"
#include "terminal/work_line.hpp"

namespace boresight::app {
namespace {

double process_cpu_seconds() {
  timespec time = {};
  ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

}  // namespace

Stopwatch::Stopwatch() : wall_(std::chrono::steady_clock::now()), cpu_(process_cpu_seconds()) {}
double Stopwatch::wall_seconds() const {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - wall_).count();
}
double Stopwatch::cpu_seconds() const { return process_cpu_seconds() - cpu_; }

Json common_summary(const Command& command, const Mechanism& mechanism, const RungChoice& rung, const Stopwatch& watch,
                    const std::vector<std::string>& warnings, bool interrupted, const OutputDirectory& out) {
  Json json;
  json["verb"] = command.verb;
  json["mechanism"] = {{"name", mechanism.name()},
                       {"hash", mechanism.description().content_hash},
                       {"file", mechanism.description().origin.file}};
  json["version"] = BORESIGHT_VERSION;
  json["rung"] = rung.name;
  json["rung_why"] = rung.why;
  if (rung.pilot) json["pilot"] = pilot_json(*rung.pilot);
  json["seed"] = nullptr;  // nothing here is random
  json["cpu_seconds"] = watch.cpu_seconds();
  json["wall_seconds"] = watch.wall_seconds();
  json["interrupted"] = interrupted;
  const std::vector<AssumedValue> assumed = assumed_by(command, mechanism);
  std::vector<std::string> all_warnings = warnings;
  for (const std::string& sentence : material_warnings(assumed)) all_warnings.push_back(sentence);
  json["warnings"] = all_warnings;
  json["assumed"] = Json::parse(assumed_json(assumed).dump());
  json["definitions"] = definitions_json(mechanism.pointing().line_of_sight.has_value());
  json["identity"] = Json::parse(out.identity().dump());
  return json;
}

Json statistics_json(const Statistics& s) {
  Json json;
  for (const StatisticName& statistic : statistic_names()) json[statistic.name] = s.*statistic.value;
  json["time_of_max"] = s.time_of_max;
  return json;
}

Json index_json(const PointingIndices& index) {
  Json json;
  for (const QuantityName& quantity : quantity_names())
    if (quantity.kind != PointingQuantity::line_of_sight_error || index.has_line_of_sight)
      json[quantity.name] = statistics_json(index.*quantity.statistics);
  return json;
}

Json definitions_json(bool has_line_of_sight) {
  Json json;
  for (const QuantityName& quantity : quantity_names())
    if (quantity.kind != PointingQuantity::line_of_sight_error || has_line_of_sight)
      json[quantity.name] = quantity.definition;
  for (const StatisticName& statistic : statistic_names()) json[statistic.name] = statistic.definition;
  return json;
}

Json contact_json(const std::vector<ContactSummary>& contact) {
  Json json = Json::object();
  for (const ContactSummary& c : contact) {
    json[c.joint] = {{"contact_fraction", c.contact_fraction},
                     {"impacts", c.impacts},
                     {"max_penetration", c.max_penetration},
                     {"max_force", c.max_force},
                     {"max_load", c.max_load},
                     {"max_impact_speed", c.max_impact_speed},
                     {"validity_speed", c.validity_speed},
                     {"impact_speed_above_validity", c.impact_speed_above_validity}};
  }
  return json;
}

Json vector_json(const Vec3& v) { return {v.x(), v.y(), v.z()}; }

namespace {
std::filesystem::path& summary_written() {
  static std::filesystem::path path;
  return path;
}
}  // namespace

const std::filesystem::path& last_summary() { return summary_written(); }
void forget_summary() { summary_written().clear(); }

void write_json(const OutputDirectory& out, const std::string& name, const Json& json) {
  clear_work_line();  // whatever is printed now stands on a line of its own
  if (name == "summary.json") summary_written() = out.path() / name;
  // Beside those that JSON escapes itself, control characters that a terminal would heed.
  std::string text;
  const std::string plain = json.dump(2, ' ', false, Json::error_handler_t::replace);
  for (std::size_t k = 0; k < plain.size(); ++k) {
    const auto byte = static_cast<unsigned char>(plain[k]), next = static_cast<unsigned char>(plain[k + 1]);
    if (byte == 0x7f) {
      text += "\\u007f";
    } else if (byte == 0xc2 && next >= 0x80 && next < 0xa0) {
      text += fmt::format("\\u{:04x}", next);
      ++k;
    } else {
      text += plain[k];
    }
  }
  out.write(name, [&](std::ostream& stream) { stream << text << '\n'; });
}

void announce_begun(const OutputDirectory& out, const std::string& verb, const std::string& warning) {
  if (std::filesystem::exists(out.path() / "summary.json")) return;
  write_json(out, "summary.json",
             {{"verb", verb},
              {"version", BORESIGHT_VERSION},
              {"interrupted", true},
              {"warnings", {warning}},
              {"identity", Json::parse(out.identity().dump())}});
  out.publish();
}

}  // namespace boresight::app
