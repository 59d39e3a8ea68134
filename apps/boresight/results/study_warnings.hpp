// What a study's reader should know of its motions, above all of how they begin: said once, for all of its samples, of the mechanism with the values
// of its file, standing errors among them.
#pragma once

#include <string>
#include <vector>

#include "boresight/mechanism/mechanism.hpp"

namespace boresight::app {

// That the ideal motion is not known as well as it was sought, or passes singular poses (ideal_simulation.hpp); that loads tip journals over to a side
// that nothing decides, or that nothing holds them somewhere in their play (scene/tipping.hpp); on rungs that follow a motion, that no position of
// rest was found; and that turns or contact laws go beyond what they hold for, under the ideal motion's loads. Samples whose masses, loads or errors
// are far from the file's may do otherwise. Empty where nothing is to be said, or nothing could be found out.
std::vector<std::string> study_warnings(const Mechanism& mechanism, const std::string& rung);

}  // namespace boresight::app
