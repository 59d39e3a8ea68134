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

// Of a picture five digits are more than anyone sees; deviations have digits of their own.
void round_track(json& point) {
  for (const char* key : {"x", "y", "z", "dx", "dy", "dz"}) {
    if (!point.contains(key)) continue;
    double size = 0.0;
    for (const json& entry : point[key]) size = std::max(size, std::abs(entry.get<double>()));
    if (size == 0.0) continue;
    const double unit = std::pow(10.0, std::floor(std::log10(size)) - 4.0);
    for (json& entry : point[key]) entry = round_to(std::round(entry.get<double>() / unit) * unit, 6);
  }
}

void round_item(json& item) {
  if (item["kind"] == "panels") {
    for (json& panel : item["panels"]) round_item(panel);
  } else if (item["kind"] == "strip") {
    for (json& row : item["rows"]) round_lists(row, {"start", "end"});
  } else if (item["kind"] == "view") {
    for (json& point : item["points"]) round_track(point);
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
