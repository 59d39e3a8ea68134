// Which combinations of a sweep's further axes its charts draw as curves over the first one: all, or as many as can be told apart.
#pragma once

#include <string>
#include <vector>

#include "boresight_analyses/sweep/sweep_plan.hpp"

namespace boresight::app {

// More curves than this in one panel cannot be told apart.
inline constexpr std::size_t kMostOverlaid = 8;

struct DrawnCombinations {
  // Of axis 1 and on: the places of the values that are drawn, ascending, ends included where there is room for two.
  std::vector<std::vector<std::size_t>> values;
  std::vector<std::size_t> combinations;  // as they run in the grid
  std::size_t all = 1;                    // how many the grid has

  // "" where all are drawn.
  std::string sentence(const SweepPlan& plan) const;
};

DrawnCombinations drawn_combinations(const SweepPlan& plan);

}  // namespace boresight::app
