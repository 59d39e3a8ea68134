// The elastic part of a normal law: force over penetration, with its slope, energy and inverse, for every shape a law has.
//
//   point        F = K d^(3/2)                      K [N/m^1.5]     Hertz (1882): spheres
//   linear       F = K d                            K [N/m]         spring
//   logarithmic  d = (F / K) ln(B / F)              K [N/m]         half-space cylinders (Johnson, Radzimovsky, ...)
//   conformal    F = K d sqrt(d / (2 (l + d)))      K [N/m]         Liu et al.
//   power        F = K d (d / l)^(n - 1)            K [N/m]         Pereira et al.
// The logarithmic one is inverted through w = K d / F, which solves w - ln w = ln(l / d), l = B / K, on the branch w > 1. It
// ends where dd/dF = 0, at w = 1; from w = 2 on, d = 2 l / e^2, the force goes on along its tangent, out of the law's range.
// Templated on the scalar: select instead of branches within a curve; the curve itself is the same for all lanes.
#pragma once

#include <algorithm>

#include "boresight/math/scalar.hpp"

namespace boresight {

enum class ElasticCurve { point, linear, logarithmic, conformal, power };

inline constexpr double kLogarithmicEnd = 0.2706705664732254;  // 2 / e^2

// w with w - ln w = s, w >= 2. Newton; g = w - ln w - s is convex, and the start lies within 0.1 of the answer.
template <typename T>
T logarithmic_ratio(const T& s) {
  using std::log;
  T w = s + log(s) + T(0.4);
  for (int k = 0; k < 4; ++k) w = w * (s - T(1.0) + log(w)) / (w - T(1.0));
  return w;
}

// All for d > 0.
template <typename T>
T curve_force(ElasticCurve curve, const T& K, const T& l, const T& n, const T& d) {
  using std::log;
  using std::pow;
  using std::sqrt;
  switch (curve) {
    case ElasticCurve::point:
      return K * d * sqrt(d);
    case ElasticCurve::linear:
      return K * d;
    case ElasticCurve::logarithmic: {
      const T end = l * T(kLogarithmicEnd);
      const T inside = select(d < end, d, end);
      return K * inside / logarithmic_ratio(T(log(l / inside))) + K * positive_part(T(d - end));
    }
    case ElasticCurve::conformal:
      return K * d * sqrt(d / (T(2.0) * (l + d)));
    case ElasticCurve::power:
      return K * d * pow(T(d / l), T(n - T(1.0)));
  }
  return T(0.0);
}

template <typename T>
T curve_slope(ElasticCurve curve, const T& K, const T& l, const T& n, const T& d) {
  using std::log;
  using std::pow;
  using std::sqrt;
  switch (curve) {
    case ElasticCurve::point:
      return T(1.5) * K * sqrt(d);
    case ElasticCurve::linear:
      return K;
    case ElasticCurve::logarithmic: {
      const T end = l * T(kLogarithmicEnd);
      return K / (logarithmic_ratio(T(log(l / select(d < end, d, end)))) - T(1.0));
    }
    case ElasticCurve::conformal: {
      const T x = d / (l + d);
      return K * sqrt(T(0.5) * x) * (T(1.5) - T(0.5) * x);
    }
    case ElasticCurve::power:
      return n * K * pow(T(d / l), T(n - T(1.0)));
  }
  return T(0.0);
}

// Integral of the force [J].
template <typename T>
T curve_energy(ElasticCurve curve, const T& K, const T& l, const T& n, const T& d) {
  using std::asinh;
  using std::sqrt;
  switch (curve) {
    case ElasticCurve::point:
      return T(0.4) * K * d * d * sqrt(d);
    case ElasticCurve::linear:
      return T(0.5) * K * d * d;
    case ElasticCurve::logarithmic: {
      const T end = l * T(kLogarithmicEnd);
      const T inside = select(d < end, d, end), beyond = d - inside;
      const T F = curve_force(curve, K, l, n, inside);
      return T(0.5) * F * inside - T(0.25) * F * F / K + beyond * (F + T(0.5) * K * beyond);
    }
    case ElasticCurve::conformal: {
      const T x = d / l;
      // The closed form cancels where x is small.
      const T small = x * x * sqrt(x) * (T(0.4) - x * (T(1.0 / 7.0) - x * (T(1.0 / 12.0) - x * T(5.0 / 88.0))));
      const T whole = T(0.25) * (T(2.0) * x - T(3.0)) * sqrt(x * (x + T(1.0))) + T(0.75) * asinh(sqrt(x));
      return K * l * l * T(0.7071067811865475) * select(x < T(0.01), small, whole);
    }
    case ElasticCurve::power:
      return curve_force(curve, K, l, n, d) * d / (n + T(1.0));
  }
  return T(0.0);
}

// Penetration under a load F [m]; zero without one.
inline double curve_depth(ElasticCurve curve, double K, double l, double n, double F) {
  if (!(F > 0.0)) return 0.0;
  switch (curve) {
    case ElasticCurve::point:
      return std::pow(F / K, 2.0 / 3.0);
    case ElasticCurve::linear:
      return F / K;
    case ElasticCurve::logarithmic: {
      const double last = 0.5 * K * l * kLogarithmicEnd;
      return F < last ? F / K * std::log(K * l / F) : l * kLogarithmicEnd + (F - last) / K;
    }
    case ElasticCurve::conformal:
      break;
    case ElasticCurve::power:
      return l * std::pow(F / (K * l), 1.0 / n);
  }
  // d^3 = q (l + d), q = 2 (F / K)^2: Newton from above, where the cubic is convex.
  const double q = 2.0 * (F / K) * (F / K);
  double d = std::cbrt(q * l) + std::sqrt(q);
  for (int k = 0; k < 100; ++k) {
    const double next = d - (d * d * d - q * (l + d)) / (3.0 * d * d - q);
    if (!(std::abs(next - d) > 1e-15 * d)) break;
    d = next;
  }
  return d;
}

}  // namespace boresight
