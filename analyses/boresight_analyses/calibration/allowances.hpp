// What moves readings too far to be followed to first order, and so is fitted along, by its prior.
#pragma once

#include "boresight_analyses/calibration/suspects.hpp"

namespace boresight {

// Axial gaps of clearances that are fitted, behind the parameters there are; and an offset of the rig's clock of as much as a sensor may
// lag. Those that are fitted anyway stay as they are. Before prepare().
void allow_for(const Discrepancy& discrepancy, CalibrationProblem& problem);

}  // namespace boresight
