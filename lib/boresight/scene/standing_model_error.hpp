// What the columns of influence leave out of standing errors: the built mechanism's joints are closed exactly at some instants of the motion, among them
// those about which the errors displace most.
#pragma once

#include <optional>

#include "boresight/pointing/indices.hpp"
#include "boresight/scene/scene_rung.hpp"

namespace boresight {

// Largest differences of the boresight body's exact pose and the linear one over those instants. Nothing where the joints do not close.
std::optional<PoseError> missed_by_linearity(const Mechanism& mechanism, const IdealMotion& commanded,
                                             const StandingErrors& influence, const Parameters& parameters);

// Of each quantity: the largest difference of the exact pose and the linear one, relative to the largest value of its index; what is next to nothing counts
// against a little of the largest of the others, on the mechanism's size. 1 where the joints do not close. 0 without errors.
PerQuantity standing_model_error(const Mechanism& mechanism, const PreparedScene& prepared,
                                 const StandingDisplacement& standing, const Parameters& parameters,
                                 const PointingIndices& index);

}  // namespace boresight
