// Parameter paths: the names by which `--set`, studies and results address a number of a `Parameters` value.
//
//   gravity.x|y|z, payload.mass, payload.center_of_mass.x|y|z, body.NAME.mass, body.NAME.center_of_mass.x|y|z,
//   clearance.JOINT.{radial, axial, journal_radius, cap_radius, sleeve_length, pad_radius, width, height, length, width_gap,
//   height_gap, preload},                                       (preload: of a bearing pair that has one)
//   clearance.JOINT.contact.{restitution, young, poisson, density, minimum_impact_speed, stiffness_scale,
//       stiffness, damping},                                    (the last two: of the Kelvin-Voigt law)
//   clearance.JOINT.friction.{coefficient, static_speed, dynamic_speed, static_coefficient, stribeck_speed,
//       bristle_stiffness, bristle_damping, viscosity},
//   spring.NUMBER.{stiffness, damping, free_length}            (NUMBER from 1, in file order)
//   error.NAME                                                 (a standing error)
//
// JOINT or NAME may be *: all of them, one value, where these have the same unit. young and poisson set both parts. A centre of mass that
// is varied moves the mass alone: the body's frame, whose pose is told, stays where the drawing has its centre of mass.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "boresight/mechanism/description.hpp"

namespace boresight {

class ParameterPath {
 public:
  // Throws InputError (key = the path, nearest = the closest path that exists) if the path names nothing.
  ParameterPath(const MechanismDescription& mechanism, const std::string& path, const Origin& origin = {});

  const std::string& path() const { return path_; }
  // The SI unit its values are read with: "m", "kg", "m/s^2", "1" (a pure number), ...
  const std::string& unit() const { return unit_; }
  double get(const Parameters& parameters) const;  // the first number it names
  // The one value of all numbers it names; where these differ, each of them in order.
  std::vector<double> values(const Parameters& parameters) const;
  void set(Parameters& parameters, double value) const;  // all of them
  // All of one value, or each of its own, in the order of values(). False, and nothing is set, of another count.
  bool set(Parameters& parameters, const std::vector<double>& values) const;
  std::size_t count() const { return numbers_.size(); }

 private:
  std::string path_, unit_;
  std::vector<std::function<double*(Parameters&)>> numbers_;
};

// Every path of this mechanism that names one number (no *), in order.
std::vector<std::string> parameter_paths(const MechanismDescription& mechanism);

// The paths of one number each that a path with * stands for; of another one, itself. Throws as ParameterPath does.
std::vector<std::string> single_paths(const MechanismDescription& mechanism, const std::string& path);

// Whether all that the path names are scales of drives, whose values are shares: is_scale().
bool names_scales(const MechanismDescription& mechanism, const std::string& path);

// "values from 7.2e+10 to 2.07e+11 Pa": how messages say that numbers of one path differ.
std::string differing_in_words(const std::vector<double>& values, const std::string& unit);

// The parameters as the file gives them.
Parameters nominal_parameters(const MechanismDescription& mechanism);

}  // namespace boresight
