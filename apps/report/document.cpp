#include "report/document.hpp"

#include <algorithm>
#include <cmath>

namespace boresight::report {
namespace {

using nlohmann::json;

// Optional keys are left out where they say nothing, so that documents stay small.
void set(json& object, const char* key, const std::string& text) {
  if (!text.empty()) object[key] = text;
}
void set(json& object, const char* key, bool flag) {
  if (flag) object[key] = true;
}
void set(json& object, const char* key, int number) {
  if (number != 0) object[key] = number;
}
template <typename T>
void set(json& object, const char* key, const std::vector<T>& list) {
  if (!list.empty()) object[key] = list;
}

json along(const Along& values) {
  return std::visit([](const auto& list) { return json(list); }, values);
}
bool empty(const Along& values) {
  return std::visit([](const auto& list) { return list.empty(); }, values);
}

}  // namespace

const char* to_string(Style style) {
  switch (style) {
    case Style::line:
      return "line";
    case Style::dash:
      return "dash";
    case Style::markers:
      return "markers";
    case Style::line_markers:
      return "line+markers";
    case Style::dash_markers:
      return "dash+markers";
    case Style::steps:
      return "steps";
    case Style::bars:
      return "bars";
    case Style::area:
      return "area";
    case Style::histogram:
      return "histogram";
    case Style::box:
      return "box";
  }
  return "line";
}

const char* to_string(Agreement agreement) {
  switch (agreement) {
    case Agreement::agrees:
      return "agrees";
    case Agreement::differs:
      return "differs";
    case Agreement::explained:
      return "explained";
  }
  return "agrees";
}

const char* to_string(Standing standing) {
  switch (standing) {
    case Standing::good:
      return "good";
    case Standing::bad:
      return "bad";
    case Standing::neutral:
      return "neutral";
  }
  return "neutral";
}

void to_json(json& json, const Axis& axis) {
  json = {{"label", axis.label}, {"unit", axis.unit}};
  set(json, "log", axis.log);
  if (axis.range) json["range"] = *axis.range;
}

void to_json(json& json, const Series& series) {
  json = {{"name", series.name}, {"style", to_string(series.style)}};
  json["x"] = along(series.x);
  if (series.style != Style::histogram || !empty(series.y)) json["y"] = along(series.y);
  set(json, "muted", series.muted);
  set(json, "hidden", series.hidden);
  set(json, "y_low", series.y_low);
  set(json, "error_low", series.error_low);
  set(json, "error_high", series.error_high);
  set(json, "text", series.text);
  set(json, "color", series.color);
  set(json, "bins", series.bins);
}

void to_json(json& json, const Circle& circle) {
  json = {{"x", circle.x}, {"y", circle.y}, {"r", circle.r}};
  set(json, "label", circle.label);
}

void to_json(json& json, const Line& line) {
  json = {{"axis", std::string(1, line.axis)}, {"value", line.value}};
  set(json, "label", line.label);
}

void to_json(json& json, const Heatmap& heatmap) {
  json = {{"z", heatmap.z}, {"label", heatmap.label}, {"unit", heatmap.unit}};
  json["x"] = along(heatmap.x);
  json["y"] = along(heatmap.y);
  set(json, "log", heatmap.log);
  set(json, "diverging", heatmap.diverging);
  set(json, "contours", heatmap.contours);
}

void to_json(json& json, const Chart& chart) {
  json = {{"kind", "chart"}, {"title", chart.title}, {"x", chart.x}, {"y", chart.y}};
  set(json, "caption", chart.caption);
  set(json, "equal_axes", chart.equal_axes);
  set(json, "height", chart.height);
  set(json, "series", chart.series);
  set(json, "circles", chart.circles);
  set(json, "lines", chart.lines);
  if (chart.heatmap) json["heatmap"] = *chart.heatmap;
}

void to_json(json& json, const Panels& panels) {
  json = {{"kind", "panels"},
          {"title", panels.title},
          {"columns", panels.columns},
          {"panels", panels.panels},
          {"legend", panels.shared_legend ? "shared" : "none"}};
  set(json, "caption", panels.caption);
}

void to_json(json& json, const Column& column) {
  json = {{"label", column.label}};
  set(json, "unit", column.unit);
  set(json, "align", column.align);
}

void to_json(json& json, const Table& table) {
  json = {{"kind", "table"}, {"title", table.title}, {"columns", table.columns}, {"rows", table.rows}};
  set(json, "caption", table.caption);
}

void to_json(json& json, const Text& text) { json = {{"kind", "text"}, {"text", text.text}}; }

void to_json(json& json, const Finding& finding) {
  json = {{"claim", finding.claim}, {"status", to_string(finding.status)}, {"measured", finding.measured}};
  set(json, "why", finding.why);
}

void to_json(json& json, const Findings& findings) {
  json = {{"kind", "findings"}, {"items", findings.items}};
  set(json, "title", findings.title);
  set(json, "caption", findings.caption);
}

void to_json(json& json, const State& state) {
  json = {{"name", state.name}};
  set(json, "label", state.label);
  set(json, "muted", state.muted);
}

void to_json(json& json, const StripRow& row) {
  json = {{"name", row.name}, {"start", row.start}, {"end", row.end}, {"state", row.state}};
}

void to_json(json& json, const Strip& strip) {
  json = {{"kind", "strip"}, {"title", strip.title}, {"x", strip.x}, {"states", strip.states}, {"rows", strip.rows}};
  set(json, "caption", strip.caption);
}

void to_json(json& json, const ViewPoint& point) {
  json = {{"x", point.x}, {"y", point.y}, {"z", point.z}};
  set(json, "dx", point.dx);
  set(json, "dy", point.dy);
  set(json, "dz", point.dz);
}

void to_json(json& json, const ViewBody& body) {
  json = {{"name", body.name}, {"points", body.points}};
  set(json, "closed", body.closed);
  set(json, "muted", body.muted);
}

void to_json(json& json, const ViewJoint& joint) {
  json = {{"name", joint.name}, {"first", joint.first}, {"second", joint.second}};
  if (joint.tip >= 0) json["tip"] = joint.tip;
  if (joint.second_tip >= 0) json["second_tip"] = joint.second_tip;
  if (joint.side >= 0) json["side"] = joint.side;
  if (joint.room >= 0) json["room"] = joint.room;
  if (!joint.clearance) return;
  const ViewClearance& play = *joint.clearance;
  json["clearance"] = {{"radial", play.radial}, {"axial", play.axial}};
  if (play.pad_width > 0.0)
    json["clearance"].update({{"pad_width", play.pad_width}, {"pad_length", play.pad_length}});
  else if (joint.side >= 0)
    json["clearance"].update({{"width", play.width}, {"height", play.height}});
  if (play.pad > 0.0) json["clearance"]["pad"] = play.pad;
}

void to_json(json& json, const ViewRay& ray) { json = {{"name", ray.name}, {"from", ray.from}, {"to", ray.to}}; }

void to_json(json& json, const View& view) {
  json = {{"kind", "view"},        {"title", view.title},   {"unit", view.unit}, {"time", view.time},
          {"points", view.points}, {"bodies", view.bodies}, {"rays", view.rays}, {"joints", view.joints}};
  set(json, "caption", view.caption);
}

void to_json(json& json, const Section& section) {
  json = {{"id", section.id}, {"title", section.title}, {"items", json::array()}};
  set(json, "intro", section.intro);
  for (const Item& item : section.items) {
    json["items"].push_back(std::visit([](const auto& one) { return nlohmann::json(one); }, item));
  }
}

void to_json(json& json, const Fact& fact) {
  json = {{"label", fact.label}, {"value", fact.value}};
  set(json, "unit", fact.unit);
  set(json, "note", fact.note);
}

void to_json(json& json, const Verdict& verdict) {
  json = {{"status", to_string(verdict.status)}, {"text", verdict.text}};
}

void to_json(json& json, const Provenance& provenance) {
  json = {{"label", provenance.label}, {"value", provenance.value}};
}

void to_json(json& json, const Document& document) {
  json = {{"title", document.title}, {"sections", document.sections}};
  set(json, "subtitle", document.subtitle);
  set(json, "verb", document.verb);
  if (document.verdict) json["verdict"] = *document.verdict;
  set(json, "facts", document.facts);
  set(json, "warnings", document.warnings);
  set(json, "provenance", document.provenance);
}

std::pair<Numbers, Numbers> thinned(const Numbers& x, const Numbers& y, std::size_t most) {
  const std::size_t length = std::min(x.size(), y.size());
  if (length <= most || most < 8) return {x, y};
  const std::size_t stretches = most / 4;  // each keeps at most four points
  std::pair<Numbers, Numbers> kept;
  const auto keep = [&](std::size_t i) {
    kept.first.push_back(x[i]);
    kept.second.push_back(y[i]);
  };
  for (std::size_t stretch = 0; stretch < stretches; ++stretch) {
    const std::size_t end = (stretch + 1) * length / stretches;
    for (std::size_t begin = stretch * length / stretches; begin < end;) {
      if (!std::isfinite(y[begin])) {  // one point stands for a whole gap
        keep(begin);
        while (begin < end && !std::isfinite(y[begin])) ++begin;
        continue;
      }
      std::size_t stop = begin, least = begin, greatest = begin;
      for (; stop < end && std::isfinite(y[stop]); ++stop) {
        if (y[stop] < y[least]) least = stop;
        if (y[stop] > y[greatest]) greatest = stop;
      }
      std::array<std::size_t, 4> points{begin, std::min(least, greatest), std::max(least, greatest), stop - 1};
      for (std::size_t k = 0; k < points.size(); ++k)
        if (k == 0 || points[k] != points[k - 1]) keep(points[k]);
      begin = stop;
    }
  }
  return kept;
}

int height_of_bars(std::size_t bars, int each) {
  constexpr std::size_t kAround = 140, kMost = 2000;  // title, axis and legend; what the contract allows
  return static_cast<int>(std::min(kMost, kAround + bars * static_cast<std::size_t>(each)));
}

}  // namespace boresight::report
