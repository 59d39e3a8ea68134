// Reads one `distribution = { ... }` table of a study.
#pragma once

#include "boresight/io/cursor.hpp"
#include "boresight/io/units.hpp"
#include "boresight_analyses/random/distribution.hpp"

namespace boresight {

// `unit`: of the parameter; "1" means pure numbers. `is_radial_clearance`: a fit may be given. Throws InputError.
DistributionPtr read_distribution(Cursor& entry, const SiUnit& unit, bool is_radial_clearance);

}  // namespace boresight
