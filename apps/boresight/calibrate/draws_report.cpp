#include "calibrate/draws_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "report_parts/report_parts.hpp"
#include "terminal/readable.hpp"

namespace boresight::app {
namespace {

// A page shows no more of them well.
constexpr std::size_t kMostShown = 5;
constexpr Eigen::Index kMostDrawn = 500;

struct Shown {
  DisplayUnit unit;
  report::Axis axis;
  report::Numbers values;
};

Shown shown(const PosteriorDraws& draws, std::size_t k) {
  const DrawnQuantity& q = draws.quantities[k];
  Shown s{display_unit_as(q.si_unit, std::max(std::abs(q.mean), q.deviation), q.written_unit), {}, {}};
  s.axis = {name_of_path(q.name), s.unit.name};
  for (Eigen::Index i = 0; i < draws.values.rows(); ++i)
    s.values.push_back(draws.values(i, static_cast<Eigen::Index>(k)) * s.unit.per_si);
  return s;
}

report::Numbers some_of(const report::Numbers& all) {
  const std::size_t every = std::max<std::size_t>(1, all.size() / static_cast<std::size_t>(kMostDrawn));
  report::Numbers some;
  for (std::size_t i = 0; i < all.size(); i += every) some.push_back(all[i]);
  return some;
}

}  // namespace

std::string name_of_path(const std::string& path) {
  return path.starts_with("clearance.") || path.starts_with("error.") ? path.substr(path.find('.') + 1) : path;
}

std::string readable_to(double value, double error, const std::string& si_unit, const std::string& written_unit) {
  const DisplayUnit unit = display_unit_as(si_unit, std::abs(value), written_unit);
  const double shown_error = error * unit.per_si;
  if (!(shown_error > 0.0) || !std::isfinite(shown_error)) return readable_as(value, si_unit, written_unit);
  const int decimals = std::clamp(1 - static_cast<int>(std::floor(std::log10(shown_error))), 0, 12);
  return fmt::format("{:.{}f}{}", value * unit.per_si, decimals, si_unit == "1" ? "" : " " + unit.name);
}

report::Section draws_section(const PosteriorDraws& draws, double confidence) {
  report::Section section{.id = "posterior", .title = "Draws of the posterior"};
  report::Table table{
      .title = "What the draws say",
      .caption =
          fmt::format("Intervals hold {} of the draws. R-hat compares the chains with one another: below 1.01 they "
                      "agree. The sizes "
                      "are the numbers of independent draws that these are worth, for the middle and for the tails.",
                      readable_share(confidence)),
      .columns = {{"Parameter"}, {"Mean"}, {"Standard deviation"}, {"Interval"}, {"R-hat"}, {"Size"}, {"Size, tails"}}};
  for (const DrawnQuantity& q : draws.quantities) {
    const auto to = [&](double value) { return readable_to(value, q.deviation, q.si_unit, q.written_unit); };
    table.rows.push_back({name_of_path(q.name), to(q.mean), readable_as(q.deviation, q.si_unit, q.written_unit),
                          to(q.low) + " to " + to(q.high),
                          std::isfinite(q.r_hat) ? nlohmann::json(fmt::format("{:.3f}", q.r_hat)) : nlohmann::json(),
                          std::round(q.bulk_ess), std::round(q.tail_ess)});
  }
  const std::size_t count = std::min(kMostShown, draws.quantities.size());
  std::vector<Shown> all;
  for (std::size_t k = 0; k < count; ++k) all.push_back(shown(draws, k));
  report::Panels alone{.title = "Each by itself", .columns = 3, .shared_legend = false};
  report::Panels pairs{.title = "Two at a time",
                       .caption =
                           "Each point is a draw. A line of points: the data know a combination of the two better "
                           "than each; clouds apart: several modes.",
                       .columns = 3,
                       .shared_legend = false};
  for (std::size_t a = 0; a < count; ++a) {
    report::Chart chart{.title = all[a].axis.label, .x = all[a].axis, .y = {"draws"}};
    chart.series = {{.name = "draws", .x = all[a].values, .style = report::Style::histogram}};
    alone.panels.push_back(chart);
    for (std::size_t b = a + 1; b < count; ++b) {
      report::Chart pair{.title = all[a].axis.label + ", " + all[b].axis.label, .x = all[a].axis, .y = all[b].axis};
      pair.series = {
          {.name = "draws", .x = some_of(all[a].values), .y = some_of(all[b].values), .style = report::Style::markers}};
      pairs.panels.push_back(pair);
    }
  }
  section.items = {report::Text{draws.says}, table, alone};
  if (!pairs.panels.empty()) section.items.push_back(pairs);
  return section;
}

}  // namespace boresight::app
