#include "run/parts_section.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <ostream>

#include "boresight/formulations/ideal_simulation.hpp"
#include "boresight/mechanism/error.hpp"
#include "boresight_analyses/study/overrun_play.hpp"
#include "report_parts/report_parts.hpp"
#include "results/tables.hpp"
#include "terminal/readable.hpp"

namespace boresight::app {
namespace {

// Curves that can be told apart by their colours, those of the others and of the rest among them.
constexpr std::size_t kCurves = 7;
constexpr std::size_t kLines = 5;  // on the terminal
// Rounding of the columns, in m or rad.
constexpr double kNoPart = 1e-13;
constexpr double kNoShare = 1e-9;

bool is_linear(const RunResult& result) { return result.rung != "multibody"; }

// What a motion is off by beside the parts; "": nothing but rounding.
std::string rest_name(const Mechanism& mechanism, const RunResult& result) {
  if (mechanism.clearances() == 0) return is_linear(result) ? "" : "second order";
  return is_linear(result) ? "play" : "second order and play";
}

// Without the "error." of its path.
std::string short_name(const ErrorPart& part) { return part.name.substr(part.name.find('.') + 1); }

using Size = std::function<double(const Vec6&, const PoseSample&)>;

double position_of(const Vec6& x, const PoseSample&) { return x.head<3>().norm(); }

// How far a displacement and turn of the body move what is looked at: its point, its axis, its line of sight.
std::vector<std::tuple<std::string, std::string, Size>> sizes(const Mechanism& mechanism) {
  const Pointing& pointing = mechanism.pointing();
  std::vector<std::tuple<std::string, std::string, Size>> all = {
      {"Position error", "m", position_of}, {"Boresight error", "rad", [&pointing](const Vec6& x, const PoseSample& s) {
                                               return Vec3(x.tail<3>()).cross(s.ideal.q * pointing.boresight_B).norm();
                                             }}};
  if (pointing.line_of_sight)
    all.emplace_back("Line-of-sight error", "rad", [&pointing](const Vec6& x, const PoseSample& s) {
      return (pointing.line_of_sight->gain(s.ideal) * x).norm();
    });
  return all;
}

report::Chart parts_chart(const std::string& title, const std::string& si_unit, const Size& size, const RunParts& parts,
                          const Mechanism& mechanism, const RunResult& result) {
  const std::vector<ErrorPart>& all = parts.found.parts;
  struct Curve {
    std::string name;
    std::vector<double> values;
    bool muted = false;
  };
  std::vector<Curve> curves;
  const auto add = [&](const std::string& name, bool muted, const std::function<Vec6(std::size_t)>& at) {
    curves.push_back({.name = name, .values = {}, .muted = muted});
    for (std::size_t k = 0; k < result.time.size(); ++k)
      curves.back().values.push_back(size(at(k), result.boresight.samples[k]));
  };
  // One that would stand for a single other is that one itself.
  const std::size_t shown = all.size() <= kCurves ? all.size() : kCurves - 1;
  for (std::size_t i = 0; i < shown; ++i)
    add(short_name(all[i]), false, [&all, i](std::size_t k) { return all[i].poses[k]; });
  if (shown < all.size())
    add(fmt::format("{} others together", all.size() - shown), false, [&all, shown](std::size_t k) {
      Vec6 sum = Vec6::Zero();
      for (std::size_t i = shown; i < all.size(); ++i) sum += all[i].poses[k];
      return sum;
    });
  if (const std::string rest = rest_name(mechanism, result); !rest.empty())
    add(rest, true, [&](std::size_t k) { return parts.found.rest.poses[k]; });
  double most = 0.0;
  for (const Curve& c : curves)
    for (const double value : c.values) most = std::max(most, value);
  const DisplayUnit unit = display_unit(si_unit, most);
  report::Chart chart{.title = title, .caption = {}, .x = {"Time", "s"}, .y = {"part", unit.name}};
  for (const Curve& c : curves) {
    chart.series.push_back(curve(c.name, result.time, c.values, unit.per_si));
    chart.series.back().muted = c.muted;
  }
  return chart;
}

report::Table parts_table(const RunParts& parts, const Mechanism& mechanism, const RunResult& result) {
  const ErrorParts& found = parts.found;
  double furthest = 0.0, most_turned = 0.0;
  for (const ErrorPart& part : found.parts) {
    furthest = std::max(furthest, part.index.position_error.max);
    most_turned = std::max(most_turned, part.index.boresight_error.max);
  }
  const DisplayUnit length = display_unit("m", furthest), angle = display_unit("rad", most_turned);
  report::Table table{.title = "The part of each error",
                      .caption =
                          "What each error alone does over the motion, to first order, the largest first. The share is "
                          "that of the mean "
                          "square: shares add up to all of it, and are negative where a part cancels others.",
                      .columns = {{"Error"},
                                  {"Value"},
                                  {"Position, max", length.name},
                                  {"Position, RMS", length.name},
                                  {"Share", "%"},
                                  {"Boresight, max", angle.name},
                                  {"Boresight, RMS", angle.name},
                                  {"Share", "%"}}};
  const auto row = [&](const std::string& name, const std::string& value, const ErrorPart& part) {
    const auto shown = [](double si, const DisplayUnit& unit) { return si > kNoPart ? si * unit.per_si : 0.0; };
    const auto share = [](double of_one) { return std::abs(of_one) > kNoShare ? 100.0 * of_one : 0.0; };
    const PointingIndices& index = part.index;
    table.rows.push_back({name, value, shown(index.position_error.max, length), shown(index.position_error.rms, length),
                          share(part.position_share), shown(index.boresight_error.max, angle),
                          shown(index.boresight_error.rms, angle), share(part.boresight_share)});
  };
  for (const ErrorPart& part : found.parts) row(short_name(part), readable_of_error(part.value, part.unit), part);
  const std::string rest = rest_name(mechanism, result);
  if (!rest.empty() && !found.rest.poses.empty()) row(rest, "", found.rest);
  return table;
}

}  // namespace

std::optional<RunParts> run_parts(const Mechanism& mechanism, const RunResult& result) {
  const std::vector<double>& errors = mechanism.parameters().error;
  if (std::all_of(errors.begin(), errors.end(), [](double value) { return value == 0.0; })) return {};
  RunParts parts;
  try {
    parts.overrun = overrun_plays(mechanism, mechanism.parameters(), ideal_motion(mechanism, mechanism.parameters()));
    parts.found = parts_of_errors(mechanism, mechanism.parameters(), result);
  } catch (const ComputationError& failure) {
    parts.refusal = failure.what();
  }
  return parts;
}

report::Section parts_section(const RunParts& parts, const Mechanism& mechanism, const RunResult& result) {
  report::Section section{.id = "parts", .title = "Parts of the standing errors"};
  if (!parts.refusal.empty()) {
    section.intro = "The errors cannot be told apart here: " + parts.refusal + ".";
    return section;
  }
  const std::string rest = rest_name(mechanism, result);
  section.intro =
      "Each error moves the pose by its column of influence times its value; these parts are of first order and add "
      "up. ";
  if (!is_linear(result))
    section.intro += "The motion itself was computed without that simplification: " + std::string("\"") + rest +
                     "\" is what it is off by beside the sum of the parts.";
  else if (!rest.empty())
    section.intro += "\"Play\" is what the motion is off by beside their sum.";
  else
    section.intro += "Without clearance their sum is the whole error of this rung.";
  for (const std::string& why : parts.found.without_part)
    section.items.push_back(report::Text{"No part: " + why + "."});
  if (parts.found.parts.empty()) return section;
  section.items.push_back(parts_table(parts, mechanism, result));
  if (result.time.size() < 2) return section;
  report::Panels panels{.title = "Parts over time",
                        .caption =
                            "The size of each part by itself. Parts add up as vectors, so sizes may add up to more "
                            "than the error. Components along each axis are in parts.csv.",
                        .columns = 2};
  for (const auto& [title, unit, size] : sizes(mechanism))
    panels.panels.push_back(parts_chart(title, unit, size, parts, mechanism, result));
  section.items.push_back(std::move(panels));
  return section;
}

std::vector<std::string> parts_lines(const RunParts& parts) {
  std::vector<std::string> lines;
  if (!parts.refusal.empty()) return {"the parts of the errors are not known: " + parts.refusal};
  for (const std::string& why : parts.found.without_part) lines.push_back("no part: " + why);
  const std::vector<ErrorPart>& all = parts.found.parts;
  const auto up_to = [](double value, const char* unit) {
    return value > kNoPart ? "up to " + readable(value, unit) : std::string("nothing");
  };
  for (std::size_t i = 0; i < std::min(kLines, all.size()); ++i)
    lines.push_back(
        fmt::format("{} of {}: position {}, boresight {}", all[i].name, readable_of_error(all[i].value, all[i].unit),
                    up_to(all[i].index.position_error.max, "m"), up_to(all[i].index.boresight_error.max, "rad")));
  if (all.size() > kLines)
    lines.push_back(fmt::format("and {} more errors; the report has them all", all.size() - kLines));
  return lines;
}

Json parts_json(const RunParts& parts) {
  if (!parts.refusal.empty()) return {{"refused", parts.refusal}};
  const auto one = [](const ErrorPart& part) -> Json {
    return {{"index", index_json(part.index)},
            {"position_share", part.position_share},
            {"boresight_share", part.boresight_share}};
  };
  Json json = {{"errors", Json::object()}, {"rest", one(parts.found.rest)}, {"without_part", parts.found.without_part}};
  for (const ErrorPart& part : parts.found.parts) {
    json["errors"][part.name] = one(part);
    json["errors"][part.name]["value"] = part.value;
  }
  return json;
}

void write_parts(std::ostream& out, const RunParts& parts, const RunResult& result, std::size_t every) {
  std::vector<const ErrorPart*> all;
  for (const ErrorPart& part : parts.found.parts) all.push_back(&part);
  if (parts.refusal.empty()) all.push_back(&parts.found.rest);
  std::string row = "t";
  for (const ErrorPart* part : all)
    for (const char* column : {"dx", "dy", "dz", "rx", "ry", "rz"}) row += "," + csv_field(part->name + "." + column);
  out << row << '\n';
  if (all.empty()) return;
  for (std::size_t k = 0; k < result.time.size(); ++k) {
    if (k % every != 0 && k + 1 != result.time.size()) continue;
    row = exact(result.time[k]);
    for (const ErrorPart* part : all)
      for (const double value : part->poses[k]) row += "," + exact(value);
    out << row << '\n';
  }
}

}  // namespace boresight::app
