// One line of a table with comma separated values (RFC 4180, but for fields that run over lines).
#pragma once

#include <string>
#include <vector>

namespace boresight {

// Without the blanks at its ends.
std::string trimmed(const std::string& text);
// The fields of a line, without quotes around them and blanks at their ends; a separator in quotes is part of its field.
std::vector<std::string> csv_fields(const std::string& line, char separator = ',');

}  // namespace boresight
