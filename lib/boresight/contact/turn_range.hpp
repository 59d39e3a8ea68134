// How far turns within a play can be trusted. Penetrations are of first order in offsets, slopes and roll: a body of half width w and half length l
// touches at both ends where l turn = gap. Exactly it does where l sin(turn) + w cos(turn) = w + gap, and the two differ by w gap / (2 l^2) of the
// turn: by next to nothing in a bearing as long as it is wide, by all of it in one that is a thin ring. A journal that is longer than its sleeve turns
// less by as much.
#pragma once

#include <optional>
#include <string>

#include "boresight/mechanism/description.hpp"

namespace boresight {

// What the largest turn that the play allows is off by, as a share of it; 0 where nothing turns, or only a pad or a ball does.
double missed_of_turns(const ClearanceDescription& description, JointType type, const ClearanceParameters& parameters);

// One line on a joint whose turns are off by more than a hundredth; nothing if all is well.
std::optional<std::string> turn_warning(const std::string& joint, const ClearanceDescription& description,
                                        JointType type, const ClearanceParameters& parameters);

}  // namespace boresight
