// Mechanisms with a clearance that stands for two bearings, by the shorthand and written out.
#pragma once

#include <string>

#include "boresight/io/mechanism_file.hpp"

namespace boresight::scenes {

inline MechanismDescription from_corpus(const std::string& name, const std::vector<Setting>& settings = {}) {
  return read_mechanism(std::string(BORESIGHT_CORPUS) + "/" + name + ".toml", settings);
}

// Names have no dots where a user writes them: pitch.floating is written out as pitch_floating.
inline void name_as_written_out(MechanismDescription& m) {
  const auto plain = [](std::string& name) {
    for (char& c : name)
      if (c == '.') c = '_';
  };
  for (BodyDescription& b : m.bodies) plain(b.name);
  for (JointDescription& j : m.joints) plain(j.name);
}

inline const std::string kContactAndFriction = R"toml(
[clearance.contact]
restitution = 0.4
young = ["207 GPa", "72 GPa"]
[clearance.friction]
coefficient = 0.08
)toml";

// A gimbal, as a file.
inline std::string gimbal_file(const std::string& joints, const std::string& clearances) {
  return R"toml(format = 1
name = "gimbal"
gravity = ["0 m/s^2", "0 m/s^2", "-9.81 m/s^2"]
[[body]]
name = "yoke"
mass = "4 kg"
center_of_mass = ["20 mm", "0 mm", "-5 mm"]
inertia = ["0.02 kg m^2", "0.03 kg m^2", "0.025 kg m^2"]
[[body]]
name = "tube"
mass = "3 kg"
center_of_mass = ["25 mm", "8 mm", "3 mm"]
inertia = ["0.012 kg m^2", "0.02 kg m^2", "0.018 kg m^2"]
boresight = [1, 0, 0]
)toml" + joints +
         R"toml(
[motion]
duration = "60 ms"
drives = { yaw = "0.3*sin(6*t)", pitch = "0.2*sin(8*t)" }
)toml" + clearances;
}

inline std::string gimbal_joint(const std::string& name, const std::string& type, const std::string& bodies,
                                const std::string& point, const std::string& axis, bool driven) {
  return "[[joint]]\nname = \"" + name + "\"\ntype = \"" + type + "\"\nconnects = " + bodies + "\npoint = " + point +
         "\naxis = " + axis + (driven ? "\ndriven = true\n" : "\n");
}

inline MechanismDescription gimbal_by_shorthand() {
  const auto pair = [](const std::string& joint, const std::string& more) {
    return "[[clearance]]\njoint = \"" + joint + "\"\nbearing = \"pair\"\nradial = \"0.01 mm\"\naxial = \"0.02 mm\"\n" +
           "journal_radius = \"6 mm\"\ncap_radius = \"9 mm\"\nsleeve_length = \"10 mm\"\n" + more + kContactAndFriction;
  };
  return read_mechanism_text(gimbal_file(gimbal_joint("yaw", "revolute", R"(["ground", "yoke"])",
                                                      R"(["0 mm", "0 mm", "10 mm"])", "[0, 0, 1]", true) +
                                             gimbal_joint("pitch", "revolute", R"(["yoke", "tube"])",
                                                          R"(["0 mm", "0 mm", "20 mm"])", "[0, 1, 0]", true),
                                         pair("yaw", "journal = \"yoke\"\nspan = \"80 mm\"\n") +
                                             pair("pitch",
                                                  "journal = \"tube\"\nspan = \"120 mm\"\nfixed_end = "
                                                  "\"end\"\nfloating = { radial = \"0.014 mm\" }\n")),
                             "shorthand.toml");
}

inline MechanismDescription gimbal_written_out() {
  const auto bearing = [](const std::string& joint, const std::string& journal, const std::string& radial, bool fixed) {
    return "[[clearance]]\njoint = \"" + joint + "\"\njournal = \"" + journal + "\"\nradial = \"" + radial +
           "\"\njournal_radius = \"6 mm\"\nsleeve_length = \"10 mm\"\naxes = \"free\"\n" +
           (fixed ? "axial = \"0.02 mm\"\ncap_radius = \"9 mm\"\n" : "") + kContactAndFriction;
  };
  const std::string outer = R"(["ground", "yoke"])", inner = R"(["yoke", "tube"])";
  return read_mechanism_text(
      gimbal_file(
          gimbal_joint("yaw", "revolute", outer, R"(["0 mm", "0 mm", "-30 mm"])", "[0, 0, 1]", true) +
              gimbal_joint("yaw_floating", "cylindrical", outer, R"(["0 mm", "0 mm", "50 mm"])", "[0, 0, 1]", false) +
              gimbal_joint("pitch", "revolute", inner, R"(["0 mm", "60 mm", "20 mm"])", "[0, 1, 0]", true) +
              gimbal_joint("pitch_floating", "cylindrical", inner, R"(["0 mm", "-60 mm", "20 mm"])", "[0, 1, 0]",
                           false),
          bearing("yaw", "yoke", "0.01 mm", true) + bearing("yaw_floating", "yoke", "0.01 mm", false) +
              bearing("pitch", "tube", "0.01 mm", true) + bearing("pitch_floating", "tube", "0.014 mm", false)),
      "written_out.toml");
}

// tests/gauntlet/corpus/universal-joint-shaft.toml with the crosses of universal-joints-with-play.toml drawn, and a clearance on each of
// their four bearings.
inline MechanismDescription shaft_written_out() {
  MechanismDescription m = from_corpus("universal-joint-shaft");
  ClearanceDescription bearing = m.clearances.front();
  m.clearances.clear();
  m.bodies[2].boresight.reset();
  m.bodies[1].boresight = Vec3(0.980580675691, 0.196116135138, 0.0).normalized();
  bearing.axes = JournalAxes::parallel;
  bearing.parameters.axial = 0.01e-3;
  bearing.parameters.journal_radius = 6e-3;
  bearing.parameters.cap_radius = 8e-3;
  bearing.parameters.sleeve_length = 12e-3;
  for (std::size_t j = 0; j < m.joints.size(); ++j) {
    if (m.joints[j].type != JointType::universal) continue;
    const JointDescription drawn = m.joints[j];
    BodyDescription cross;
    cross.name = drawn.name + "_cross";
    cross.mass = 60e-3;
    cross.center_of_mass = drawn.point;
    cross.axes << drawn.axis, drawn.second_axis, drawn.axis.cross(drawn.second_axis);
    cross.inertia = Vec3(0.06 * 0.02 * 0.02 / 6.0, 0.06 * 0.02 * 0.02 / 6.0, 0.06 * 0.02 * 0.02 / 3.0).asDiagonal();
    const int body = static_cast<int>(m.bodies.size());
    m.bodies.push_back(cross);
    JointDescription first = drawn, second = drawn;
    first.type = second.type = JointType::revolute;
    first.name += "_first";
    second.name += "_second";
    first.second = second.first = body;
    second.axis = drawn.second_axis;
    m.joints[j] = first;
    m.joints.insert(m.joints.begin() + static_cast<std::ptrdiff_t>(j) + 1, second);
    bearing.journal = body;
    bearing.parameters.radial = drawn.name == "cross1" ? 0.01e-3 : 0.02e-3;
    for (const std::size_t joint : {j, j + 1}) {
      bearing.joint = static_cast<int>(joint);
      m.clearances.push_back(bearing);
    }
    ++j;
  }
  return m;
}

}  // namespace boresight::scenes
