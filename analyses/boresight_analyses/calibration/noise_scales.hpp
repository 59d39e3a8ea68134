// What the scale s of the noise may be, given residuals, where suspects c ~ N(0, 1) may have made part of them: their prior does not grow with
// the noise, so that s is not integrated out in closed form beside them. In coordinates of c in which its prior's matrix is 1 and that of the
// data diagonal,
//
//   -2 log p(s, c) = n log s^2 + (rr + 2 g'c + c' Lambda c) / (s^2 D) + known - 2 m'c + c'c        any log s as probable
//
// c is normal given s; over log s by the trapezoidal rule, which is exact to rounding where steps are half a standard deviation of log s.
// Without suspects s is integrated out: log p = -n / (2 D) log rr - known / 2 (Zellner 1971, section 3.1), as one scale, s^2 = rr / n.
#pragma once

#include <vector>

#include "boresight/math/types.hpp"

namespace boresight {

struct ScaledResiduals {
  double rr = 0.0;
  VecX g, lambda;      // of the data
  double known = 0.0;  // of the priors where c = 0
  VecX m;
  double values = 0.0;     // n, less what is integrated out as any as probable
  double flattened = 1.0;  // D: n is n / D
  double told = 0.0;       // s^2 where the data leave nothing to tell it by; else 0
};

struct NoiseScale {
  double square = 1.0;      // s^2 D
  double log_weight = 0.0;  // with the step of log s
  VecX c;                   // most probable
};

std::vector<NoiseScale> noise_scales(const ScaledResiduals& residuals);

}  // namespace boresight
