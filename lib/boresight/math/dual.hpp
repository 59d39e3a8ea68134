// A number and its derivatives with respect to N others, carried along exactly (forward automatic differentiation).
//
// T is double or lanes. Only what the contact laws use; where Ceres is at hand its Jet does the same for double, but not for
// lanes, whose comparisons give masks.
// Source: Griewank and Walther (2008), Evaluating Derivatives, chapter 3.
#pragma once

#include <concepts>
#include <utility>

#include "boresight/math/scalar.hpp"
#include "boresight/math/types.hpp"

namespace boresight {

template <typename T, int N>
struct Dual {
  T a;     // value
  T v[N];  // derivatives

  Dual() = default;
  Dual(double value)  // NOLINT: a constant
      requires(!std::same_as<T, double>)
      : Dual(T(value)) {}
  Dual(const T& value) : Dual(each(value, [](int) { return T(0.0); })) {}  // NOLINT
  // The k-th of the N others.
  Dual(const T& value, int k) : Dual(each(value, [k](int i) { return T(i == k ? 1.0 : 0.0); })) {}

  Dual& operator+=(const Dual& b) { return *this = *this + b; }
  Dual& operator-=(const Dual& b) { return *this = *this - b; }
  Dual& operator*=(const Dual& b) { return *this = *this * b; }

  friend Dual operator+(const Dual& x, const Dual& y) {
    return each(x.a + y.a, [&](int k) { return x.v[k] + y.v[k]; });
  }
  friend Dual operator-(const Dual& x, const Dual& y) {
    return each(x.a - y.a, [&](int k) { return x.v[k] - y.v[k]; });
  }
  friend Dual operator-(const Dual& x) {
    return each(-x.a, [&](int k) { return -x.v[k]; });
  }
  friend Dual operator*(const Dual& x, const Dual& y) {
    return each(x.a * y.a, [&](int k) { return fused(x.v[k], y.a, x.a * y.v[k]); });
  }
  friend Dual operator/(const Dual& x, const Dual& y) {
    const T inverse = T(1.0) / y.a, q = x.a * inverse;
    return each(q, [&, minus = -q](int k) { return fused(minus, y.v[k], x.v[k]) * inverse; });
  }
  // With a constant: fewer operations than with a Dual whose derivatives are zero.
  friend Dual operator+(const Dual& x, const T& c) { return plus(x, x.a + c); }
  friend Dual operator+(const T& c, const Dual& x) { return plus(x, c + x.a); }
  friend Dual operator-(const Dual& x, const T& c) { return plus(x, x.a - c); }
  friend Dual operator-(const T& c, const Dual& x) {
    return each(c - x.a, [&](int k) { return -x.v[k]; });
  }
  friend Dual operator*(const Dual& x, const T& c) {
    return each(x.a * c, [&](int k) { return x.v[k] * c; });
  }
  friend Dual operator*(const T& c, const Dual& x) {
    return each(c * x.a, [&](int k) { return c * x.v[k]; });
  }
  friend Dual operator/(const Dual& x, const T& c) {
    const T inverse = T(1.0) / c;
    return each(x.a * inverse, [&](int k) { return x.v[k] * inverse; });
  }
  friend Dual operator/(const T& c, const Dual& x) {
    const T inverse = T(1.0) / x.a, q = c * inverse, slope = -q * inverse;
    return each(q, [&](int k) { return slope * x.v[k]; });
  }

  friend auto operator>(const Dual& x, const Dual& y) { return x.a > y.a; }
  friend auto operator<(const Dual& x, const Dual& y) { return x.a < y.a; }
  friend auto operator>(const Dual& x, const T& c) { return x.a > c; }
  friend auto operator<(const Dual& x, const T& c) { return x.a < c; }

  friend Dual sqrt(const Dual& x) {
    using std::sqrt;
    const T root = sqrt(x.a), slope = T(0.5) / root;
    return each(root, [&](int k) { return slope * x.v[k]; });
  }
  friend Dual acos(const Dual& x) {
    using std::acos;
    using std::sqrt;
    const T slope = T(-1.0) / sqrt(T(1.0) - x.a * x.a);
    return each(acos(x.a), [&](int k) { return slope * x.v[k]; });
  }
  template <typename Condition>
  requires(!std::same_as<Condition, bool>)  // one bool for the whole is scalar.hpp's
      friend Dual select(const Condition& where, const Dual& x, const Dual& y) {
    return each(choose(where, x.a, y.a), [&](int k) { return choose(where, x.v[k], y.v[k]); });
  }

 private:
  // Without a loop: compilers keep a struct's numbers in registers where every index is a constant from the start.
  template <typename F, int... K>
  static Dual written_out(const T& value, F derivative, std::integer_sequence<int, K...>) {
    Dual result;
    result.a = value;
    ((result.v[K] = derivative(K)), ...);
    return result;
  }
  template <typename Condition>
  static T choose(const Condition& where, const T& x, const T& y) {
    return select(where, x, y);
  }
  static Dual plus(const Dual& x, const T& value) {
    Dual result = x;
    result.a = value;
    return result;
  }
  template <typename F>
  static Dual each(const T& value, F derivative) {
    return written_out(value, derivative, std::make_integer_sequence<int, N>());
  }
};

template <typename T, int N>
struct TinyLength<Dual<T, N>> : TinyLength<T> {};

}  // namespace boresight

namespace Eigen {
template <typename T, int N>
struct NumTraits<boresight::Dual<T, N>> : NumTraits<double> {
  using Real = boresight::Dual<T, N>;
  using NonInteger = Real;
  using Nested = Real;
  using Literal = double;
  enum { RequireInitialization = 1 };
};
}  // namespace Eigen
