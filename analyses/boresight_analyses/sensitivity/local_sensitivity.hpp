// The index around the middle of the scatter, one parameter at a time, all others at their medians.
//
// Derivatives by central differences at three steps, a half, a quarter and an eighth of the parameter's sd. Impacts make the
// maximum of a motion a rough function of any parameter: a step moves an impact, and the largest error is then another
// one's. Where the three differ by more than a quarter of the largest the derivative says nothing, and is marked so. The
// swing from the 5 % to the 95 % quantile is a statement about two motions, not about a slope.
#pragma once

#include <array>
#include <limits>
#include <string>
#include <vector>

#include "boresight_analyses/random/random_inputs.hpp"
#include "boresight_analyses/runs/sampling.hpp"

namespace boresight {

struct LocalSensitivity {
  std::string name, si_unit, unit;        // unit: as the study writes it
  std::string told_unit;                  // of its slopes: "1" of scales, si_unit of all others
  double median = 0.0, sd = 0.0;          // of the parameter [SI]
  double low = 0.0, high = 0.0;           // its 5 % and 95 % quantile
  double at_low = 0.0, at_high = 0.0;     // the index there; NaN: that run failed
  std::array<double, 3> step = {};        // of the differences [SI]
  std::array<double, 3> derivative = {};  // of the index by the parameter [SI]; NaN: a run failed
  double spread = 0.0;                    // among them, relative to the largest
  bool meaningful = false;
  bool turns =
      false;  // not, as the index changes alike to either side of the median: an error of either sign about zero
  std::string why_not;                                      // in words
  double exact = std::numeric_limits<double>::quiet_NaN();  // slope of the motion at the medians: exact_slopes.hpp
  bool exact_agrees = false;                                // with the smallest difference, within kSettledSlope
  std::string exact_note;                                   // why there is none, or why it does not agree
};

struct LocalResult {
  double at_medians = 0.0;  // the index with every parameter at its median
  std::vector<LocalSensitivity> parameters;
  bool interrupted = false;
};

inline constexpr double kSettledSlope = 0.25;  // most that the slopes may differ by, relative

LocalResult local_sensitivity(const SampleModel& model, const RandomInputs& inputs, int jobs,
                              const std::function<bool()>& interrupted);

}  // namespace boresight
