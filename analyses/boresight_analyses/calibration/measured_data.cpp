#include "boresight_analyses/calibration/measured_data.hpp"

#include <cmath>
#include <cstdio>

#include "boresight_analyses/calibration/measured_table.hpp"

namespace boresight {

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

Origin MeasuredData::origin(Eigen::Index sample, int column) const {
  if (file_of.empty()) return {file, line[static_cast<std::size_t>(sample)]};
  return {file_of[static_cast<std::size_t>(column)], line_of(sample, column)};
}

Vec3 MeasuredData::place_of(int channel) const {
  for (std::size_t c = 0; c < place_B.size(); ++c)
    if (channels[c] == channel) return place_B[c];
  return Vec3::Zero();
}

std::string exact_text_of(const MeasuredData& data) {
  std::string out = "t";
  for (const int c : data.channels) out += std::string(" ") + channel_names()[static_cast<std::size_t>(c)].name;
  char text[40];
  for (std::size_t i = 0; i < data.time.size(); ++i) {
    std::snprintf(text, sizeof text, "\n%.17g", data.time[i]);
    out += text;
    for (Eigen::Index c = 0; c < data.value.cols(); ++c) {
      const double value = data.value(static_cast<Eigen::Index>(i), c);
      std::snprintf(text, sizeof text, " %.17g", value);
      out += std::isfinite(value) ? text : " -";
    }
  }
  return out + "\n";
}

MeasuredData read_measured_data(const std::string& file) { return read_measured_table(file); }

}  // namespace boresight
