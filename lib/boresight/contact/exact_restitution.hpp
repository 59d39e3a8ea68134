// The member of the family that returns the restitution asked for: h from h (1 + e) = ln[(1 + h) / (1 - h e)], 0 < h < 1/e.
//
// The relation follows from one impact of a mass, m v dv = -F(d) (1 + h v / v0) dd, integrated over closing and parting: the
// two integrals of F over d are equal. It holds for any elastic part F(d), mass and speed. Derived for this program; held
// against integration in a test. h grows without bound as e -> 0 (refused at 0).
#pragma once

#include <cmath>

namespace boresight {

// G(h) / h^2 with G = h (1 + e) - ln(1 + h) + ln(1 - h e); its only zero in (0, 1/e) is the factor. Falls with h.
inline double exact_restitution_defect(double h, double e) {
  if (h > 0.05) return (h * (1.0 + e) - std::log1p(h) + std::log1p(-h * e)) / (h * h);
  // G = sum over k >= 2 of h^k ((-1)^k - e^k) / k: no cancellation.
  double sum = 0.0, power = 1.0, e_power = e * e;
  for (int k = 2; k < 16; ++k, power *= h, e_power *= e) sum += power * ((k % 2 == 0 ? 1.0 : -1.0) - e_power) / k;
  return sum;
}

// e: restitution asked for, 0 < e <= 1. Returns h [-]. The relation is the same for 1/e and -e h: beyond 1 it goes on smoothly, as
// differences about 1 need it.
inline double exact_restitution_damping_factor(double e) {
  if (e > 1.0) return -exact_restitution_damping_factor(1.0 / e) / e;
  if (e == 1.0) return 0.0;
  double low = 0.0, high = 1.0 / e;
  // Regula falsi in Illinois' form would crawl at the pole h = 1/e; halving costs some fifty cheap steps, once a sample.
  for (int k = 0; k < 200 && high - low > 1e-16 * high; ++k) {
    const double middle = 0.5 * (low + high);
    if (middle <= low || middle >= high) break;
    (exact_restitution_defect(middle, e) > 0.0 ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

}  // namespace boresight
