#include "run/error_lines.hpp"

#include <fmt/format.h>

#include "report_parts/step_error_parts.hpp"
#include "terminal/readable.hpp"

namespace boresight::app {

std::vector<std::string> error_lines(const RunResult& result, const MeasuredError& measured, double size) {
  std::vector<std::string> lines;
  bool stated = false;
  const auto cell = [&](const QuantityName& quantity, const char* statistic) {
    const IndexChoice of{quantity.name, statistic};
    const std::string uncertainty = stated_error_text(measured, result, of, size);
    stated = stated || !uncertainty.empty();
    return fmt::format("{:>10} {:<{}}", readable(of.of(result.index), quantity.si_unit), uncertainty,
                       measured.measured ? 7 : 0);  // as wide as "± 2.3 %", so that columns stand
  };
  for (const QuantityName& quantity : quantity_names()) {
    if (quantity.kind == PointingQuantity::orientation_error) continue;  // the boresight error says it of the axis
    const bool of_line = quantity.kind == PointingQuantity::line_of_sight_error;
    if (of_line && !result.index.has_line_of_sight) continue;
    std::string line =
        fmt::format("{:<20} max {}  RMS {}", quantity.title, cell(quantity, "max"), cell(quantity, "rms"));
    if (std::string(quantity.si_unit) == "rad")
      line += fmt::format("  ({} max)", readable_arcsec((result.index.*quantity.statistics).max));
    lines.push_back(line.substr(0, line.find_last_not_of(' ') + 1));
  }
  if (stated)
    lines.push_back(fmt::format("±: what {} do{}, of each figure by itself",
                                measured.by_instants ? "instants" : "steps",
                                result.error.basis.empty() ? "" : " and what the rung leaves out, together"));
  return lines;
}

}  // namespace boresight::app
