#include "run/axes_section.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "boresight/mechanism/error.hpp"
#include "boresight/mechanism/interruption.hpp"
#include "boresight/statics/quasistatic.hpp"
#include "terminal/interruption.hpp"
#include "terminal/readable.hpp"

namespace boresight::app {
namespace {

PointingIndices at_rest(MechanismDescription description, JournalAxes axes) {
  for (ClearanceDescription& c : description.clearances) c.axes = axes;
  const auto mechanism = std::make_shared<const Mechanism>(std::move(description));
  RunOptions options;
  options.sample_spacing = 0.0;
  options.progress = [](const RunProgress&) { return !interrupted(); };
  const RunResult result = make_rests(mechanism)->run(mechanism->parameters(), options);
  if (result.interrupted) throw Interrupted{};
  return result.index;
}

}  // namespace

std::optional<AxesComparison> compare_axes(const Mechanism& mechanism) {
  const MechanismDescription& m = mechanism.description();
  if (m.clearances.empty()) return {};
  for (const ClearanceDescription& c : m.clearances)
    if (tilt_lever(c.parameters) <= 0.0) return {};
  AxesComparison result;
  result.free = std::any_of(m.clearances.begin(), m.clearances.end(),
                            [](const ClearanceDescription& c) { return c.axes == JournalAxes::free; });
  try {
    const PointingIndices parallel = at_rest(m, JournalAxes::parallel), free = at_rest(m, JournalAxes::free);
    result.parallel_boresight = parallel.boresight_error.max;
    result.free_boresight = free.boresight_error.max;
    result.parallel_position = parallel.position_error.max;
    result.free_position = free.position_error.max;
  } catch (const ComputationError&) {
    return {};
  }
  // Rounding of a motion integrated in metres.
  const auto angle = [](double rad) {
    return rad < 1e-9 ? std::string("0") : readable(rad, "rad") + " (" + readable_arcsec(rad) + ")";
  };
  const std::string figures = fmt::format(
      "with journals at rest, the largest boresight error is {} with parallel axes and {} with free ones, the largest "
      "position "
      "error {} and {}",
      angle(result.parallel_boresight), angle(result.free_boresight), readable(result.parallel_position, "m"),
      readable(result.free_position, "m"));
  result.sentence = result.free
                        ? "Journals tilt in their sleeves here. What parallel axes would have hidden: " + figures + "."
                        : "Journal and sleeve axes are assumed parallel. What that hides: " + figures +
                              ". Set axes = \"free\" to have the tilt computed.";
  return result;
}

}  // namespace boresight::app
