// The path of a slider's centre across its guide.
#include "boresight/report_parts/report_parts.hpp"

namespace boresight::app {

report::Chart guide_chart(const std::string& joint, const ClearanceParameters& play, const RunResult& result,
                          std::size_t clearance) {
  constexpr std::size_t kMostPoints = 4000;  // draw a second of motion
  const DisplayUnit unit = display_unit("m", widest_gap(play));
  report::Chart chart{
      .title = joint + ": slider in guide",
      .caption =
          "Path of the slider's centre seen along the joint's axis. A slider that keeps parallel touches at "
          "the rectangle, one that tilts or rolls before.",
      .x = {"along the width", unit.name},
      .y = {"along the height", unit.name},
      .equal_axes = true};
  const auto& samples = result.clearances[clearance];
  const std::size_t stride = std::max<std::size_t>(1, samples.size() / kMostPoints);
  std::vector<double> x, z;
  for (std::size_t i = 0; i < samples.size(); i += stride) {
    x.push_back(samples[i].offset.x() * unit.per_si);
    z.push_back(samples[i].offset.z() * unit.per_si);
  }
  chart.series.push_back({.name = "slider's centre", .x = x, .y = z});
  if (!x.empty())
    chart.series.push_back({.name = "start",
                            .x = report::Numbers{x.front()},
                            .y = report::Numbers{z.front()},
                            .style = report::Style::markers});
  const double a = play.width_gap * unit.per_si, b = play.height_gap * unit.per_si;
  chart.series.push_back({.name = "gaps " + readable(play.width_gap, "m") + " and " + readable(play.height_gap, "m"),
                          .x = report::Numbers{-a, a, a, -a, -a},
                          .y = report::Numbers{-b, -b, b, b, -b}});
  return chart;
}

}  // namespace boresight::app
