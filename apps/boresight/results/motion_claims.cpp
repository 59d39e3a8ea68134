#include "results/motion_claims.hpp"

#include <cmath>
#include <string>
#include <utility>

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

std::vector<std::string> range_warnings(const Mechanism& mechanism, const Parameters& parameters,
                                        const std::vector<double>& loads) {
  const MechanismDescription& m = mechanism.description();
  std::vector<std::string> warnings;
  const auto joint_of = [&](std::size_t c) -> const JointDescription& {
    return m.joints[static_cast<std::size_t>(m.clearances[c].joint)];
  };
  for (std::size_t c = 0; c < m.clearances.size(); ++c) {
    const ClearanceParameters& p = parameters.clearance[c];
    if (const auto warning = turn_warning(joint_of(c).name, m.clearances[c], joint_of(c).type, p))
      warnings.push_back(*warning);
  }
  for (std::size_t c = 0; c < loads.size(); ++c)
    if (const auto warning =
            range_warning(joint_of(c).name, m.clearances[c].contact_law, parameters.clearance[c], loads[c]))
      warnings.push_back(*warning);
  return warnings;
}

void add_range_warnings(const Mechanism& mechanism, const Parameters& parameters, RunResult& result) {
  std::vector<double> loads;
  for (const ContactSummary& contact : result.contact) loads.push_back(contact.max_radial_force);
  for (std::string& one : range_warnings(mechanism, parameters, loads)) result.warnings.push_back(std::move(one));
}

}  // namespace boresight::app
