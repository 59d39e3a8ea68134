#include "boresight/io/csv_numbers.hpp"

#include "boresight/io/csv_fields.hpp"
#include "boresight/keys/units.hpp"

namespace boresight {

namespace {

// Of a file with one column: no mark that a line may hold, so that its numbers may have decimal commas.
constexpr char kNone = '\n';

}  // namespace

// The mark that separates most fields: a name may hold another one.
CsvNumbers::CsvNumbers(const std::string& header) {
  std::size_t most = csv_fields(header, separator_).size();
  for (const char mark : {';', '\t'})
    if (const std::size_t fields = csv_fields(header, mark).size(); fields > most) {
      most = fields;
      separator_ = mark;
    }
  if (most == 1) separator_ = kNone;
}

std::vector<std::string> CsvNumbers::fields(const std::string& line) const { return csv_fields(line, separator_); }

std::string CsvNumbers::read(std::string field, double& value) {
  const std::size_t mark = field.find_first_of(".,");
  if (mark != std::string::npos) {
    if (decimal_ == 0) decimal_ = field[mark];
    if (field[mark] != decimal_)
      return decimal_ == ',' ? "a decimal comma, as in the numbers before"
                             : "a decimal point, as in the numbers before";
    const bool once = field.find_first_of(".,", mark + 1) == std::string::npos;
    if (once && separator_ != ',') field[mark] = '.';
  }
  return parse_number(field, value) ? "" : "a finite number";
}

}  // namespace boresight
