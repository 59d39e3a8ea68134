// The members of a budget: the mechanism's history of each, its external errors, and both together.
#pragma once

#include <cmath>
#include <map>
#include <vector>

#include "boresight_analyses/budget/budget_runs.hpp"

namespace boresight {

// One component of an error vector, or its length.
class AxisOf {
 public:
  AxisOf(std::size_t axis, std::size_t count)
      : first_(axis < count ? axis : 0), end_(axis < count ? axis + 1 : count) {}
  double size(const Vec3& e) const { return std::sqrt(product(e, e)); }
  double product(const Vec3& a, const Vec3& b) const {
    double sum = 0.0;
    for (std::size_t k = first_; k < end_; ++k)
      sum += a[static_cast<Eigen::Index>(k)] * b[static_cast<Eigen::Index>(k)];
    return sum;
  }

 private:
  std::size_t first_, end_;
};

std::vector<double> sizes_of(const std::vector<Vec3>& values, const AxisOf& axis);

// What is different of a member.
struct MemberVariant {
  int held = -1;    // a group at its medians
  int halved = -1;  // a joint's clearance
};

class BudgetEnsemble {
 public:
  BudgetEnsemble(const BudgetPlan& plan, const BudgetRuns& runs, const SampleStore& store);

  // The mechanism's part; none if that run failed.
  const PointingHistory* mechanism(std::uint64_t member, const MemberVariant& variant = {}) const;
  // What the rung says of its own error in that run, relative to the run's largest value.
  double model_error(std::uint64_t member) const;
  PointingHistory external(std::uint64_t member, std::size_t contributor) const;
  // Both together; without samples if the run failed.
  PointingHistory total(std::uint64_t member, const MemberVariant& variant = {}) const;

 private:
  const BudgetPlan& plan_;
  const BudgetRuns& runs_;
  std::vector<Draws> draws_;
  std::map<std::uint64_t, PointingHistory> histories_;  // by number of the run
  std::map<std::uint64_t, double> model_errors_;        // likewise, of the members as they are drawn
};

// By how much a member's sizes of an index may be too small. error: what the rung and its steps may be off by, relative to the largest value of a
// motion; that of the mechanism alone counts.
double missed_of(const BudgetEnsemble& ensemble, std::uint64_t member, double error, ErrorIndex index,
                 const Windows& windows, const AxisOf& axis);

}  // namespace boresight
