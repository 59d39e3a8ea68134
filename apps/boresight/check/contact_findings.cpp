#include "check/contact_findings.hpp"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "boresight/play/joint_play.hpp"
#include "boresight/rungs/pressed_through.hpp"
#include "terminal/readable.hpp"

namespace boresight::app {

std::vector<std::string> contact_findings(const Mechanism& mechanism, const std::vector<ContactFrequency>& contacts) {
  std::vector<std::string> findings;
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    const ContactFrequency& contact = contacts[c];
    const ClearanceDescription& d = mechanism.description().clearances[c];
    const ClearanceParameters& p = mechanism.parameters().clearance[c];
    const std::pair<const char*, double> numbers[] = {
        {"contact stiffness", contact.hertz_stiffness}, {"end-face stiffness", contact.axial_stiffness},
        {"moved mass", contact.effective_mass},         {"reaction", contact.largest_load},
        {"rest depth", contact.typical_penetration},    {"contact frequency", contact.angular_frequency}};
    std::string unknown;
    for (const auto& [what, value] : numbers)
      if (!std::isfinite(value)) unknown += (unknown.empty() ? "" : ", ") + std::string(what);
    if (!unknown.empty()) {
      findings.push_back(fmt::format(
          "{}: its {} cannot be computed: masses, speeds, stiffness or gravity are out of all proportion to each other",
          contact.joint, unknown));
      continue;
    }
    // A contact as deep as the journal is thick, or the pad is wide, is no contact: the journal would be through its sleeve.
    const JointPlay play(d, mechanism.description().joints[d.joint].type, p);
    double depth = play.normal_law().depth_under(contact.largest_radial_load);
    if (contact.axial_stiffness > 0.0) depth = std::max(depth, contact.largest_axial_load / contact.axial_stiffness);
    const double radius = insert_thickness(p);
    const PlayWords parts = play.words();
    if (!(depth < radius))
      findings.push_back(fmt::format(
          "{}: its largest load, {}, would press the {} {} into its {}, which is more than the {}'s {} of {}; "
          "check young, masses and gravity, and the speed of the motion",
          contact.joint, readable(contact.largest_load, "N"), parts.insert, readable(depth, "m"), parts.seat,
          parts.insert, p.length > 0.0 ? "half width" : "radius", readable(radius, "m")));
  }
  return findings;
}

}  // namespace boresight::app
