// Mean and standard deviation of an index by its values in the members, as each interpretation takes them (contributor.hpp).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "boresight/math/types.hpp"
#include "boresight_analyses/budget/interpretation.hpp"

namespace boresight {

struct Moments {
  double mean = 0.0, sd = 0.0;
};

// What the moments need of one member's values over time.
struct MemberSums {
  double count = 0.0;
  Vec3 sum = Vec3::Zero(), most = Vec3::Zero();  // most: the largest size of each axis
  Mat3 squares = Mat3::Zero();                   // sum of v v^T
};
MemberSums sums_of(const std::vector<Vec3>& values);
std::vector<MemberSums> sums_of(const std::vector<std::vector<Vec3>>& members);

// Of one axis. times: how often each member counts, in a bootstrap; empty: once.
Moments moments_of(std::span<const MemberSums> members, Eigen::Index axis, Interpretation interpretation,
                   std::span<const std::uint32_t> times = {});
// How the axes vary together: over members and time, or of the temporal interpretation in the member with the largest mean square. Of the
// ensemble interpretation the axes' maxima are taken for independent.
Mat3 covariance_of(std::span<const MemberSums> members, Interpretation interpretation,
                   std::span<const std::uint32_t> times = {});

// B with B B^T of these deviations and the correlations of this covariance, whose negative principal parts, as a difference or rounding may
// have them, are none.
Mat3 factor_with(const Mat3& covariance, const Vec3& deviations);

}  // namespace boresight
