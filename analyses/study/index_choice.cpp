#include "boresight_analyses/study/index_choice.hpp"

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
      {"position_error", "m", "position error", &PointingIndices::position_error,
       PointingQuantity::position_error},
      {"orientation_error", "rad", "orientation error", &PointingIndices::orientation_error,
       PointingQuantity::orientation_error},
      {"boresight_error", "rad", "boresight error", &PointingIndices::boresight_error,
       PointingQuantity::boresight_error},
      {"line_of_sight_error", "rad", "line-of-sight error", &PointingIndices::line_of_sight_error,
       PointingQuantity::line_of_sight_error},
  };
  return names;
}

const std::vector<StatisticName>& statistic_names() {
  static const std::vector<StatisticName> names = {
      {"max", "maximum", &Statistics::max},
      {"rms", "RMS", &Statistics::rms},
      {"mean", "mean", &Statistics::mean},
      {"p99.73", "99.73 % of the time below", &Statistics::p9973},
  };
  return names;
}

double IndexChoice::of(const PointingIndices& indices) const {
  return indices.*named(quantity_names(), quantity).statistics.*named(statistic_names(), statistic).value;
}

std::string IndexChoice::si_unit() const { return named(quantity_names(), quantity).si_unit; }

std::string IndexChoice::title() const {
  return quantity_title() + ", " +
         named(statistic_names(), statistic).title;
}

std::string IndexChoice::quantity_title() const { return named(quantity_names(), quantity).title; }

PointingQuantity IndexChoice::kind() const { return named(quantity_names(), quantity).kind; }

}  // namespace boresight
