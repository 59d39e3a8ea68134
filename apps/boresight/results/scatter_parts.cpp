#include "results/scatter_parts.hpp"

#include <fmt/format.h>

#include <cmath>

#include "boresight/pointing/relative_text.hpp"

namespace boresight::app {

Json number_json(double value) { return std::isfinite(value) ? Json(value) : Json(); }

Json error_cell(double relative) {
  if (!std::isfinite(relative)) return {};
  return std::abs(relative) < kSaidAsMultiple ? Json(100.0 * relative) : Json(relative_text(relative));
}

Json interval_json(const ReportedInterval& i) {
  return {{"value", number_json(i.value)}, {"low", number_json(i.low)},           {"high", number_json(i.high)},
          {"confidence", i.confidence},    {"coverage", number_json(i.coverage)}, {"basis", i.basis}};
}

std::string first_failure_text(const Failures& failures, const std::string& what) {
  return fmt::format("; the first of them, {} {}: {}", what, failures.first, failures.reason);
}

void add_first_failure(Json& summary, const Failures& failures, const std::string& what) {
  if (failures.count > 0) summary["first_failure"] = {{what, failures.first}, {"reason", failures.reason}};
}

}  // namespace boresight::app
