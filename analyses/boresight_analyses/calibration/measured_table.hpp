// A table as a rig's software writes it, read as a study says: which line is its header, which columns are what, in which units, and when
// the motion started on its clock.
//
//   # exported 2026-11-24 by Vision 4.2
//   Timestamp;Yaw (arcsec);Pitch (arcsec);Quality
//   2026-11-24T10:15:30,120Z;1,25;-0,31;99
//
// Where nothing is said, it is a table of this project's own (measured_data.hpp).
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "boresight_analyses/calibration/measured_data.hpp"

namespace boresight {

// An instant, as ISO 8601-1:2019 writes date and time: "2026-11-24T10:15:30.125Z", with a blank for the T, a comma for the point,
// "+01:00" or no zone.
struct TimeStamp {
  std::int64_t second = 0;  // since 1970-01-01T00:00:00, in its own zone where it names none
  double fraction = 0.0;    // of a second
  bool zoned = false;

  double since(const TimeStamp& earlier) const {  // [s]
    return static_cast<double>(second - earlier.second) + (fraction - earlier.fraction);
  }
};
std::optional<TimeStamp> parse_time_stamp(const std::string& text);

struct ReadColumn {
  int channel = 0;     // among channel_names()
  std::string column;  // its header, with or without its unit
  std::string unit;    // "": as its header says, in [brackets] or (parentheses)
  double factor = 1.0;
};

struct ReadAs {
  int header = 0;              // its line; 0: the first that is neither empty nor a comment
  std::string time = "t";      // the column of times
  std::string time_unit;       // "": as its header says; of time stamps none
  std::optional<double> rate;  // [Hz]: no column of times, readings follow one another at equal steps
  // When the motion started: on the sensor's clock [s], or as a time stamp.
  double start = 0.0;
  std::optional<TimeStamp> start_stamp;
  std::vector<ReadColumn> columns;  // empty: by their names, all of them channels
  std::optional<Vec3> point;        // at home, where displacements are measured [m]; none: at the body's origin
  std::optional<double> duration;   // of the motion [s]: what was read before or after it is left out
};

// Throws InputError naming the line.
MeasuredData read_measured_table(const std::string& file, const ReadAs& as = {});

}  // namespace boresight
