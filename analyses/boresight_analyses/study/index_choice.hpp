// Which single number of a motion a study is about: a pointing error and its statistic over time.
#pragma once

#include <string>
#include <vector>

#include "boresight/pointing/indices.hpp"

namespace boresight {

// The words of the study file and of summary.json, each with the unit of its values.
struct QuantityName {
  const char* name;
  const char* si_unit;
  const char* title;  // for people
  Statistics PointingIndices::*statistics;
  double PoseError::*size;
  PointingQuantity kind;
  const char* definition;  // a sentence
};
const std::vector<QuantityName>&
quantity_names();  // position_error, orientation_error, boresight_error, line_of_sight_error

struct StatisticName {
  const char* name;
  const char* title;
  double Statistics::*value;
  const char* definition;  // a sentence
};
const std::vector<StatisticName>& statistic_names();  // max, rms, mean, p99.73

struct IndexChoice {
  std::string quantity = "position_error";
  std::string statistic = "max";
  double start = 0.0;  // what the motion does before is left out [s]

  // Throws std::out_of_range if one of the names is unknown; a study file's are checked when read. Not a number for a line
  // of sight of a motion that has none.
  double of(const PointingIndices& indices) const;
  double of(const PoseError& error) const;  // the quantity at one instant
  std::string si_unit() const;
  std::string text() const;            // "position_error.max", and from when on: for identities
  std::string title() const;           // "position error, maximum", and from when on
  std::string quantity_title() const;  // "position error"
  PointingQuantity kind() const;
  std::string definition() const;  // two sentences: of the quantity, of the statistic
};

}  // namespace boresight
