#include "sweep/drawn_combinations.hpp"

#include <fmt/format.h>

#include "terminal/readable.hpp"

namespace boresight::app {
namespace {

std::vector<std::size_t> spread(std::size_t count, std::size_t of) {
  std::vector<std::size_t> places;
  for (std::size_t i = 0; i < count; ++i)
    places.push_back(count == 1 ? 0 : (i * (of - 1) + (count - 1) / 2) / (count - 1));
  return places;
}

}  // namespace

DrawnCombinations drawn_combinations(const SweepPlan& plan) {
  DrawnCombinations drawn;
  std::vector<std::size_t> counts;
  std::size_t curves = 1;
  // First the two ends of every axis, as far as there is room; then of the axis that lacks most, one more at a time.
  for (std::size_t i = 1; i < plan.axes.size(); ++i) {
    const std::size_t values = plan.axes[i].values.size();
    drawn.all *= values;
    counts.push_back(values > 1 && 2 * curves <= kMostOverlaid ? 2 : 1);
    curves *= counts.back();
  }
  for (;;) {
    std::size_t next = counts.size();
    double lacks = 1.0;
    for (std::size_t i = 0; i < counts.size(); ++i) {
      const double share = static_cast<double>(plan.axes[i + 1].values.size()) / static_cast<double>(counts[i]);
      if (share <= lacks || curves / counts[i] * (counts[i] + 1) > kMostOverlaid) continue;
      next = i;
      lacks = share;
    }
    if (next == counts.size()) break;
    curves = curves / counts[next] * (counts[next] + 1);
    ++counts[next];
  }
  drawn.combinations = {0};
  for (std::size_t i = 0; i < counts.size(); ++i) {
    const std::size_t values = plan.axes[i + 1].values.size();
    drawn.values.push_back(spread(counts[i], values));
    std::vector<std::size_t> longer;
    for (const std::size_t before : drawn.combinations)
      for (const std::size_t place : drawn.values.back()) longer.push_back(before * values + place);
    drawn.combinations = std::move(longer);
  }
  return drawn;
}

std::string DrawnCombinations::sentence(const SweepPlan& plan) const {
  if (combinations.size() == all) return "";
  std::string text;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const SweepAxis& axis = plan.axes[i + 1];
    text += (text.empty() ? "" : "; ") + axis.name() + " = ";
    for (std::size_t k = 0; k < values[i].size(); ++k)
      text += (k == 0 ? "" : ", ") + readable_as(axis.values[values[i][k]], axis.si_unit, axis.unit);
    if (values[i].size() < axis.values.size()) text += fmt::format(" (of {} values)", axis.values.size());
  }
  return fmt::format(
      "Of the {} combinations of the other parameters the charts draw {}: {}. The table of every point and sweep.csv "
      "have all.",
      all, combinations.size(), text);
}

}  // namespace boresight::app
