// A parameter, or several that share a value, that an optimisation may choose within bounds:
//
//   [[match.variable]]
//   parameter = "payload.mass"       # one path, or a list of paths that take the same value
//   from = "0 kg"
//   to = "150 kg"
//   starts = ["1 kg", "60 kg"]       # where searches begin; the middle if left out
//   scale = "linear"                 # or log: the search then sees the logarithm
#pragma once

#include <span>
#include <string>
#include <vector>

#include "boresight/io/cursor.hpp"
#include "boresight/mechanism/mechanism.hpp"
#include "boresight/mechanism/parameter_path.hpp"
#include "boresight_analyses/study/legal_corners.hpp"

namespace boresight {

struct DesignVariable {
  std::vector<std::string> paths;
  std::string si_unit;
  std::string unit;  // in which `from` is written: "mm"; "" for a pure number
  double from = 0.0, to = 0.0;
  bool log = false;
  std::vector<double> starts;
  std::vector<ParameterPath> places;
  Origin from_at = {}, to_at = {};  // where they are written

  const std::string& name() const { return paths.front(); }
  // The search's own scale.
  double to_search(double value) const;
  double from_search(double x) const;
  double slope_of_search(double x) const;  // d value / d x
  BoxSide side() const;
};

// Throws InputError. Whether a mechanism takes its bounds is for check_corners() to say, of all variables together.
DesignVariable read_design_variable(Cursor& entry, const MechanismDescription& mechanism);

}  // namespace boresight
