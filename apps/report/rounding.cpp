#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

#include "report/contract.hpp"
#include "report/place.hpp"

namespace boresight::report {
namespace {

using checks::json, checks::Words;

double round_to(double value, int digits) {
  char buffer[48];
  const auto end = std::to_chars(buffer, buffer + sizeof buffer, value, std::chars_format::scientific, digits - 1).ptr;
  double result = value;
  std::from_chars(buffer, end, result);
  return result;
}

void round_numbers(json& list) {
  double least = std::numeric_limits<double>::infinity(), most = -least, size = 0.0;
  for (const json& entry : list) {
    if (!entry.is_number()) continue;
    const double number = entry.get<double>();
    if (!std::isfinite(number)) continue;
    least = std::min(least, number);
    most = std::max(most, number);
    size = std::max(size, std::abs(number));
  }
  int digits = 7;
  const double span = most - least;
  if (span > 0.0 && span < 1e-3 * size)
    digits = std::min(17, digits + static_cast<int>(std::ceil(std::log10(size / span))));
  for (json& entry : list) {
    if (!entry.is_number_float()) continue;
    const double number = entry.get<double>();
    if (!std::isfinite(number))
      entry = nullptr;
    else
      entry = round_to(number, digits);
  }
}

void round_lists(json& object, Words keys) {
  for (const char* key : keys)
    if (object.contains(key)) round_numbers(object[key]);
}

// Of a picture five digits of its extent are more than anyone sees, wherever the drawing lies; deviations have digits of their own.
double extent_of(const json& points) {
  double extent = 0.0;
  for (const char* key : {"x", "y", "z"}) {
    double least = std::numeric_limits<double>::infinity(), most = -least;
    for (const json& point : points) {
      if (!point.contains(key)) continue;
      for (const json& entry : point[key]) {
        least = std::min(least, entry.get<double>());
        most = std::max(most, entry.get<double>());
      }
    }
    if (most > least) extent = std::max(extent, most - least);
  }
  return extent;
}

void round_to_share(json& list, double size) {
  if (!(size > 0.0)) return;
  const double unit = std::pow(10.0, std::floor(std::log10(size)) - 4.0);
  for (json& entry : list) {
    const double steps = std::round(entry.get<double>() / unit);
    const double digits = std::abs(steps) >= 1.0 ? std::floor(std::log10(std::abs(steps))) + 2.0 : 2.0;
    entry = round_to(steps * unit, std::clamp(static_cast<int>(digits), 6, 17));
  }
}

void round_track(json& point, double extent) {
  for (const char* key : {"x", "y", "z"})
    if (point.contains(key)) round_to_share(point[key], extent);
  for (const char* key : {"dx", "dy", "dz"}) {
    if (!point.contains(key)) continue;
    double size = 0.0;
    for (const json& entry : point[key]) size = std::max(size, std::abs(entry.get<double>()));
    round_to_share(point[key], size);
  }
}

void round_item(json& item) {
  if (item["kind"] == "panels") {
    for (json& panel : item["panels"]) round_item(panel);
  } else if (item["kind"] == "strip") {
    for (json& row : item["rows"]) round_lists(row, {"start", "end"});
  } else if (item["kind"] == "view") {
    const double extent = extent_of(item["points"]);
    for (json& point : item["points"]) round_track(point, extent);
  } else if (item["kind"] == "chart") {
    if (item.contains("series")) {
      for (json& one : item["series"]) round_lists(one, {"x", "y", "y_low", "error_low", "error_high"});
    }
    if (!item.contains("heatmap")) return;
    round_lists(item["heatmap"], {"x", "y"});
    for (json& row : item["heatmap"]["z"]) round_numbers(row);
  }
}

}  // namespace

json rounded(const json& document) {
  json result = document;
  for (json& section : result["sections"]) {
    for (json& item : section["items"]) round_item(item);
  }
  return result;
}

}  // namespace boresight::report
