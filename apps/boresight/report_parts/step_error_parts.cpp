#include "report_parts/step_error_parts.hpp"

#include <fmt/format.h>

#include <cmath>

#include "terminal/readable.hpp"

namespace boresight::app {

double relative_step_error(const MeasuredError& measured, const PointingIndices& index, const IndexChoice& of) {
  const double value = std::abs(of.of(index)), stated = of.of(measured.stated);
  return value > 0.0 ? stated / value : 0.0;
}

namespace {

// Of an index: what is computed in another order differs by as much.
constexpr double kOfRounding = 1e-9;

// Neighbouring steps lie as far from each other as from finer ones.
bool scatters(const MeasuredError& measured, const IndexChoice& of) {
  for (const QuantityName& quantity : quantity_names())
    for (const StatisticName& statistic : statistic_names())
      if (of.quantity == quantity.name && of.statistic == statistic.name)
        return measured.scatters(quantity.statistics, statistic.value);
  return false;
}

}  // namespace

std::string steps_mislead(const MeasuredError& measured, const PointingIndices& index, const IndexChoice& of) {
  if (!measured.measured || measured.runs == 0 || scatters(measured, of)) return "";
  const double relative = relative_step_error(measured, index, of);
  if (!(relative > 1.0)) return "";
  return fmt::format("{}: what {} leave out is {} of what is found: {}", of.title(),
                     measured.by_instants ? "the instants" : "the steps", readable_share(relative),
                     measured.by_instants
                         ? "where journals rest is not followed from one instant to the next; take another rung"
                         : "this motion is not followed; take a smaller --step");
}

std::string step_error_sentence(const MeasuredError& measured, const PointingIndices& index, const IndexChoice& of) {
  if (!measured.measured) return "what the steps do to the indices was not measured: " + measured.why_not;
  if (measured.runs == 0) return measured.basis;
  const double relative = relative_step_error(measured, index, of);
  return fmt::format("{}: within {} of what {} give{}; {}, {} of CPU", of.title(),
                     relative < kOfRounding ? "rounding" : readable_share(relative),
                     measured.by_instants ? "closer instants" : "smaller steps",
                     relative > 1e-3 && scatters(measured, of)
                         ? ", as far as neighbouring steps lie from each other: one motion of many"
                         : "",
                     measured.basis, readable(measured.cpu_seconds, "s"));
}

Json step_error_json(const MeasuredError& measured) {
  if (!measured.measured) return {{"measured", false}, {"why", measured.why_not}};
  Json json = {{"measured", true},
               {"basis", measured.basis},
               {"runs", measured.runs},
               {"cpu_seconds", measured.cpu_seconds},
               {"stated", index_json(measured.stated)}};
  for (const QuantityName& quantity : quantity_names())
    for (const StatisticName& statistic : statistic_names())
      json["scatters"][quantity.name][statistic.name] = measured.scatters(quantity.statistics, statistic.value);
  return json;
}

}  // namespace boresight::app
