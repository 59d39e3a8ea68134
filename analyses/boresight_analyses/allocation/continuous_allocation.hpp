// Tolerances t_j in a box at least total cost under one requirement g(t) <= limit, each with its cost curve:
// NLopt with gradients (SLSQP, held against MMA) in ln t, where reciprocal costs and sums of tolerances are
// both convex.
//
// Where only one requirement binds and no tolerance is at its bound, the optimum is Chase's closed form
// (Chase 1999, "Minimum-cost tolerance allocation", ADCATS report 99-5): dC_j/dt_j + lambda dg/dt_j = 0.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "boresight_analyses/allocation/cost_curve.hpp"
#include "boresight_analyses/allocation/linear_deviation.hpp"

namespace boresight {

struct ContinuousTolerance {
  CostCurve cost;
  double lower = 0.0, upper = 0.0;  // of its tolerance [SI unit of what it is of]
};

// The value that must not exceed the limit, and its gradient where asked for. It may fall as a tolerance widens
// (gaps that work against each other).
using ToleranceRequirement = std::function<double(std::span<const double> tolerance, std::span<double> gradient)>;

struct ContinuousAllocation {
  bool feasible = false;
  bool converged = false;         // the descent came to rest: a local minimum of the price, no proof of a global one
  std::vector<double> tolerance;  // where not feasible those with the least value found
  double price = 0.0;
  double reached = 0.0;  // the requirement's value there
  int evaluations = 0;
  std::string why;  // the algorithm, and its reason
};

// The tolerances with the least value found: the tightest where the requirement rises with each, else by descents
// from the corners that one joint after the other prefers.
std::vector<double> least_tolerances(const std::vector<ContinuousTolerance>& joints,
                                     const ToleranceRequirement& requirement);

ContinuousAllocation allocate_continuous(const std::vector<ContinuousTolerance>& joints,
                                         const ToleranceRequirement& requirement, double limit);

double price_of(const std::vector<ContinuousTolerance>& joints, std::span<const double> tolerance);

// Where zones of width t lie: from `least` to least + t, as gaps do; or, centred, to both sides of it, as errors do.
struct ZonePlaces {
  std::vector<double> least;
  std::vector<bool> centred = {};  // none, if empty
  bool is_centred(std::size_t j) const { return j < centred.size() && centred[j]; }
};

// c_j = least_j + t_j z_jk, z in [0, 1] (centred: [-1/2, 1/2]) from the zone's law: requirements of a linear
// deviation. The deviation must outlive them.
//
// The largest index but the `allowed` ones over the samples. Its gradient is averaged over neighbouring
// ranks, as the order statistic itself has kinks wherever two samples change places.
ToleranceRequirement statistical_tolerances(const LinearDeviation& deviation, std::vector<double> least,
                                            std::vector<std::vector<double>> z, std::int64_t allowed);
// The requirement of the first of its tolerances, the last ones being `fixed`.
ToleranceRequirement with_fixed(ToleranceRequirement of_all, std::vector<double> fixed);
ToleranceRequirement worst_case_tolerances(const LinearDeviation& deviation, ZonePlaces places);
ToleranceRequirement root_sum_square_tolerances(const LinearDeviation& deviation, ZonePlaces places,
                                                double probability);

}  // namespace boresight
