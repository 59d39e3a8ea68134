#include "boresight_analyses/calibration/measured_data.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "boresight/io/csv_fields.hpp"
#include "boresight/io/csv_numbers.hpp"
#include "boresight/io/text_lines.hpp"
#include "boresight/keys/units.hpp"
#include "boresight/keys/value_fault.hpp"
#include "boresight/mechanism/error.hpp"

namespace boresight {
namespace {

struct Heading {
  std::string name, unit;
};

Heading heading(const std::string& text, const Origin& at) {
  const std::size_t open = text.find('[');
  if (open == std::string::npos || text.back() != ']')
    throw InputError(at, "header", in_quotes(text), "a column's name and its unit, such as \"dx [um]\"");
  return {trimmed(text.substr(0, open)), trimmed(text.substr(open + 1, text.size() - open - 2))};
}

double scale_of(const Heading& h, const SiUnit& unit, const Origin& at) {
  try {
    return scale_of_unit(h.unit, unit);
  } catch (const ValueFault&) {
    throw InputError(at, h.name, "the unit " + in_quotes(h.unit), std::string("that of ") + expectation(unit));
  }
}

bool is_missing(const std::string& field) { return field.empty() || field == "nan" || field == "NaN" || field == "NA"; }

struct Columns {
  int time = -1;
  double time_scale = 1.0;
  std::vector<int> place;     // of each channel
  std::vector<double> scale;  // of each channel
  std::size_t count = 0;
  std::vector<std::string> name;
  CsvNumbers numbers{""};
};

Columns read_header(const std::string& line, const Origin& at, MeasuredData& data) {
  Columns columns;
  std::vector<std::string> known = {"t"};
  for (const ChannelName& c : channel_names()) known.emplace_back(c.name);
  columns.numbers = CsvNumbers(line);
  for (const std::string& text : columns.numbers.fields(line)) {
    const int here = static_cast<int>(columns.count++);
    const Heading h = heading(text, at);
    columns.name.push_back(h.name);
    if (std::count(columns.name.begin(), columns.name.end(), h.name) > 1)
      throw InputError(at, h.name, "the column twice", "each column once");
    if (h.name == "t") {
      columns.time = here;
      columns.time_scale = scale_of(h, kDuration, at);
      continue;
    }
    const auto found = std::find(known.begin() + 1, known.end(), h.name);
    if (found == known.end())
      throw InputError(at, "header", in_quotes(h.name), "t, or a channel of pointing data",
                       nearest_name(h.name, known));
    const int channel = static_cast<int>(found - known.begin()) - 1;
    columns.place.push_back(here);
    columns.scale.push_back(scale_of(h, unit_called(channel_names()[channel].si_unit), at));
    data.channels.push_back(channel);
  }
  if (columns.time < 0) throw InputError(at, "header", "no column \"t\"", "\"t [s]\"");
  if (data.channels.empty()) throw InputError(at, "header", "no channel", "at least one, such as \"dx [um]\"");
  return columns;
}

double number(const std::string& field, const std::string& column, const Origin& at, Columns& columns) {
  double value = 0.0;
  if (const std::string expected = columns.numbers.read(field, value); !expected.empty())
    throw InputError(at, column, in_quotes(field),
                     expected == "a finite number" ? expected + ", or nothing" : expected);
  return value;
}

}  // namespace

const std::vector<ChannelName>& channel_names() {
  static const std::vector<ChannelName> all = {{"dx", "m", "displacement x"},
                                               {"dy", "m", "displacement y"},
                                               {"dz", "m", "displacement z"},
                                               {"rx", "rad", "rotation x"},
                                               {"ry", "rad", "rotation y"},
                                               {"rz", "rad", "rotation z"},
                                               {"bx", "rad", "pointing axis x"},
                                               {"by", "rad", "pointing axis y"},
                                               {"bz", "rad", "pointing axis z"},
                                               {"position_error", "m", "position error"},
                                               {"orientation_error", "rad", "orientation error"},
                                               {"boresight_error", "rad", "boresight error"},
                                               {"line_of_sight_error", "rad", "line of sight error"}};
  return all;
}

MeasuredData read_measured_data(const std::string& file) {
  MeasuredData data;
  data.file = file;
  TextLines lines(file);
  Columns columns;
  std::vector<std::vector<double>> rows;
  std::string line;
  while (lines.next(line)) {
    const int at = lines.number();
    if (trimmed(line).empty() || trimmed(line)[0] == '#') continue;
    const Origin origin{file, at};
    if (columns.count == 0) {
      columns = read_header(line, origin, data);
      continue;
    }
    const std::vector<std::string> row = columns.numbers.fields(line);
    if (row.size() != columns.count)
      throw InputError(origin, "row", std::to_string(row.size()) + " fields",
                       std::to_string(columns.count) + ", as in the header");
    if (is_missing(row[columns.time])) throw InputError(origin, "t", "nothing", "a time");
    const double t = number(row[columns.time], "t", origin, columns) * columns.time_scale;
    if (!data.time.empty() && !(t > data.time.back()))
      throw InputError(origin, "t", in_quotes(row[columns.time]), "a time later than that of the row before");
    data.time.push_back(t);
    data.line.push_back(at);
    rows.emplace_back();
    for (std::size_t c = 0; c < columns.place.size(); ++c) {
      const std::string& field = row[columns.place[c]];
      rows.back().push_back(is_missing(field)
                                ? std::numeric_limits<double>::quiet_NaN()
                                : number(field, columns.name[columns.place[c]], origin, columns) * columns.scale[c]);
    }
  }
  if (rows.empty())
    throw InputError({file, std::max(1, lines.number())}, "data", "no rows",
                     "a header with units and at least one row");
  data.value.resize(static_cast<Eigen::Index>(rows.size()), static_cast<Eigen::Index>(data.channels.size()));
  for (std::size_t i = 0; i < rows.size(); ++i)
    for (std::size_t c = 0; c < rows[i].size(); ++c)
      data.value(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(c)) = rows[i][c];
  return data;
}

}  // namespace boresight
