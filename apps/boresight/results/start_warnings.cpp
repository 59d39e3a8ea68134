#include "results/start_warnings.hpp"

#include "boresight/mechanism/error.hpp"
#include "boresight/mechanism/interruption.hpp"
#include "boresight/formulations/ideal_simulation.hpp"
#include "boresight/scene/starting_journals.hpp"

namespace boresight::app {

std::vector<std::string> start_warnings(const Mechanism& mechanism) {
  std::vector<std::string> warnings;
  if (mechanism.clearances() == 0) return warnings;
  try {
    const IdealMotion ideal = ideal_motion(mechanism, mechanism.parameters());
    const StartingJournals start = starting_journals(mechanism, mechanism.parameters(), ideal);
    for (const std::string& one : {start.remark, start.warning})
      if (!one.empty()) warnings.push_back(one);
  } catch (const ComputationError&) {  // the samples say it themselves
  } catch (const Interrupted&) {       // what the study has is written first
  }
  return warnings;
}

}  // namespace boresight::app
