// Every number of a mechanism that a study may vary without rebuilding it.
//
// A mechanism is immutable and shared by all threads; a sample is a `Parameters` value (a copy of the mechanism's own
// with some numbers changed). A number is named by its path, the same in `--set`, studies and results:
//   clearance.F1.radial   clearance.*.contact.restitution   payload.mass   body.rod1.mass   gravity.z   error.rod1.length
#pragma once

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "boresight/math/types.hpp"

namespace boresight {

// Material and impact data of one contact pair. The two entries are journal and sleeve.
struct ContactParameters {
  double restitution = 0.9;                      // [-], in (0, 1]
  std::array<double, 2> young = {72e9, 72e9};    // [Pa]
  std::array<double, 2> poisson = {0.33, 0.33};  // [-]
  double density = 2700.0;                       // [kg/m^3], for the speed up to which Flores' law is valid
  double minimum_impact_speed = 1e-3;            // [m/s], lower bound of the latched impact speed
  double stiffness_scale = 1.0;                  // [-], multiplies the stiffness of the law; calibration fits it
  double linear_stiffness = 0.0;                 // [N/m], of the Kelvin-Voigt law
  double linear_damping = 0.0;                   // [N s/m], of the Kelvin-Voigt law
};

struct FrictionParameters {
  double coefficient = 0.0;         // kinetic [-]
  double static_speed = 1e-4;       // v_s [m/s]
  double dynamic_speed = 1e-3;      // v_d [m/s]
  double static_coefficient = 0.0;  // [-], of laws with a static peak; 0: the kinetic one
  double stribeck_speed = 1e-2;     // v_st [m/s], over which the peak decays
  double bristle_stiffness = 1e5;   // s0 of LuGre, per normal force [1/m]
  double bristle_damping = 10.0;    // s1 of LuGre, per normal force [s/m]
  double viscosity = 0.0;           // s2 of LuGre, per normal force [s/m]
};

struct ClearanceParameters {
  double radial = 0.0;          // c_r = R_b - R_a [m]
  double axial = 0.0;           // per side [m]
  double journal_radius = 0.0;  // R_a [m]
  double cap_radius = 0.0;      // R_s [m]
  double sleeve_length = 0.0;   // L_b [m]
  double pad_radius = 0.0;      // of a round pad in a planar joint [m]
  double width = 0.0;           // of a slider in a rectangular guide, or of a rectangular pad [m]
  double height = 0.0;          // of such a slider, across its width and its axis [m]
  double length = 0.0;          // of such a slider along its axis, of such a pad across its width [m]
  double width_gap = 0.0;       // between slider and guide on each side, along the width [m]
  double height_gap = 0.0;      // likewise, along the height [m]
  ContactParameters contact;
  FrictionParameters friction;
};

// Whether these are a rectangular pad's.
inline bool has_corners(const ClearanceParameters& p) { return p.length > 0.0 && !(p.height > 0.0); }

// A slope of the insert's axis times this is how far its contacts move [m].
inline double tilt_lever(const ClearanceParameters& p) {
  if (has_corners(p)) return 0.5 * std::max(p.width, p.length);
  return p.pad_radius > 0.0 ? p.pad_radius : 0.5 * (p.length > 0.0 ? p.length : p.sleeve_length);
}

// Every gap that a joint's play may have; those that its kind has not are zero.
inline constexpr std::array kGaps = {&ClearanceParameters::radial, &ClearanceParameters::axial,
                                     &ClearanceParameters::width_gap, &ClearanceParameters::height_gap};

// The gap that carries the loads: of a journal and a ball the radial one, of a pad the axial one, of a slider the wider of its two.
inline double ClearanceParameters::*carrying_gap(const ClearanceParameters& p) {
  if (p.pad_radius > 0.0 || has_corners(p)) return &ClearanceParameters::axial;
  if (!(p.length > 0.0)) return &ClearanceParameters::radial;
  return p.width_gap > p.height_gap ? &ClearanceParameters::width_gap : &ClearanceParameters::height_gap;
}

inline double widest_gap(const ClearanceParameters& p) {
  double widest = 0.0;
  for (const auto gap : kGaps) widest = std::max(widest, p.*gap);
  return widest;
}

struct SpringParameters {
  double stiffness = 0.0;    // [N/m]
  double damping = 0.0;      // [N s/m]
  double free_length = 0.0;  // [m]
  double preload = 0.0;      // pushes the ends apart whatever the length [N]

  // What pulls the ends together [N]; speed: of lengthening [m/s].
  double pull(double length, double speed) const {
    return stiffness * (length - free_length) + damping * speed - preload;
  }
  bool operator==(const SpringParameters& other) const {
    return stiffness == other.stiffness && damping == other.damping && free_length == other.free_length &&
           preload == other.preload;
  }
};

struct Parameters {
  Vec3 gravity = Vec3::Zero();                 // world axes [m/s^2]
  double payload_mass = 0.0;                   // [kg]
  Vec3 payload_center = Vec3::Zero();          // of mass, at home, world axes [m]
  std::vector<double> body_mass;               // per body, without the payload [kg]
  std::vector<Vec3> body_center;               // of mass, without the payload, at home, world axes [m]
  std::vector<ClearanceParameters> clearance;  // in the order of the description
  std::vector<SpringParameters> spring;        // in the order of the description
  std::vector<double> error;                   // standing errors, in the order of the description [m, rad or K]
};

}  // namespace boresight
