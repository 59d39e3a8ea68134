// Steps against contact frequencies on the mechanism's own motion: how far off the index is, and where the
// run is stopped.
//
// The contacts' stiffness is scaled, which moves their frequency (as its cube root: a softer contact is also
// deeper); each column is one stiffness, each row one step of the rung. Against each column's own smallest
// steps.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "boresight_analyses/stability/followed_motion.hpp"
#include "boresight_analyses/study/index_choice.hpp"

namespace boresight {

struct StepMap {
  std::string rung, index;
  std::vector<double> frequency;  // of the stiffest contact foreseen [rad/s], ascending
  std::vector<double> step;       // [s], ascending
  // [step][frequency], relative; infinite where the run was stopped, NaN where it was not tried.
  std::vector<std::vector<double>> error;
  std::vector<double> scatter;        // of the column's smallest steps, relative: what the errors are uncertain by
  std::vector<double> refused_above;  // per frequency: smallest step that was stopped [s]; 0: none was
  std::string first_stop;             // what the rung said the first time
};

StepMap map_steps(const std::shared_ptr<const Mechanism>& mechanism, const FollowedMotion& followed,
                  const IndexChoice& index, const std::function<bool()>& advance);
inline constexpr int kStepMapColumns = 9;

}  // namespace boresight
