// Reads one `distribution = { ... }` table of a study.
#pragma once

#include "boresight/io/cursor.hpp"
#include "boresight/keys/units.hpp"
#include "boresight_analyses/random/distribution.hpp"
#include "boresight_analyses/random/fit_size.hpp"

namespace boresight {

// `unit`: of the parameter; "1" means pure numbers. `journals`: of a radial clearance, for which a fit of their size may be given;
// none for other parameters. `nominal`: the parameter's value in the mechanism file, around which tolerance zones lie. A cylinder,
// which is of two parameters, is refused (random_inputs.cpp reads it). Throws InputError.
DistributionPtr read_distribution(Cursor& entry, const SiUnit& unit, const std::vector<JournalSize>& journals = {},
                                  double nominal = 0.0);

// In which unit the values of such a table are written: "mm" of { normal = { mean = "0.1 mm", ... } }; "": none, or not in one of theirs.
std::string unit_as_written_of(Cursor& entry);

}  // namespace boresight
