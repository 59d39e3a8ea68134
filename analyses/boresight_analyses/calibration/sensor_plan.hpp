// The sensors of one run, each with a file of its own: [[calibrate.run.sensor]] tables in place of the run's `data`.
//
//   [[calibrate.run.sensor]]
//   data = "tracker.txt"
//   header = 4                                  # its line; left out: the first that is neither empty nor a comment
//   time = "Timestamp"                          # the column of times; "t" unless given
//   start = "2026-11-24T10:15:30.120Z"          # when the motion started: a time stamp, or a time on the sensor's clock, "12.5 s"
//   point = ["0 mm", "0 mm", "1.2 m"]           # of the boresight body, at home: where it sees displacements
//   columns = { dx = "X dev", dy = "Y dev" }    # channel = column
//   units = { dx = "mm", dy = "mm" }            # where the header does not name them
//
//   [[calibrate.run.sensor]]
//   data = "autocollimator.csv"
//   rate = "2 kHz"                              # no column of times
//   columns = { rx = "Yaw (arcsec)", ry = "Pitch (arcsec)" }
//   factors = { rx = 0.5, ry = -0.5 }           # a beam turns by twice the mirror's angle
//
// Sensors are put together as one table over all their times, with gaps where one did not read.
#pragma once

#include <vector>

#include "boresight/io/cursor.hpp"
#include "boresight/keys/key.hpp"
#include "boresight/mechanism/mechanism.hpp"
#include "boresight_analyses/calibration/measured_table.hpp"

namespace boresight {

struct PlannedSensor {
  std::string data;  // the file
  ReadAs as;
  Origin origin;  // of the text that names the file
};

const KeyTable& calibrate_sensor_keys();
const KeyTable& sensor_columns_keys();
const KeyTable& sensor_units_keys();
const KeyTable& sensor_factors_keys();

// study_file: whose folder relative names are taken from. Throws InputError.
PlannedSensor read_sensor(Cursor table, const std::string& study_file);

// What a sensor read, at its place on the boresight body.
MeasuredData read_data(const PlannedSensor& sensor, const Mechanism& mechanism);

// All sensors of one run. Throws InputError where two measure the same channel.
MeasuredData together(const std::vector<MeasuredData>& sensors);

}  // namespace boresight
