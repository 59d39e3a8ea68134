// A parameter as the fit sees it: a coordinate u without units in which every value is physical.
//
//   log     x = exp(u)                              positive sizes; the fit keeps u between the bounds
//   logit   x = low + (high - low) / (1 + e^-u)     restitution and the like, that live in an interval
//   linear  x = size u                              standing errors, of either sign; size: what one may well be
#pragma once

#include <string>

#include "boresight/mechanism/parameter_path.hpp"
#include "boresight_analyses/random/contact_path.hpp"

namespace boresight {

enum class Transform { log, logit, linear };

struct FittedParameter {
  std::string path;
  std::string si_unit;
  std::string written_unit;  // as the study writes it, "arcsec"; "": as people read it
  bool is_scale = false;     // of a drive: computed in the drive's unit, told as a share of what it does
  Transform transform = Transform::log;
  // SI; lower < start < upper, of log and logit above 0
  double lower = 0.0, upper = 0.0, start = 0.0;
  double size = 1.0;                 // of linear: what a direction that is known is known to a share of [SI]
  bool has_prior = false;            // what was known before: of linear, size is its standard deviation about start
  double prior = 0.0;                // of log and logit: its standard deviation about start [SI]
  std::vector<ParameterPath> place;  // one, found in the mechanism

  // Whether it is a standing error, error.NAME; else it belongs to a contact.
  bool is_error() const { return transform == Transform::linear; }
  // Its unit as people and programs are told it: of a scale "1", as elsewhere (random_inputs.hpp).
  std::string told_unit() const { return is_scale ? "1" : si_unit; }
  bool is_contact() const { return is_contact_path(path); }
  // Of u, what is known before: one over its variance; 0: nothing.
  double prior_information() const;
  // How far u is from what was told, in standard deviations of the prior.
  double prior_distance(double u) const;
  double value(double u) const;
  double coordinate(double value) const;
  double slope(double u) const;  // dx / du
  // Of u; for logit far out where the interval is reached to 1e-6.
  double lowest_coordinate() const;
  double highest_coordinate() const;
  // Within a hundredth of the range in u (log) or of the interval (logit, linear).
  bool at_bound(double u) const;
};

// Of a clearance: log unless the path ends in restitution; bounds a decade to either side of the start, or (0.01, 1). Of an error: linear,
// its size 1 mrad, a thousandth of the mechanism's, or 10 K; bounds at a thousand times of it to either side.
FittedParameter fitted_parameter(const MechanismDescription& mechanism, const std::string& path, double start,
                                 const Origin& origin = {});

}  // namespace boresight
