// Measured pointing data: one CSV table of one run on a test rig.
//
//   t [s], dx [um], rz [urad], boresight_error [urad]
//   0.000, 3.2, , 41.7                                  an empty field, "nan" or "NA": not measured
//   0.001, 3.4, -12.1, 40.9                             unequal steps are welcome, times must rise
//
// Where the header separates its columns by semicolons, rows do too, and numbers may have a decimal comma, all of them or none:
//
//   t [s]; dx [um]
//   0,001; 3,4
//
// Channels: those of channel_names(), each with its unit in brackets. Lines that start with # and empty lines
// are skipped.
#pragma once

#include <string>
#include <vector>

#include "boresight/math/types.hpp"
#include "boresight/mechanism/description.hpp"

namespace boresight {

struct ChannelName {
  const char* name;
  const char* si_unit;
  const char* title;  // for people
};
// dx dy dz: displacement from the ideal pose, world axes; rx ry rz: rotation vector from it; bx by bz: change
// of the pointing axis' unit vector; position_error, orientation_error, boresight_error, line_of_sight_error:
// sizes, as the indices.
const std::vector<ChannelName>& channel_names();
// Whether a channel is a displacement, or its size, so that it matters at which point of the body it is measured.
inline bool is_of_a_point(int channel) { return channel < 3 || channel == 9; }

struct MeasuredData {
  std::string file;
  std::vector<int> channels;  // among channel_names(), in the order of the file
  std::vector<double> time;   // [s]
  MatX value;                 // samples x channels, SI; NaN: missing
  std::vector<int> line;      // of each sample, in the file
  // Of several sensors, each with a file of its own: by column; by sample and column, 0 where it did not read. Empty: as above.
  std::vector<std::string> file_of = {};
  Eigen::MatrixXi line_of = {};

  // By column: where displacements are measured, from the boresight body's origin in its axes. Empty: there.
  std::vector<Vec3> place_B = {};

  Origin origin(Eigen::Index sample, int column) const;  // of a reading
  Vec3 place_of(int channel) const;                      // channel: among channel_names()
};

// Times and readings with all their digits, by which results are known to be of these data: equal where every number is, whatever
// file they come from.
std::string exact_text_of(const MeasuredData& data);

// Throws InputError naming the line.
MeasuredData read_measured_data(const std::string& file);

}  // namespace boresight
