#include "boresight_analyses/calibration/measured_table.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <regex>

#include "boresight/io/csv_fields.hpp"
#include "boresight/io/csv_numbers.hpp"
#include "boresight/io/text_lines.hpp"
#include "boresight/keys/units.hpp"
#include "boresight/keys/value_fault.hpp"
#include "boresight/mechanism/error.hpp"

namespace boresight {
namespace {

struct Heading {
  std::string text, name, unit;  // as written; without its unit; its unit, "" where it names none
};

Heading heading(const std::string& text) {
  for (const char* brackets : {"[]", "()"}) {
    const std::size_t open = text.rfind(brackets[0]);
    if (open != std::string::npos && text.back() == brackets[1])
      return {text, trimmed(text.substr(0, open)), trimmed(text.substr(open + 1, text.size() - open - 2))};
  }
  return {text, text, ""};
}

double scale_of(const std::string& column, const std::string& unit_name, const SiUnit& unit, const Origin& at) {
  try {
    return scale_of_unit(unit_name, unit);
  } catch (const ValueFault& fault) {
    throw InputError(at, column, "the unit " + in_quotes(unit_name), std::string("that of ") + expectation(unit),
                     fault.nearest);
  }
}

bool is_missing(const std::string& field) { return field.empty() || field == "nan" || field == "NaN" || field == "NA"; }

struct Columns {
  int time = -1;  // -1: none
  double time_scale = 1.0;
  std::vector<int> place;     // of each channel
  std::vector<double> scale;  // of each channel
  std::size_t count = 0;
  std::vector<std::string> name;
  CsvNumbers numbers{""};
};

[[noreturn]] void refuse_twice(const std::string& name, std::size_t first, std::size_t second, const Origin& at) {
  throw InputError(at, "header",
                   "the column " + in_quotes(name) + " twice, as column " + std::to_string(first + 1) + " and column " +
                       std::to_string(second + 1),
                   "each column once");
}

// A table of this project's own: every column is t or a channel, with its unit in brackets.
void take_named_columns(const std::vector<Heading>& headings, const Origin& at, bool timed, Columns& columns,
                        MeasuredData& data) {
  std::vector<std::string> known = {"t"};
  for (const ChannelName& c : channel_names()) known.emplace_back(c.name);
  for (std::size_t here = 0; here < headings.size(); ++here) {
    const Heading& h = headings[here];
    if (h.unit.empty() || h.text.back() != ']')
      throw InputError(at, "header", in_quotes(h.text), "a column's name and its unit, such as \"dx [um]\"");
    for (std::size_t before = 0; before < here; ++before)
      if (headings[before].name == h.name) refuse_twice(h.name, before, here, at);
    if (h.name == "t") {
      columns.time = static_cast<int>(here);
      columns.time_scale = scale_of(h.name, h.unit, kDuration, at);
      continue;
    }
    const auto found = std::find(known.begin() + 1, known.end(), h.name);
    if (found == known.end())
      throw InputError(at, "header", in_quotes(h.name), "t, or a channel of pointing data",
                       nearest_name(h.name, known));
    const int channel = static_cast<int>(found - known.begin()) - 1;
    columns.place.push_back(static_cast<int>(here));
    columns.scale.push_back(
        scale_of(h.name, h.unit, unit_called(channel_names()[static_cast<std::size_t>(channel)].si_unit), at));
    data.channels.push_back(channel);
  }
  if (timed && columns.time < 0) throw InputError(at, "header", "no column \"t\"", "\"t [s]\"");
  if (data.channels.empty()) throw InputError(at, "header", "no channel", "at least one, such as \"dx [um]\"");
}

std::size_t column_called(const std::string& name, const std::vector<Heading>& headings, const Origin& at) {
  constexpr std::size_t kFewLetters = 2;  // names as short as this are all alike
  std::vector<std::string> known;
  std::optional<std::size_t> found;
  for (std::size_t k = 0; k < headings.size(); ++k) {
    known.push_back(headings[k].name);
    if (headings[k].text != name && headings[k].name != name) continue;
    if (found) refuse_twice(name, *found, k, at);
    found = k;
  }
  if (!found) {
    std::string all;
    for (const Heading& h : headings) all += (all.empty() ? "" : ", ") + in_quotes(h.text);
    throw InputError(at, "header", "no column " + in_quotes(name), "one of " + all,
                     name.size() > kFewLetters ? nearest_name(name, known) : "");
  }
  return *found;
}

// Columns that a study names; others are left alone.
void take_asked_columns(const std::vector<Heading>& headings, const ReadAs& as, const Origin& at, Columns& columns,
                        MeasuredData& data) {
  if (!as.rate) {
    const std::size_t time = column_called(as.time, headings, at);
    columns.time = static_cast<int>(time);
    const std::string unit = as.time_unit.empty() ? headings[time].unit : as.time_unit;
    if (!as.start_stamp) {
      if (unit.empty())
        throw InputError(at, "header", in_quotes(headings[time].text) + " without a unit",
                         "a time such as \"t [ms]\", or time_unit in the study; of time stamps, start as one of them");
      columns.time_scale = scale_of(as.time, unit, kDuration, at);
    }
  }
  for (const ReadColumn& c : as.columns) {
    const std::size_t place = column_called(c.column, headings, at);
    const std::string unit = c.unit.empty() ? headings[place].unit : c.unit;
    const ChannelName& channel = channel_names()[static_cast<std::size_t>(c.channel)];
    if (unit.empty())
      throw InputError(at, "header", in_quotes(headings[place].text) + " without a unit",
                       "one in brackets, or units = { " + std::string(channel.name) + " = .. } in the study");
    columns.place.push_back(static_cast<int>(place));
    columns.scale.push_back(c.factor * scale_of(c.column, unit, unit_called(channel.si_unit), at));
    data.channels.push_back(c.channel);
  }
}

Columns read_header(const std::string& line, const ReadAs& as, const Origin& at, MeasuredData& data) {
  Columns columns;
  columns.numbers = CsvNumbers(line);
  std::vector<Heading> headings;
  for (const std::string& text : columns.numbers.fields(line)) {
    headings.push_back(heading(text));
    columns.name.push_back(headings.back().name);
  }
  columns.count = headings.size();
  if (as.columns.empty())
    take_named_columns(headings, at, !as.rate, columns, data);
  else
    take_asked_columns(headings, as, at, columns, data);
  return columns;
}

double number(const std::string& field, const std::string& column, const Origin& at, Columns& columns) {
  double value = 0.0;
  if (const std::string expected = columns.numbers.read(field, value); !expected.empty())
    throw InputError(at, column, in_quotes(field),
                     expected == "a finite number" ? expected + ", or nothing" : expected);
  return value;
}

// From the motion's start on.
double time_of(const std::string& field, const ReadAs& as, const Origin& at, Columns& columns) {
  if (is_missing(field)) throw InputError(at, as.time, "nothing", "a time");
  if (!as.start_stamp && parse_time_stamp(field))
    throw InputError(at, as.time, in_quotes(field),
                     "a number; of time stamps, start says as one of them when the motion began");
  if (!as.start_stamp) return number(field, as.time, at, columns) * columns.time_scale - as.start;
  const std::optional<TimeStamp> stamp = parse_time_stamp(field);
  if (!stamp) throw InputError(at, as.time, in_quotes(field), "a time stamp, such as 2026-11-24T10:15:30.125Z");
  if (stamp->zoned != as.start_stamp->zoned)
    throw InputError(at, as.time, in_quotes(field),
                     as.start_stamp->zoned ? "a time stamp with its zone, as start has one"
                                           : "a time stamp without a zone, as start has none");
  return stamp->since(*as.start_stamp);
}

}  // namespace

std::optional<TimeStamp> parse_time_stamp(const std::string& text) {
  static const std::regex kForm(
      R"((\d{4})-(\d{2})-(\d{2})[T ](\d{2}):(\d{2}):(\d{2})(?:[.,](\d{1,15}))?(Z|[+-]\d{2}:?\d{2})?)");
  std::smatch part;
  if (!std::regex_match(text, part, kForm)) return {};
  const auto whole = [&](int k) { return std::stoi(part[static_cast<std::size_t>(k)].str()); };
  using namespace std::chrono;
  const year_month_day day{year(whole(1)), month(static_cast<unsigned>(whole(2))),
                           std::chrono::day(static_cast<unsigned>(whole(3)))};
  // The second 60 is a leap second.
  if (!day.ok() || whole(4) > 23 || whole(5) > 59 || whole(6) > 60) return {};
  TimeStamp stamp;
  stamp.second =
      duration_cast<seconds>(sys_days(day).time_since_epoch()).count() + 3600 * whole(4) + 60 * whole(5) + whole(6);
  if (part[7].matched) stamp.fraction = std::stod("0." + part[7].str());
  stamp.zoned = part[8].matched;
  if (!stamp.zoned || part[8].str() == "Z") return stamp;
  const std::string zone = part[8].str();
  const int hours = std::stoi(zone.substr(1, 2)), minutes = std::stoi(zone.substr(zone.size() - 2));
  if (hours > 23 || minutes > 59) return {};
  stamp.second -= (zone[0] == '-' ? -1 : 1) * (3600 * hours + 60 * minutes);
  return stamp;
}

MeasuredData read_measured_table(const std::string& file, const ReadAs& as) {
  MeasuredData data;
  data.file = file;
  TextLines lines(file);
  Columns columns;
  std::vector<std::vector<double>> rows;
  std::string line;
  double before = -std::numeric_limits<double>::infinity();
  long readings = 0;
  while (lines.next(line)) {
    const int at = lines.number();
    if (at < as.header || trimmed(line).empty() || (at != as.header && trimmed(line)[0] == '#')) continue;
    const Origin origin{file, at};
    if (columns.count == 0) {
      columns = read_header(line, as, origin, data);
      continue;
    }
    const std::vector<std::string> row = columns.numbers.fields(line);
    if (row.size() != columns.count)
      throw InputError(origin, "row", std::to_string(row.size()) + " fields",
                       std::to_string(columns.count) + ", as in the header");
    const double t = as.rate ? static_cast<double>(readings) / *as.rate - as.start
                             : time_of(row[static_cast<std::size_t>(columns.time)], as, origin, columns);
    ++readings;
    if (!(t > before) && as.rate)
      throw InputError(origin, "start", "readings closer together than times so far from it can be told apart",
                       "a time of the first reading's own clock, which begins near it");
    if (!(t > before))
      throw InputError(origin, as.time, in_quotes(row[static_cast<std::size_t>(columns.time)]),
                       "a time later than that of the row before");
    before = t;
    if (as.duration && (t < -1e-9 * *as.duration || t > *as.duration * (1.0 + 1e-9))) continue;
    data.time.push_back(as.duration ? std::clamp(t, 0.0, *as.duration) : t);
    data.line.push_back(at);
    rows.emplace_back();
    for (std::size_t c = 0; c < columns.place.size(); ++c) {
      const auto place = static_cast<std::size_t>(columns.place[c]);
      const double value = is_missing(row[place])
                               ? std::numeric_limits<double>::quiet_NaN()
                               : number(row[place], columns.name[place], origin, columns) * columns.scale[c];
      // A thousand kilometres, or as many radians: no deviation, and squares of it drown all others.
      constexpr double kAbsurd = 1e6;
      if (std::abs(value) > kAbsurd)
        throw InputError(origin, columns.name[place], in_quotes(row[place]),
                         "a deviation below a million metres or radians");
      rows.back().push_back(value);
    }
  }
  if (readings == 0)
    throw InputError({file, std::max(1, lines.number())}, "data", "no rows",
                     "a header with units and at least one row");
  if (rows.empty())
    throw InputError({file, lines.number()}, "data", "no reading during the motion",
                     "readings from its start on; start says when that is on the sensor's clock");
  data.value.resize(static_cast<Eigen::Index>(rows.size()), static_cast<Eigen::Index>(data.channels.size()));
  for (std::size_t i = 0; i < rows.size(); ++i)
    for (std::size_t c = 0; c < rows[i].size(); ++c)
      data.value(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(c)) = rows[i][c];
  if (!data.value.array().isFinite().any())
    throw InputError({file, data.line.front()}, "data", "no value in any of " + std::to_string(rows.size()) + " rows",
                     "readings; an empty field is one that is missing");
  return data;
}

}  // namespace boresight
