// Slopes of a matching's objective by its variables, for descents that go by gradients: exact ones of the perturbation rung's
// motion (index_slopes.hpp), where there are such.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "boresight/rungs/rung.hpp"
#include "boresight_analyses/matching/matching_plan.hpp"
#include "boresight_analyses/study/index_choice.hpp"

namespace boresight {

// Why a plan's objective has no slopes, whatever its motions; empty where it may have.
std::string why_no_slopes(const MatchingPlan& plan);

class DesignSlopes {
 public:
  // `plan` must outlive it; why_no_slopes(plan) is empty. run: the offset at the start.
  DesignSlopes(std::shared_ptr<const Mechanism> mechanism, const MatchingPlan& plan, IndexChoice index,
               const RunOptions& run);

  // By each variable [SI]; none where impacts part the motion's neighbours before its end, or it cannot be followed: `why`
  // says which.
  std::optional<std::vector<double>> at(const std::vector<double>& design, std::string& why) const;

 private:
  std::shared_ptr<const Mechanism> mechanism_;
  const MatchingPlan& plan_;
  IndexChoice index_;
  double start_offset_;
};

}  // namespace boresight
