// Limit states in standard normal space whose probability is known.
#pragma once

#include <gsl/gsl_cdf.h>

#include <algorithm>
#include <cmath>

#include "boresight_analyses/statistics/batch_model.hpp"

namespace boresight::problems {

template <typename F>
BatchModel pointwise(F f) {
  return [f](const Points& points) {
    std::vector<double> values;
    for (const Point& p : points) values.push_back(f(p));
    return values;
  };
}

inline double phi(double x) { return gsl_cdf_ugaussian_P(x); }

// y > beta has the probability phi(-beta) in any dimension.
inline double linear(const Point& u) {
  double sum = 0.0;
  for (const double x : u) sum += x;
  return sum / std::sqrt(double(u.size()));
}
// All of them beyond: phi(-beta)^d.
inline double parallel(const Point& u) { return *std::min_element(u.begin(), u.end()); }
// Two regions on opposite sides: 2 phi(-beta).
inline double two_sided(const Point& u) { return std::abs(linear(u)); }

}  // namespace boresight::problems
