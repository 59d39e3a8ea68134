#include "boresight_analyses/random/csv_column.hpp"

#include <algorithm>
#include <filesystem>

#include "boresight/io/csv_fields.hpp"
#include "boresight/io/csv_numbers.hpp"
#include "boresight/io/text_lines.hpp"
#include "boresight/keys/units.hpp"
#include "boresight/mechanism/error.hpp"

namespace boresight {

std::string beside(const std::string& file, const std::string& name) {
  const std::filesystem::path path = name;
  return path.is_absolute() ? name : (std::filesystem::path(file).parent_path() / path).lexically_normal().string();
}

namespace {

// "f" may mean "f [Hz]"; it is not taken for it, as nobody reads the unit here.
std::string column_meant(const std::string& column, const std::vector<std::string>& names) {
  for (const std::string& name : names)
    if (const std::size_t bracket = name.find_first_of("[(");
        bracket != std::string::npos && trimmed(name.substr(0, bracket)) == column)
      return name;
  return nearest_name(column, names);
}

}  // namespace

std::vector<double> read_csv_column(const std::string& file, const std::string& column) try {
  TextLines lines(file);
  std::string line;
  if (!lines.next(line)) throw ColumnFault{true, "an empty file " + in_quotes(file), "a CSV file", ""};
  CsvNumbers numbers(line);
  const std::vector<std::string> names = numbers.fields(line);
  const auto place = std::find(names.begin(), names.end(), column);
  if (place == names.end())
    throw ColumnFault{false, in_quotes(column), "a column of " + in_quotes(file), column_meant(column, names)};
  const auto index = static_cast<std::size_t>(place - names.begin());
  // Nobody knows which of them is meant.
  if (const auto again = std::find(place + 1, names.end(), column); again != names.end())
    throw ColumnFault{false,
                      in_quotes(column) + " as column " + std::to_string(index + 1) + " and column " +
                          std::to_string(again - names.begin() + 1) + " in line " + std::to_string(lines.number()) +
                          " of " + in_quotes(file),
                      "each column once", ""};
  std::vector<double> values;
  while (lines.next(line)) {
    if (trimmed(line).empty()) continue;
    const std::vector<std::string> row = numbers.fields(line);
    // More than names, as of decimal commas in a file that separates by commas: which belong to which cannot be known.
    const auto more = [&](const std::string& field) { return !trimmed(field).empty(); };
    if (row.size() > names.size() && std::any_of(row.begin() + static_cast<long>(names.size()), row.end(), more))
      throw ColumnFault{
          false,
          std::to_string(row.size()) + " fields in line " + std::to_string(lines.number()) + " of " + in_quotes(file),
          std::to_string(names.size()) + ", as in the header", ""};
    double value = 0.0;
    const std::string expected = index < row.size() ? numbers.read(row[index], value) : "a finite number";
    if (!expected.empty())
      throw ColumnFault{false,
                        (index < row.size() ? in_quotes(row[index]) : std::string("nothing")) + " in line " +
                            std::to_string(lines.number()) + " of " + in_quotes(file),
                        expected, ""};
    values.push_back(value);
  }
  if (values.empty()) throw ColumnFault{false, "no values in " + in_quotes(file), "at least one", ""};
  return values;
} catch (const InputError& fault) {
  const std::string line = fault.origin.line > 0 ? " in line " + std::to_string(fault.origin.line) : "";
  throw ColumnFault{true, in_quotes(file) + ": " + fault.found + line, "a CSV file (" + fault.expected + ")", ""};
}

}  // namespace boresight
