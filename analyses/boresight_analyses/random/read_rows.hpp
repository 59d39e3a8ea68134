// The rows of a CSV file as they stand in a `distribution`:
//
//   { rows = { file = "draws.csv" } }                                          columns called as the parameters, SI
//   { rows = { file = "gaps.csv", columns = ["gap", "mu"], units = ["mm", "1"] } }
#pragma once

#include <string>
#include <vector>

#include "boresight/io/cursor.hpp"
#include "boresight/keys/key.hpp"
#include "boresight_analyses/random/sample_rows.hpp"

namespace boresight {

const KeyTable& rows_keys();

// rows: the table of the distribution; names, si_units: of the parameters. Throws InputError.
SampleRows read_rows(Cursor& rows, const std::vector<std::string>& names, const std::vector<std::string>& si_units);

}  // namespace boresight
