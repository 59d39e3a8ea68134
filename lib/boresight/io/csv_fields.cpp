#include "boresight/io/csv_fields.hpp"

namespace boresight {

std::string trimmed(const std::string& text) {
  const std::size_t first = text.find_first_not_of(" \t\r");
  return first == std::string::npos ? "" : text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

std::vector<std::string> csv_fields(const std::string& line, char separator) {
  std::vector<std::string> out(1);
  bool quoted = false;
  for (std::size_t k = 0; k < line.size(); ++k) {
    if (line[k] == '"') {
      if (quoted && k + 1 < line.size() && line[k + 1] == '"')
        out.back() += line[k++];
      else
        quoted = !quoted;
    } else if (line[k] == separator && !quoted) {
      out.emplace_back();
    } else {
      out.back() += line[k];
    }
  }
  for (std::string& field : out) field = trimmed(field);
  return out;
}

}  // namespace boresight
