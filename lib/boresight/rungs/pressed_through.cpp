#include "boresight/rungs/pressed_through.hpp"

#include <algorithm>
#include <cstdio>

#include "boresight/play/joint_play.hpp"

namespace boresight {
namespace {

constexpr const char* kWhatToCheck =
    "; no contact law holds there: check masses, gravity, loads, young and the speed of the motion";

std::string millimetres(double length) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g mm", 1e3 * length);
  return text;
}

}  // namespace

double insert_thickness(const ClearanceParameters& p) {
  // All but one of them are zero.
  return std::max({p.journal_radius, p.pad_radius, 0.5 * std::min(p.width, has_corners(p) ? p.length : p.height)});
}

std::optional<std::string> pressed_through(const Mechanism& mechanism, const Parameters& parameters,
                                           const RunResult& result) {
  const MechanismDescription& description = mechanism.description();
  for (std::size_t c = 0; c < result.contact.size(); ++c) {
    const double depth = result.contact[c].max_penetration, thick = insert_thickness(parameters.clearance[c]);
    if (!(thick > 0.0) || !(depth >= thick)) continue;
    const ClearanceDescription& d = description.clearances[c];
    const PlayWords parts = JointPlay::words(d, description.joints[static_cast<std::size_t>(d.joint)].type);
    return result.contact[c].joint + ": the " + parts.insert + " is pressed " + millimetres(depth) + " into its " +
           parts.seat + ", which is more than the " + millimetres(thick) + " that it measures from its middle" +
           kWhatToCheck;
  }
  return std::nullopt;
}

std::optional<std::string> pressed_through(const Parameters& parameters, double deepest) {
  double thick = 0.0;
  for (const ClearanceParameters& c : parameters.clearance) thick = std::max(thick, insert_thickness(c));
  if (!(thick > 0.0) || !(deepest >= thick)) return std::nullopt;
  return "a contact is pressed in by " + millimetres(deepest) + ", which is more than the " + millimetres(thick) +
         " that the thickest of the parts in play measures from its middle" + kWhatToCheck;
}

}  // namespace boresight
