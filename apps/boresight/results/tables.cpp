#include "results/tables.hpp"

#include <fmt/format.h>

#include <cmath>
#include <ostream>

#include "boresight/keys/units.hpp"

namespace boresight::app {
namespace {

const char* const kPoseColumns[] = {"dx", "dy", "dz", "rx", "ry", "rz", "x",  "y",  "z",  "qw", "qx",
                                    "qy", "qz", "vx", "vy", "vz", "wx", "wy", "wz", "ax", "ay", "az"};

void append_pose(std::string& row, const PoseSample& s) {
  const auto add = [&row](double value) { row += "," + exact(value); };
  const auto add3 = [&add](const Vec3& v) {
    for (int k = 0; k < 3; ++k) add(v[k]);
  };
  add3(s.error.displacement);
  add3(s.error.rotation);
  add3(s.pose.p);
  for (const double q : {s.pose.q.w(), s.pose.q.x(), s.pose.q.y(), s.pose.q.z()}) add(q);
  add3(s.v);
  add3(s.w);
  add3(s.a);
}

}  // namespace

std::string exact(double value) { return !std::isfinite(value) ? "" : fmt::format("{:.17g}", value); }

std::string csv_field(const std::string& given) {
  double number = 0.0;
  const bool formula =
      !given.empty() && std::string("=+-@\t\r").find(given[0]) != std::string::npos && !parse_number(given, number);
  const std::string text = (formula ? "'" : "") + given;
  if (text.find_first_of(",\"\n\r") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? "\"\"" : std::string(1, c);
  return quoted + "\"";
}

const std::string& joint_of_clearance(const Mechanism& mechanism, int clearance) {
  const MechanismDescription& d = mechanism.description();
  return d.joints[d.clearances[clearance].joint].name;
}

void write_timeseries(std::ostream& out, const Mechanism& mechanism, const RunResult& result, std::size_t every) {
  std::string row = "t";
  for (const char* name : kPoseColumns) row += std::string(",") + name;
  for (std::size_t c = 0; c < result.clearances.size(); ++c)
    for (const char* name : {"offset_x", "offset_y", "offset_z", "penetration", "normal_force", "contact"})
      row += "," + csv_field(joint_of_clearance(mechanism, static_cast<int>(c)) + "." + name);
  for (const BodyHistory& body : result.others)
    for (const char* name : kPoseColumns) row += "," + csv_field(body.name + "." + name);
  out << row << '\n';

  for (std::size_t i = 0; i < result.time.size(); ++i) {
    if (i % every != 0 && i + 1 != result.time.size()) continue;
    row = exact(result.time[i]);
    append_pose(row, result.boresight.samples[i]);
    for (const auto& clearance : result.clearances) {
      const ClearanceSample& s = clearance[i];
      for (const double value : {s.offset.x(), s.offset.y(), s.offset.z(), s.penetration, s.normal_force})
        row += "," + exact(value);
      row += "," + std::to_string(s.contact);
    }
    for (const BodyHistory& body : result.others) append_pose(row, body.samples[i]);
    out << row << '\n';
  }
}

void write_events(std::ostream& out, const Mechanism& mechanism, const RunResult& result) {
  out << "joint,contact,start,start_speed,duration,max_penetration,max_force,end_speed\n";
  for (const ContactEvent& e : result.events) {
    out << csv_field(joint_of_clearance(mechanism, e.clearance)) << ',' << to_string(e.place);
    for (const double value : {e.start, e.start_speed, e.duration, e.max_penetration, e.max_force, e.end_speed})
      out << ',' << exact(value);
    out << '\n';
  }
}

}  // namespace boresight::app
