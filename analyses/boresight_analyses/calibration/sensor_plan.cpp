#include "boresight_analyses/calibration/sensor_plan.hpp"

#include <algorithm>
#include <limits>

#include "boresight/io/referred_file.hpp"
#include "boresight/keys/units.hpp"
#include "boresight/keys/value_fault.hpp"
#include "boresight/mechanism/error.hpp"
#include "boresight_analyses/random/csv_column.hpp"

namespace boresight {
namespace {

// A table with a key for each channel.
template <typename KeyOf>
KeyTable by_channel(const char* name, const char* sentence, const KeyOf& key_of) {
  KeyTable table{.name = name, .says = sentence, .keys = {}};
  for (const ChannelName& channel : channel_names()) table.keys.push_back(key_of(channel));
  return table;
}

int channel_called(const std::string& name) {
  const std::vector<ChannelName>& all = channel_names();
  for (std::size_t c = 0; c < all.size(); ++c)
    if (all[c].name == name) return static_cast<int>(c);
  return -1;
}

void read_start(Cursor& table, ReadAs& as) {
  if (!table.has("start")) return;
  const std::string text = table.text("start");
  as.start_stamp = parse_time_stamp(text);
  if (as.start_stamp) {
    if (as.rate)
      table.fail_found("start", "a time stamp beside a rate", "a time on the sensor's clock, such as \"12.5 s\"");
    return;
  }
  try {
    as.start = parse_quantity(text, kDuration);
  } catch (const ValueFault&) {
    table.fail_found(
        "start", in_quotes(text),
        "a time on the sensor's clock, such as \"12.5 s\", or a time stamp, such as \"2026-11-24T10:15:30.125Z\"");
  }
}

}  // namespace

const KeyTable& calibrate_sensor_keys() {
  using namespace keys;
  static const KeyTable table_of_keys{
      .name = "calibrate.run.sensor",
      .says = "One of several sensors of a run, or one whose software writes other tables than ours.",
      .keys = {
          text("data")
              .filled("the path of a file")
              .says("The file of its readings: columns separated by commas, semicolons or tabs. A relative name is "
                    "taken from the study file's folder."),
          integer("header")
              .counting(1.0, 1e6)
              .sometimes("left out, the first line that is neither empty nor a comment")
              .says("The number of the header's line; what stands before it is left alone."),
          text("time").otherwise("t").says("The column of times: numbers, or ISO 8601 time stamps."),
          text("time_unit").usually("as the header says").says("Unit of the column of times, such as \"ms\"."),
          quantity("rate", kFrequency)
              .above(0.0, "more than 0")
              .sometimes("left out, there is a column of times")
              .says("Readings a second, where the file has no times: the first reading is at 0 on the sensor's clock."),
          text("start").usually("0 s").says(
              "When the motion started: what the sensor's clock showed, such as \"12.5 s\", or a time "
              "stamp where the file has them. What was read before it or after the motion's end is "
              "left out."),
          vector("point", kCoordinateRange)
              .sometimes("left out, the origin of the boresight body, its centre of mass")
              .says(
                  "The point of the boresight body, where it is at home, whose displacement is measured: a target's."),
          table("columns", sensor_columns_keys).says("Which column each channel is."),
          table("units", sensor_units_keys).sometimes("left out, the header names them").says("Units of the columns."),
          table("factors", sensor_factors_keys)
              .sometimes("left out, 1")
              .says("What readings are multiplied by: signs of a sensor's axes, 0.5 of a beam that a mirror turns.")}};
  return table_of_keys;
}

const KeyTable& sensor_columns_keys() {
  static const KeyTable table_of_keys = [] {
    KeyTable t =
        by_channel("calibrate.run.sensor.columns", "The column that each channel is.", [](const ChannelName& channel) {
          return keys::text(channel.name)
              .sometimes("left out, the sensor does not measure it")
              .says(std::string("Header of the column of ") + channel.title + ", with its unit or without.");
        });
    t.fewest = 1;
    t.fewest_expected = "at least one channel, such as { dx = \"X dev\" }";
    return t;
  }();
  return table_of_keys;
}

const KeyTable& sensor_units_keys() {
  static const KeyTable table_of_keys =
      by_channel("calibrate.run.sensor.units", "The unit of each channel's column.", [](const ChannelName& channel) {
        return keys::text(channel.name)
            .usually("as the header says")
            .says(std::string("Unit of the column of ") + channel.title + ".");
      });
  return table_of_keys;
}

const KeyTable& sensor_factors_keys() {
  static const KeyTable table_of_keys =
      by_channel("calibrate.run.sensor.factors", "What each channel's readings are multiplied by.",
                 [](const ChannelName& channel) {
                   return keys::number(channel.name)
                       .except({0.0}, "a factor that is not 0")
                       .otherwise(1.0)
                       .says(std::string("Factor of ") + channel.title + ".");
                 });
  return table_of_keys;
}

PlannedSensor read_sensor(Cursor table, const std::string& study_file) {
  table.only(calibrate_sensor_keys());
  PlannedSensor sensor;
  const std::string data = table.text("data");
  sensor.data = beside(study_file, data);
  sensor.origin = table.origin("data");
  ReadAs& as = sensor.as;
  if (table.has("header")) as.header = static_cast<int>(table.integer("header"));
  as.time = table.text("time");
  if (table.has("time_unit")) as.time_unit = table.text("time_unit");
  if (table.has("rate")) as.rate = table.quantity("rate");
  for (const char* key : {"time", "time_unit"})
    if (as.rate && table.has(key)) table.fail_found(key, "a rate beside it", "a rate, or a column of times");
  read_start(table, as);
  Cursor columns = table.table("columns");
  columns.only(sensor_columns_keys());
  for (const std::string& name : columns.keys())
    as.columns.push_back({channel_called(name), columns.text(name), "", 1.0});
  columns.finish();
  const auto of = [&](Cursor& inside, const std::string& name) -> ReadColumn& {
    for (ReadColumn& c : as.columns)
      if (c.channel == channel_called(name)) return c;
    inside.fail(name, "a channel of columns");
  };
  if (table.has("point")) {
    as.point = table.vector("point");
    table.require(
        std::any_of(as.columns.begin(), as.columns.end(), [](const ReadColumn& c) { return is_of_a_point(c.channel); }),
        "point", "a displacement among columns: dx, dy, dz or position_error");
  }
  if (table.has("units")) {
    Cursor units = table.table("units");
    units.only(sensor_units_keys());
    for (const std::string& name : units.keys()) of(units, name).unit = units.text(name);
    units.finish();
  }
  if (table.has("factors")) {
    Cursor factors = table.table("factors");
    factors.only(sensor_factors_keys());
    for (const std::string& name : factors.keys()) {
      of(factors, name).factor = factors.number(name);
    }
    factors.finish();
  }
  table.finish();
  return sensor;
}

MeasuredData read_data(const PlannedSensor& sensor, const Mechanism& mechanism) {
  ReadAs as = sensor.as;
  as.duration = mechanism.duration();
  MeasuredData data =
      read_referred(sensor.origin, "data", sensor.data, [&] { return read_measured_table(sensor.data, as); });
  if (!as.point) return data;
  const BodyDescription& body = mechanism.description().bodies[static_cast<std::size_t>(mechanism.boresight_body())];
  const Vec3 place_B = body.axes.transpose() * (*as.point - body.center_of_mass);
  for (const int channel : data.channels) data.place_B.push_back(is_of_a_point(channel) ? place_B : Vec3(Vec3::Zero()));
  return data;
}

MeasuredData together(const std::vector<MeasuredData>& sensors) {
  MeasuredData all;
  all.file = sensors.front().file;
  for (const MeasuredData& s : sensors) all.time.insert(all.time.end(), s.time.begin(), s.time.end());
  std::sort(all.time.begin(), all.time.end());
  all.time.erase(std::unique(all.time.begin(), all.time.end()), all.time.end());
  const auto samples = static_cast<Eigen::Index>(all.time.size());
  all.line.assign(all.time.size(), 0);
  for (const MeasuredData& s : sensors) {
    for (std::size_t c = 0; c < s.channels.size(); ++c) {
      if (std::count(all.channels.begin(), all.channels.end(), s.channels[c]) > 0)
        throw InputError({s.file, 1}, channel_names()[static_cast<std::size_t>(s.channels[c])].name,
                         "it by two sensors of one run", "each channel by one sensor");
      all.channels.push_back(s.channels[c]);
      all.file_of.push_back(s.file);
      all.place_B.push_back(s.place_B.empty() ? Vec3(Vec3::Zero()) : s.place_B[c]);
    }
    const Eigen::Index before = all.value.cols(), more = s.value.cols();
    all.value.conservativeResize(samples, before + more);
    all.line_of.conservativeResize(samples, before + more);
    all.value.rightCols(more).setConstant(std::numeric_limits<double>::quiet_NaN());
    all.line_of.rightCols(more).setZero();
    for (std::size_t i = 0; i < s.time.size(); ++i) {
      const auto row = std::lower_bound(all.time.begin(), all.time.end(), s.time[i]) - all.time.begin();
      all.value.row(row).tail(more) = s.value.row(static_cast<Eigen::Index>(i));
      all.line_of.row(row).tail(more).setConstant(s.line[i]);
      if (all.line[static_cast<std::size_t>(row)] == 0) all.line[static_cast<std::size_t>(row)] = s.line[i];
    }
  }
  return all;
}

}  // namespace boresight
