#include "boresight_analyses/calibration/fitted_parameter.hpp"

#include <algorithm>
#include <cmath>

#include "boresight/keys/parameter_unit.hpp"

namespace boresight {
namespace {

// What an error of this unit may well be in such a mechanism, where nobody has said it.
double usual_size(const MechanismDescription& mechanism, const std::string& unit) {
  if (unit == "K") return 10.0;
  if (unit != "m") return 1e-3;
  Vec3 low = mechanism.joints.front().point, high = low;
  for (const JointDescription& j : mechanism.joints) {
    low = low.cwiseMin(j.point);
    high = high.cwiseMax(j.point);
  }
  for (const BodyDescription& b : mechanism.bodies) {
    low = low.cwiseMin(b.center_of_mass);
    high = high.cwiseMax(b.center_of_mass);
  }
  const double length = (high - low).norm();
  return 1e-3 * (length > 0.0 ? length : 1.0);
}

constexpr double kMostSizes = 1000.0;

}  // namespace

double FittedParameter::value(double u) const {
  if (transform == Transform::linear) return size * u;
  if (transform == Transform::log) return std::exp(u);
  return lower + (upper - lower) / (1.0 + std::exp(-u));
}

double FittedParameter::coordinate(double v) const {
  if (transform == Transform::linear) return v / size;
  if (transform == Transform::log) return std::log(v);
  const double share = std::clamp((v - lower) / (upper - lower), 1e-6, 1.0 - 1e-6);
  return std::log(share / (1.0 - share));
}

double FittedParameter::slope(double u) const {
  if (transform == Transform::linear) return size;
  if (transform == Transform::log) return std::exp(u);
  const double share = 1.0 / (1.0 + std::exp(-u));
  return (upper - lower) * share * (1.0 - share);
}

double FittedParameter::lowest_coordinate() const { return coordinate(lower); }
double FittedParameter::highest_coordinate() const { return coordinate(upper); }

double FittedParameter::prior_information() const {
  if (!has_prior) return 0.0;
  const double deviation = is_error() ? 1.0 : prior / slope(coordinate(start));
  return 1.0 / (deviation * deviation);
}

double FittedParameter::prior_distance(double u) const {
  return (u - coordinate(start)) * std::sqrt(prior_information());
}

bool FittedParameter::at_bound(double u) const {
  if (transform != Transform::logit) {
    const double low = lowest_coordinate(), high = highest_coordinate();
    return u < low + 0.01 * (high - low) || u > high - 0.01 * (high - low);
  }
  const double share = 1.0 / (1.0 + std::exp(-u));
  return share < 0.01 || share > 0.99;
}

FittedParameter fitted_parameter(const MechanismDescription& mechanism, const std::string& path, double start,
                                 const Origin& origin) {
  FittedParameter p;
  p.path = path;
  p.place.emplace_back(mechanism, path, origin);
  p.si_unit = p.place.front().unit();
  p.written_unit = unit_to_say(mechanism, {path}, "");
  p.is_scale = are_scales(mechanism, {path});
  p.start = start;
  if (path.starts_with("error.")) {
    p.transform = Transform::linear;
    p.size = usual_size(mechanism, p.si_unit);
    p.lower = start - kMostSizes * p.size;
    p.upper = start + kMostSizes * p.size;
  } else if (path.ends_with(".restitution")) {
    p.transform = Transform::logit;
    p.lower = 0.01;
    p.upper = 1.0;
  } else {
    p.lower = 0.1 * start;
    p.upper = 10.0 * start;
  }
  return p;
}

}  // namespace boresight
