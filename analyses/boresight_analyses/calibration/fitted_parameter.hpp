// A parameter as the fit sees it: a coordinate u without units in which every value is physical.
//
//   log     x = exp(u)                              positive sizes; the fit keeps u between the bounds
//   logit   x = low + (high - low) / (1 + e^-u)     restitution and the like, that live in an interval
#pragma once

#include <string>

#include "boresight/mechanism/parameter_path.hpp"

namespace boresight {

enum class Transform { log, logit };

struct FittedParameter {
  std::string path;
  std::string si_unit;
  Transform transform = Transform::log;
  double lower = 0.0, upper = 0.0, start = 0.0;  // SI; 0 < lower < start < upper
  std::vector<ParameterPath> place;              // one, found in the mechanism

  double value(double u) const;
  double coordinate(double value) const;
  double slope(double u) const;  // dx / du
  // Of u; for logit far out where the interval is reached to 1e-6.
  double lowest_coordinate() const;
  double highest_coordinate() const;
  // Within a hundredth of the range in u (log) or of the interval (logit).
  bool at_bound(double u) const;
};

// log unless the path ends in restitution; bounds a decade to either side of the start, or (0.01, 1).
FittedParameter fitted_parameter(const MechanismDescription& mechanism, const std::string& path, double start,
                                 const Origin& origin = {});

}  // namespace boresight
