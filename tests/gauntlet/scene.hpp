// A scene of the gauntlet as plain data, SI, in the home pose, and the mechanism file that says the same.
//
// Loops need no solving: every joint is drawn where it is at home, so any set of points and axes closes there.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "boresight/math/types.hpp"

namespace boresight::gauntlet {

inline constexpr int kGroundBody = -1;

struct SceneBody {
  std::string name;
  double mass = 0.0;
  Vec3 center_of_mass = Vec3::Zero();
  Mat3 axes = Mat3::Identity();
  Vec3 inertia = Vec3::Ones();  // principal, along its axes
  bool complete = false;        // false: finish() makes mass, place and inertia from the joints it carries
};

struct SceneJoint {
  std::string name, type;
  int first = kGroundBody, second = 0;
  Vec3 point = Vec3::Zero(), axis = Vec3::UnitZ(), second_axis = Vec3::UnitX();
  std::string law = {};  // of t; "": not driven
  bool bears = true;     // may have play
};

struct SceneContact {
  std::string law = "flores", dissipation;
  double restitution = 0.9;
  std::array<double, 2> young = {72e9, 72e9}, poisson = {0.33, 0.33};
  double density = 2700.0, minimum_impact_speed = 1e-3;
  double stiffness = 0.0, damping = 0.0;  // kelvin-voigt
};

struct SceneFriction {
  std::string law = "none";
  double coefficient = 0.0, static_speed = 1e-4, dynamic_speed = 1e-3;
  double static_coefficient = 0.0;  // 0: not given
};

struct ScenePlay {
  int joint = 0, journal = 0;
  double radial = 0.0, axial = 0.0, journal_radius = 0.0, cap_radius = 0.0, sleeve_length = 0.0;
  bool free_axes = false;
  SceneContact contact;
  SceneFriction friction;
};

struct SceneSpring {
  int first = kGroundBody, second = 0;
  Vec3 first_point = Vec3::Zero(), second_point = Vec3::Zero();
  double stiffness = 0.0, damping = 0.0, free_length = 0.0;
};

struct SceneLoad {
  int joint = -1;  // or
  int body = 0;
  std::string along;  // torque or force on the joint
  Vec3 point = Vec3::Zero();
  std::array<std::string, 3> force;
};

struct SceneRate {
  int joint = 0;
  double rate = 0.0;
};

struct Scene {
  std::string name, family, about;
  double size = 0.3;      // [m]
  double duration = 0.1;  // [s]
  Vec3 gravity = Vec3::Zero();
  std::vector<SceneBody> bodies;
  std::vector<SceneJoint> joints;
  std::vector<ScenePlay> plays;
  std::vector<SceneSpring> springs;
  std::vector<SceneLoad> loads;
  std::vector<SceneRate> rates;
  int boresight_body = 0;
  Vec3 boresight = Vec3::UnitZ();
  int payload_body = -2;  // -2: none
  double payload_mass = 0.0;
  bool floats = false;            // nothing holds it to the ground
  bool journals_centred = false;  // else they start at rest
  double sight = 0.0;             // how far away its target is [m]; 0: it has none
  int undriven_freedoms = 0;      // as its family means it: of the mechanism without play

  int add_body(const std::string& body_name);
  int add_joint(const SceneJoint& joint);

  // The same mechanism drawn elsewhere.
  void move(const Mat3& R, const Vec3& p);
  std::string toml() const;
};

}  // namespace boresight::gauntlet
