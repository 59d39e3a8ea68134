// How one CSV file separates its fields and marks its decimals.
//
// Where the header separates its columns by semicolons or tabs, or has one column, rows do too, and numbers may have a decimal comma, all of
// them or none: a comma mixed
// with points may be one of thousands, a thousandfold error that nobody would see.
#pragma once

#include <string>
#include <vector>

namespace boresight {

class CsvNumbers {
 public:
  explicit CsvNumbers(const std::string& header);
  std::vector<std::string> fields(const std::string& line) const;
  // "" and the value of a field; or what would have been expected in its place.
  std::string read(std::string field, double& value);

 private:
  char separator_ = ',';
  char decimal_ = 0;  // '.' or ',', of the first number that has one
};

}  // namespace boresight
