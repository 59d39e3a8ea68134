#include "results/motion_claims.hpp"

#include <cmath>
#include <string>

#include "boresight/contact/law_range.hpp"
#include "boresight/contact/turn_range.hpp"
#include "boresight/mechanism/error.hpp"
#include "boresight/rungs/pressed_through.hpp"
#include "boresight_analyses/study/index_choice.hpp"

namespace boresight::app {

void refuse_absurd(const Mechanism& mechanism, const Parameters& parameters, const RunResult& result) {
  const auto check = [](double value, const std::string& what) {
    if (!std::isfinite(value))
      throw ComputationError(
          what + " grew beyond every number: forces, masses or speeds are out of all proportion to each other");
  };
  for (const QuantityName& quantity : quantity_names())
    for (const StatisticName& statistic : statistic_names())
      check((result.index.*quantity.statistics).*statistic.value, "the " + std::string(quantity.name));
  for (const ContactSummary& c : result.contact) {
    check(c.max_force, "the contact force of " + c.joint);
    check(c.max_load, "the load on " + c.joint);
  }
  if (const auto through = pressed_through(mechanism, parameters, result)) throw ComputationError(*through);
}

void add_range_warnings(const Mechanism& mechanism, const Parameters& parameters, RunResult& result) {
  const MechanismDescription& m = mechanism.description();
  for (std::size_t c = 0; c < m.clearances.size(); ++c) {
    const JointDescription& joint = m.joints[static_cast<std::size_t>(m.clearances[c].joint)];
    if (const auto warning = turn_warning(joint.name, m.clearances[c], joint.type, parameters.clearance[c]))
      result.warnings.push_back(*warning);
  }
  for (std::size_t c = 0; c < result.contact.size(); ++c)
    if (const auto warning = range_warning(result.contact[c].joint, mechanism.description().clearances[c].contact_law,
                                           parameters.clearance[c], result.contact[c].max_force))
      result.warnings.push_back(*warning);
}

}  // namespace boresight::app
