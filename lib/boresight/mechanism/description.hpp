// What a mechanism file says, as plain data: the input of `Mechanism`.
//
// Everything is given once, in the home (assembly) pose, in world axes, in SI. `Mechanism` checks it and derives the rest.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "boresight/math/time_function.hpp"
#include "boresight/math/types.hpp"
#include "boresight/mechanism/parameters.hpp"

namespace boresight {

// The index that stands for the ground wherever a body's index is expected.
inline constexpr int kGround = -1;

// Where a thing was described, so that a fault found later still names file and line. line 0: not from a file.
struct Origin {
  std::string file;
  int line = 0;
};

// One `--set PATH=VALUE`.
struct Setting {
  std::string path, value;
};

struct BodyDescription {
  std::string name;
  double mass = 0.0;                   // [kg]
  Vec3 center_of_mass = Vec3::Zero();  // p_WB at home [m]
  Mat3 axes = Mat3::Identity();        // R_WB at home
  Mat3 inertia = Mat3::Identity();     // about the centre of mass, body axes [kg m^2]
  std::optional<Vec3> boresight;       // pointing axis at home, world axes, unit length
  Origin origin;
};

struct PayloadDescription {
  int body = 0;
  double mass = 0.0;
  Vec3 center_of_mass = Vec3::Zero();  // at home, world [m]
  Vec3 gyration = Vec3::Zero();        // radii of gyration about the axes of the body it moves with [m]
  Origin origin;
};

enum class JointType { revolute, prismatic, cylindrical, universal, spherical, planar, fixed };

// "revolute", ...: the word of the mechanism file.
const char* to_string(JointType type);

// Whether a joint of this type may have play: there is a kind of it in play/kinds.hpp.
inline bool slides_along_axis(JointType type) { return type == JointType::cylindrical || type == JointType::prismatic; }
inline bool can_have_play(JointType type) {
  return type == JointType::revolute || slides_along_axis(type) || type == JointType::planar ||
         type == JointType::spherical;
}
inline constexpr char kTypesWithPlay[] = "a revolute, cylindrical, prismatic, planar or spherical joint";

// Whether both bodies share the joint's axis all the time.
inline bool keeps_axis(JointType type) { return type != JointType::universal && type != JointType::spherical; }

struct JointDescription {
  std::string name;
  JointType type = JointType::revolute;
  int first = kGround;  // the joint's coordinate is that of `second` seen from `first`
  int second = 0;
  Vec3 point = Vec3::Zero();  // at home, world [m]
  Vec3 axis = Vec3::UnitZ();  // unit; revolute and cylindrical: turning axis, prismatic: sliding axis, planar: normal
  Vec3 second_axis = Vec3::UnitX();  // universal only: the axis fixed in `second`, unit
  bool driven = false;               // revolute: its angle, prismatic: its displacement
  Origin origin;
};

enum class JournalAxes { parallel, free };

// Of a prismatic joint with play: round with a key that holds the turn about its axis, or rectangular.
enum class GuideShape { round, rectangular };

// Of a planar joint with play.
enum class PadShape { round, rectangular };

struct ClearanceDescription {
  int joint = 0;
  int journal = 0;  // the body that carries the journal (the ball, the pad); the joint's other body carries the sleeve
  JournalAxes axes = JournalAxes::parallel;
  GuideShape guide = GuideShape::round;
  PadShape pad = PadShape::round;
  Vec3 width_direction =
      Vec3::UnitX();  // of a rectangular guide or pad, at home, world axes: unit, across the joint's axis
  std::string contact_law = "flores";
  std::string dissipation_law;  // whose damping factor a law for cylinders takes; "": its own
  std::string friction_law = "modified-coulomb";
  ClearanceParameters parameters;
  Origin origin;
};

// Whether the insert has a width that lies in some direction across the joint's axis.
inline bool has_width(const ClearanceDescription& c) {
  return c.guide == GuideShape::rectangular || c.pad == PadShape::rectangular;
}

// Whether the insert may turn about the joint's axis within its play: a slider that tilts in a rectangular guide.
inline bool rolls(const ClearanceDescription& c, JointType type) {
  return type == JointType::prismatic && c.guide == GuideShape::rectangular && c.axes == JournalAxes::free;
}

// Whether the contacts lie where the insert's turn about the joint's axis takes them, which the joint itself leaves free: corners of a pad.
inline bool twists(const ClearanceDescription& c, JointType type) {
  return type == JointType::planar && c.pad == PadShape::rectangular;
}

struct SpringDescription {
  int first = kGround;
  int second = kGround;
  Vec3 first_point = Vec3::Zero();  // at home, world [m]
  Vec3 second_point = Vec3::Zero();
  SpringParameters parameters;
  std::string preloads;  // the joint whose bearing pair it presses together: clearance.JOINT.preload; "": none
  Origin origin;
};

// Exactly one of: torque about a revolute's axis, force along a prismatic's axis (both act on the joint's second body and
// back on its first), force at a point of a body along world axes.
struct LoadDescription {
  std::optional<int> joint;
  TimeFunctionPtr along_joint;  // [N m] or [N]
  int body = kGround;
  Vec3 point = Vec3::Zero();             // at home, world [m]
  std::array<TimeFunctionPtr, 3> force;  // world axes [N]
  Origin origin;
};

// R = R_a(psi) R_b(theta) R_c(phi) turns the body from its home orientation, a b c the letters of the convention.
struct PoseMotionDescription {
  int body = 0;
  std::array<int, 3> sequence = {2, 1, 2};  // axis of each elementary turn: 0 x, 1 y, 2 z
  std::array<TimeFunctionPtr, 3> angle;     // psi, theta, phi [rad]
  std::array<TimeFunctionPtr, 3> position;  // centre of mass, world [m]
  Origin origin;
};

struct MotionDescription {
  double duration = 1.0;  // [s]
  std::optional<PoseMotionDescription> pose;
  std::map<int, TimeFunctionPtr> drives;  // joint -> its law, relative to home [rad or m]
  Origin origin;
};

// Starting rate of one joint freedom: revolute angle, prismatic displacement, one of the two of a cylindrical joint.
struct InitialRateDescription {
  enum class Freedom { angle, displacement };
  int joint = 0;
  Freedom freedom = Freedom::angle;
  double rate = 0.0;  // [rad/s] or [m/s]
  Origin origin;
};

// Where the journals start, at the rates of the ideal motion: in balance under the loads of t = 0, or in the middle of their
// sleeves.
enum class JournalStart { rest, centred };

// The line of sight goes from a reference point, which moves with the boresight body, to a target, which stands still.
struct LineOfSightDescription {
  Vec3 from = Vec3::Zero();    // at home, world [m]
  Vec3 target = Vec3::Zero();  // world [m]
  Origin origin;
};

// One standing error: a scalar with a name, zero in the drawing. What it multiplies is what the built mechanism differs by.
struct ErrorDescription {
  enum class Kind {
    translation,  // of a joint's frame within a body, along `direction` [m]
    rotation,     // of a joint's frame within a body, about `direction` through the joint's point [rad]
    drive,        // of a drive, times `law` of its coordinate and time [m or rad]
    expansion     // of a body, whose joint frames move apart by `coefficient` times this of their distances [K]
  };
  std::string name;
  Kind kind = Kind::translation;
  int joint = 0;                   // of translation, rotation, drive
  int body = kGround;              // of translation, rotation: one of the joint's two bodies; of expansion
  Vec3 direction = Vec3::UnitX();  // unit, world axes at home
  CoordinateFunctionPtr law;       // of a drive: of its coordinate (second body seen from first, from home) and of t
  double coefficient = 0.0;        // of expansion [1/K]
  double value = 0.0;              // [m, rad or K]
  Origin origin;
  std::string law_text;  // as the file has it; "": not from a file
  Origin law_origin;
};

// "m", "rad" or "K": what the error's value is measured in.
const char* unit_of(const ErrorDescription& error, const std::vector<JointDescription>& joints);
// Whether it is a share of what its drive does: its law is proportional to the drive's coordinate.
bool is_scale(const ErrorDescription& error);
// As unit_of(), and "1" of a scale: how its value is said to people, a share of what the drive does, whatever unit it is computed in.
const char* said_unit_of(const ErrorDescription& error, const std::vector<JointDescription>& joints);

struct MechanismDescription {
  std::string name;
  Vec3 gravity = Vec3::Zero();  // [m/s^2]
  std::vector<BodyDescription> bodies;
  std::optional<PayloadDescription> payload;
  std::vector<JointDescription> joints;
  std::vector<ClearanceDescription> clearances;
  std::vector<SpringDescription> springs;
  std::vector<LoadDescription> loads;
  std::vector<ErrorDescription> errors;
  std::vector<InitialRateDescription> initial_rates;
  JournalStart journals = JournalStart::rest;
  std::optional<LineOfSightDescription> line_of_sight;
  MotionDescription motion;
  Origin origin;             // the file
  std::string content_hash;  // of the file's bytes and the settings applied to it, hexadecimal; "" if not from a file
  std::vector<Setting> settings;  // that were applied to the file
};

}  // namespace boresight
