#include "results/study_warnings.hpp"

#include <utility>

#include "boresight/contact_events/contact_report.hpp"
#include "boresight/formulations/ideal_simulation.hpp"
#include "boresight/mechanism/error.hpp"
#include "boresight/mechanism/interruption.hpp"
#include "boresight/scene/starting_journals.hpp"
#include "results/motion_claims.hpp"

namespace boresight::app {

std::vector<std::string> study_warnings(const Mechanism& mechanism, const std::string& rung) {
  std::vector<std::string> warnings;
  try {
    const IdealMotion ideal = ideal_motion(mechanism, mechanism.parameters());
    if (const std::string doubt = doubt_of(ideal); !doubt.empty()) warnings.push_back(doubt);
    const StartingJournals start = starting_journals(mechanism, mechanism.parameters(), ideal);
    if (!start.remark.empty()) warnings.push_back(start.remark);
    if (!start.undecided.empty() && rung != "envelope") warnings.push_back(start.undecided);
    if (!start.warning.empty() && rung != "envelope" && rung != "quasistatic") warnings.push_back(start.warning);
    std::vector<double> loads;
    for (const ContactFrequency& contact : analyse_contacts(mechanism, mechanism.parameters(), ideal))
      loads.push_back(contact.largest_radial_load);
    for (std::string& one : range_warnings(mechanism, mechanism.parameters(), loads))
      warnings.push_back(std::move(one));
  } catch (const ComputationError&) {  // the samples say it themselves
  } catch (const Interrupted&) {       // what the study has is written first
  }
  return warnings;
}

}  // namespace boresight::app
