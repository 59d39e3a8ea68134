// A lower bound of a mean of which nothing is known but a value that none lies below: the small-sample answer where Student's t is none, as values are
// few, take a few distinct sizes, and lie skewed between them.
//
// With the values x_1 .. x_n, x_0 = `least`, and D_0 .. D_n the lengths of n + 1 pieces of a unit that n uniform cuts leave, the bound at risk r is
// the r-quantile of sum D_i x_i (Gaffke 2005, Math. Methods Statist. 14, 451-467). Of values that are 0 or 1 it is that of Clopper and
// Pearson. That it holds for all distributions is not proven, and no counterexample known (Learned-Miller, Thomas 2020, arXiv:1905.06208).
//
// The pieces are exponentials over their sum, so that
//   P(sum D_i x_i <= t) = P(sum E_i (x_i - t) <= 0)
//                       = 1/2 - 1/pi integral over u > 0 of sin(sum atan(u w_i)) / (u prod sqrt(1 + u^2 w_i^2)),  w_i = x_i - t   (Imhof 1961,
//   Biometrika 48, 419-426, Eq. 3.2, two degrees of freedom each)
#pragma once

#include <vector>

namespace boresight {

// Throws std::invalid_argument for no values, one that lies below `least`, or a risk not between 0 and 1.
double gaffke_lower(const std::vector<double>& values, double least, double risk);

// P(sum E_i w_i <= 0) for independent exponentials of mean 1; `counts` of each weight, e.g. 3 exponentials of weight 0.5.
struct WeightedExponentials {
  std::vector<double> weights, counts;
};
double probability_not_positive(const WeightedExponentials& sum);

}  // namespace boresight
