// What lets one line of physics serve double, SIMD lanes and automatic derivatives: choice without branching.
//
// Code templated on the scalar T writes select(condition, a, b) where plain code would write an if, and asks any(condition)
// before work that no lane needs. For double a condition is a bool; a lane type brings its own mask and overloads.
#pragma once

#include <cmath>

namespace boresight {

inline bool any(bool condition) { return condition; }

template <typename T>
inline T select(bool condition, const T& when_true, const T& when_false) {
  return condition ? when_true : when_false;
}

// a b + c. Lanes round it once where the processor can; plain numbers round the product first.
template <typename T>
inline T fused(const T& a, const T& b, const T& c) {
  return a * b + c;
}

// In how many parts a long sum is formed: lanes wait for nothing else in between.
template <typename T>
struct PartsOfSum {
  static constexpr int count = 1;
};

// start + the sum of `count` products. S: the scalar of a, T of b.
template <typename S, typename T>
inline T sum_of_products(int count, const S* a, const T* b, const T& start = T(0.0)) {
  constexpr int kParts = PartsOfSum<T>::count;
  T part[kParts] = {start};
  for (int r = 1; r < kParts; ++r) part[r] = T(0.0);
  int k = 0;
  for (; k + kParts <= count; k += kParts)
    for (int r = 0; r < kParts; ++r) part[r] = fused(T(a[k + r]), b[k + r], part[r]);
  for (; k < count; ++k) part[0] = fused(T(a[k]), b[k], part[0]);
  T sum = part[0];
  for (int r = 1; r < kParts; ++r) sum = sum + part[r];
  return sum;
}

// max(x, 0) by value; the derivative of an inactive branch is zero.
template <typename T>
inline T positive_part(const T& x) {
  return select(x > T(0.0), x, T(0.0));
}

// What stands in for no length where a direction is asked for: its square is still a number of the scalar's kind.
template <typename T>
struct TinyLength {
  static constexpr double square = 1e-60;
};
template <>
struct TinyLength<float> {
  static constexpr double square = 1e-30;
};

// Length from its square, with a derivative everywhere: a vector of no length has some tiny one, and so a direction.
template <typename T>
inline T length_from_square(const T& square) {
  using std::sqrt;
  return sqrt(select(square > T(TinyLength<T>::square), square, T(TinyLength<T>::square)));
}

// Scalars with powers and exponentials, which laws off the common path need; a lane type may do without.
namespace powers {
using std::exp;
using std::log;
using std::pow;
using std::tanh;
template <typename T>
concept Present = requires(const T& x) {
  exp(x);
  log(x);
  pow(x, x);
  tanh(x);
};
}  // namespace powers
template <typename T>
concept HasPowers = powers::Present<T>;

}  // namespace boresight
