// One column of numbers from a CSV file of measurements: a header line with the columns' names, commas between fields
// and decimal points, or semicolons and either (csv_numbers.hpp), double quotes around a field where needed.
#pragma once

#include <string>
#include <vector>

namespace boresight {

struct ColumnFault {
  bool about_the_file = true;  // else about the column's name
  std::string found, expected, nearest;
};

// Throws ColumnFault: no such file or column, a column twice, no values, a field that is no finite number (with its line).
std::vector<double> read_csv_column(const std::string& file, const std::string& column);

// `name` as seen from the folder of `file`.
std::string beside(const std::string& file, const std::string& name);

}  // namespace boresight
