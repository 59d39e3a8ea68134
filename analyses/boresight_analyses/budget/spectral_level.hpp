// Noise contributors by both ways: what the windows' filters leave of their spectrum, integrated over frequency (noise.hpp), and what the
// indices take of the members' simulated courses. They are two computations of one number, and are flagged where they differ.
//
// The mean squares of the members are independent. Their mean is taken as a chi-squared variable over its degrees of freedom f, which follow
// from its scatter over the members (Satterthwaite 1946), and its cube root as normal with mean 1 - 2 / (9 f) and variance 2 / (9 f)
// (Wilson and Hilferty 1931), with Student's factor in place of the normal one as f is only estimated. A flag goes up where the
// filters' value lies outside of that interval and is more than kTolerable off. kFalseFlags is the probability that a budget in which nothing
// differs has any flag.
#pragma once

#include <string>
#include <vector>

#include "boresight_analyses/budget/budget_plan.hpp"

namespace boresight {

struct SpectralLevel {
  std::string contributor;
  ErrorIndex index = ErrorIndex::ape;
  double by_filter = 0.0;                         // root mean square on one axis, over members and time [of the index]
  double simulated = 0.0, low = 0.0, high = 0.0;  // the same of the members, and its interval
  bool differs = false;
  double above_sampling = 0.0;  // share of the noise's variance above half the sampling's frequency
};

inline constexpr double kTolerable = 0.02;   // relative, of the root mean square
inline constexpr double kFalseFlags = 0.01;  // in a budget

// Of every contributor with a spectrum and every index that the plan has, in their order; of the plan's members.
std::vector<SpectralLevel> spectral_levels(const BudgetPlan& plan);

}  // namespace boresight
