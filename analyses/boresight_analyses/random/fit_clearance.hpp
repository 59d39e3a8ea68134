// The radial clearance of an ISO 286 fit: half the difference of two independent deviations, the hole's and the
// shaft's,
//
//   c = (H - S) / 2,    H in [EI, ES], S in [ei, es].
//
// How deviations lie in their zones: zone_law.hpp.
#pragma once

#include "boresight_analyses/random/distribution.hpp"
#include "boresight_analyses/random/iso_286.hpp"
#include "boresight_analyses/random/zone_law.hpp"

namespace boresight {

DistributionPtr make_fit_clearance(const Fit& fit, ZoneLaw law);

}  // namespace boresight
