#include "boresight_analyses/study/index_choice.hpp"

#include <cstdio>
#include <limits>
#include <stdexcept>

namespace boresight {
namespace {

template <typename Names>
const auto& named(const Names& names, const std::string& wanted) {
  for (const auto& entry : names)
    if (wanted == entry.name) return entry;
  throw std::out_of_range("no index is called " + wanted);
}

}  // namespace

const std::vector<QuantityName>& quantity_names() {
  static const std::vector<QuantityName> names = {
      {"position_error", "m", "position error", &PointingIndices::position_error, &PoseError::position,
       PointingQuantity::position_error,
       "Distance of the boresight body's centre of mass from where the ideal motion has it."},
      {"orientation_error", "rad", "orientation error", &PointingIndices::orientation_error, &PoseError::orientation,
       PointingQuantity::orientation_error,
       "Angle by which the boresight body is turned against its ideal orientation."},
      {"boresight_error", "rad", "boresight error", &PointingIndices::boresight_error, &PoseError::boresight,
       PointingQuantity::boresight_error, "Angle between the pointing axis and where the ideal motion has it."},
      {"line_of_sight_error", "rad", "line-of-sight error", &PointingIndices::line_of_sight_error,
       &PoseError::line_of_sight, PointingQuantity::line_of_sight_error,
       "Angle at the target of [pointing] between the true and the ideal reference point, as seen from there."},
  };
  return names;
}

const std::vector<StatisticName>& statistic_names() {
  static const std::vector<StatisticName> names = {
      {"max", "maximum", &Statistics::max, "Largest value over the motion."},
      {"rms", "RMS", &Statistics::rms, "Root of the mean square over the time of the motion."},
      {"mean", "mean", &Statistics::mean, "Mean over the time of the motion."},
      {"p99.73", "99.73 % of the time below", &Statistics::p9973,
       "Value not exceeded for 99.73 % of the time of the motion."},
  };
  return names;
}

double IndexChoice::of(const PointingIndices& indices) const {
  const QuantityName name = named(quantity_names(), quantity);
  const auto value = named(statistic_names(), statistic).value;
  if (name.kind == PointingQuantity::line_of_sight_error && !indices.has_line_of_sight)
    return std::numeric_limits<double>::quiet_NaN();
  return indices.*name.statistics.*value;
}

double IndexChoice::of(const PoseError& error) const { return error.*named(quantity_names(), quantity).size; }

std::string IndexChoice::si_unit() const { return named(quantity_names(), quantity).si_unit; }

std::string IndexChoice::text() const {
  char from[40] = "";
  if (start > 0.0) std::snprintf(from, sizeof from, " from %.17g s", start);
  return quantity + "." + statistic + from;
}

std::string IndexChoice::title() const {
  char from[40] = "";
  if (start > 0.0) std::snprintf(from, sizeof from, " from %.6g s on", start);
  return quantity_title() + ", " + named(statistic_names(), statistic).title + from;
}

std::string IndexChoice::quantity_title() const { return named(quantity_names(), quantity).title; }

std::string IndexChoice::definition() const {
  return std::string(named(quantity_names(), quantity).definition) + " " +
         named(statistic_names(), statistic).definition;
}

PointingQuantity IndexChoice::kind() const { return named(quantity_names(), quantity).kind; }

}  // namespace boresight
