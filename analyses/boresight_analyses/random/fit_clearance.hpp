// The radial clearance of an ISO 286 fit: half the difference of two independent deviations, the hole's and the
// shaft's,
//
//   c = (H - S) / 2,    H in [EI, ES], S in [ei, es].
//
// How deviations lie in their zones the standard leaves open. `normal`: centred, the zone is six standard deviations
// wide
// (a process with C_p = 1) and what lies outside is sorted out; `uniform`: any deviation in the zone is as likely as
// any other, the wider assumption.
#pragma once

#include "boresight_analyses/random/distribution.hpp"
#include "boresight_analyses/random/iso_286.hpp"

namespace boresight {

enum class ZoneLaw { normal, uniform };

DistributionPtr make_fit_clearance(const Fit& fit, ZoneLaw law);

}  // namespace boresight
