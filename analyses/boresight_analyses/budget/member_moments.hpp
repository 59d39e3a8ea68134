// Mean and standard deviation of an index by its values in the members, as each interpretation takes them (contributor.hpp).
#pragma once

#include <vector>

#include "boresight/math/types.hpp"
#include "boresight_analyses/budget/interpretation.hpp"

namespace boresight {

struct Moments {
  double mean = 0.0, sd = 0.0;
};

// Of one axis. members[k]: the index' values over time in member k.
Moments moments_of(const std::vector<std::vector<Vec3>>& members, Eigen::Index axis, Interpretation interpretation);

}  // namespace boresight
