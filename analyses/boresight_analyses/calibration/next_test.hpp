// Which further test would tell most of the parameters: information matrices add.
//
//   D-optimal   log det (H + H_candidate) - log det H          A-optimal   sum of the relative variances,
//   after over before (Pukelsheim 1993, Optimal Design of Experiments, chapter 6)
#pragma once

#include <memory>

#include "boresight_analyses/calibration/inference.hpp"

namespace boresight {

struct Candidate {
  std::string name;
  std::shared_ptr<const Mechanism> mechanism;
};

struct NextTest {
  std::string name;
  double d_gain = 0.0;              // log det of the information, gained
  double a_ratio = 0.0;             // sum of the relative variances, with it over without it
  std::vector<double> error_ratio;  // per free parameter: standard error with it over without it
  std::string refusal;              // why it could not be tried
};

// The candidate followed over its whole motion at 1 kHz on the problem's channels, with their noise; where errors alone are fitted, at as
// many instants as the runs have on average. The variance of an error is relative to what it may well be (FittedParameter::size).
NextTest judge_candidate(const CalibrationProblem& problem, const Inference& inference, const Globals& globals,
                         const std::vector<bool>& fixed, const Candidate& candidate);

}  // namespace boresight
