// What a file of another program says about a mechanism: parts and what connects them, at home (every joint at zero), in the world.
//
// A reader (urdf.hpp, sdf.hpp, mjcf.hpp) makes a Drawing; assembly.hpp makes bodies and joints of it; mechanism_text.hpp writes them down.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "boresight/mechanism/description.hpp"

namespace boresight::app {

// A frame's place in another.
struct Placement {
  Mat3 R = Mat3::Identity();
  Vec3 p = Vec3::Zero();

  Placement operator*(const Placement& inner) const { return {R * inner.R, R * inner.p + p}; }
  Placement inverse() const { return {R.transpose(), -(R.transpose() * p)}; }
};

// Turns about the fixed axes x, y, z, in this order, by roll, pitch and yaw [rad].
Mat3 turned_by(const Vec3& roll_pitch_yaw);
// Of a quaternion that need not be of unit length.
Mat3 turned_by(double w, double x, double y, double z);

// A link, or a body of a tree: rigid, with a frame of its own.
struct Part {
  std::string name;
  Placement X_WP;
  double mass = 0.0;            // 0: a frame without mass [kg]
  Vec3 p_WC = Vec3::Zero();     // its centre of mass [m]
  Mat3 inertia = Mat3::Zero();  // about the centre of mass, world axes [kg m^2]
  Origin origin;
};

// One joint moves with another: multiplier * other + offset [rad or m].
struct Mimic {
  std::string joint;
  double multiplier = 1.0, offset = 0.0;
};

struct Connection {
  std::string name;
  JointType type = JointType::revolute;
  int first = kGround, second = kGround;  // parts; the coordinate is that of `second` seen from `first`
  Vec3 p_WJ = Vec3::Zero();
  Vec3 axis = Vec3::UnitX(), second_axis = Vec3::UnitY();  // world axes, unit
  bool driven = false;                                     // by what the file says
  std::optional<Mimic> mimic;
  Origin origin;
};

// Something that is to be told about the import, and the line that it concerns; line 0: none.
struct Remark {
  int line = 0;
  std::string text;
};

struct Drawing {
  std::string file, format, name;
  Vec3 gravity = Vec3(0.0, 0.0, -9.81);
  std::vector<Part> parts;
  std::vector<Connection> connections;
  std::vector<SpringDescription> springs;  // between parts
  std::string drives;                      // what was taken for driven where the file does not say; "": it says
  std::vector<Remark> assumed;             // what the file does not say, and what was taken instead
  std::vector<Remark> left_out;            // what the file says and a mechanism file cannot
};

// More links than any mechanism has: what is sought by name in so many takes seconds.
inline constexpr std::size_t kMostParts = 1000;

// The part of this name, or -1.
int part_named(const Drawing& drawing, const std::string& name);

// Mass, centre of mass and inertia of a part, given in its frame. X_PC: the frame that the inertia is given in, at the centre of mass.
// Throws InputError, with the part's origin, for what no body can have.
void set_mass(Part& part, double mass, const Placement& X_PC, const Mat3& inertia_C, const Origin& origin);

}  // namespace boresight::app
