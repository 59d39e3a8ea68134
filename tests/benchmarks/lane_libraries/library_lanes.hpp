// The scalar of the lanes' kernels on another SIMD library than lib/boresight/math/lanes.hpp: same interface, same kernels.
//
// L names the library's types and functions: Number, kWidth, Vector, Bools; all, add, ..., choose, any.
#pragma once

#include <cmath>
#include <cstring>

#include "boresight/math/scalar.hpp"
#include "boresight/math/types.hpp"

namespace boresight::benchmarks {

template <typename L>
struct LibraryMask {
  using Bools = typename L::Bools;
  LibraryMask() = default;
  explicit LibraryMask(Bools wanted) : m(wanted) {}
  static LibraryMask all(bool on) { return LibraryMask(L::all_bools(on)); }
  bool lane(int i) const { return L::bool_at(m, i); }
  void set(int i, bool on) { m = L::with_bool(m, i, on); }
  friend LibraryMask operator&(const LibraryMask& a, const LibraryMask& b) { return LibraryMask(L::both(a.m, b.m)); }
  friend LibraryMask operator|(const LibraryMask& a, const LibraryMask& b) { return LibraryMask(L::either(a.m, b.m)); }
  friend LibraryMask operator!(const LibraryMask& a) { return LibraryMask(L::neither(a.m)); }
  friend LibraryMask select(const LibraryMask& where, const LibraryMask& a, const LibraryMask& b) {
    return (where & a) | ((!where) & b);
  }
  friend bool any(const LibraryMask& a) { return L::any_of(a.m); }

  Bools m;
};

template <typename L>
struct LibraryLanes {
  using Number = typename L::Number;
  using Vector = typename L::Vector;
  using Mask = LibraryMask<L>;
  static constexpr int kWidth = L::kWidth;

  LibraryLanes() = default;
  LibraryLanes(double all)
      : v(L::all(static_cast<Number>(all))) {}  // NOLINT: a number is the same number in every lane
  explicit LibraryLanes(Vector wanted) : v(wanted) {}
  static LibraryLanes load(const Number* from) { return LibraryLanes(L::load(from)); }
  Number lane(int i) const {
    Number number;
    std::memcpy(&number, reinterpret_cast<const char*>(this) + sizeof(Number) * static_cast<std::size_t>(i),
                sizeof number);
    return number;
  }
  void set(int i, double x) {
    const Number number = static_cast<Number>(x);
    std::memcpy(reinterpret_cast<char*>(this) + sizeof(Number) * static_cast<std::size_t>(i), &number, sizeof number);
  }

  LibraryLanes& operator+=(const LibraryLanes& b) { return *this = *this + b; }
  LibraryLanes& operator-=(const LibraryLanes& b) { return *this = *this - b; }
  LibraryLanes& operator*=(const LibraryLanes& b) { return *this = *this * b; }
  LibraryLanes& operator/=(const LibraryLanes& b) { return *this = *this / b; }
  friend LibraryLanes operator+(const LibraryLanes& a, const LibraryLanes& b) { return LibraryLanes(L::add(a.v, b.v)); }
  friend LibraryLanes operator-(const LibraryLanes& a, const LibraryLanes& b) {
    return LibraryLanes(L::subtract(a.v, b.v));
  }
  friend LibraryLanes operator*(const LibraryLanes& a, const LibraryLanes& b) {
    return LibraryLanes(L::multiply(a.v, b.v));
  }
  friend LibraryLanes operator/(const LibraryLanes& a, const LibraryLanes& b) {
    return LibraryLanes(L::divide(a.v, b.v));
  }
  friend LibraryLanes operator-(const LibraryLanes& a) { return LibraryLanes(L::negative(a.v)); }
  friend Mask operator>(const LibraryLanes& a, const LibraryLanes& b) { return Mask(L::less(b.v, a.v)); }
  friend Mask operator<(const LibraryLanes& a, const LibraryLanes& b) { return Mask(L::less(a.v, b.v)); }
  friend Mask operator>=(const LibraryLanes& a, const LibraryLanes& b) { return Mask(L::not_more(b.v, a.v)); }
  friend Mask operator<=(const LibraryLanes& a, const LibraryLanes& b) { return Mask(L::not_more(a.v, b.v)); }
  friend LibraryLanes select(const Mask& where, const LibraryLanes& a, const LibraryLanes& b) {
    return LibraryLanes(L::choose(where.m, a.v, b.v));
  }
  friend LibraryLanes fused(const LibraryLanes& a, const LibraryLanes& b, const LibraryLanes& c) {
    return LibraryLanes(L::fused(a.v, b.v, c.v));
  }
  friend LibraryLanes sqrt(const LibraryLanes& a) { return LibraryLanes(L::root(a.v)); }
  friend LibraryLanes abs(const LibraryLanes& a) { return LibraryLanes(L::size(a.v)); }
  friend Mask is_finite(const LibraryLanes& a) { return Mask(L::finite(a.v)); }
  // Met on the rim of a tilted cap only.
  friend LibraryLanes acos(const LibraryLanes& a) {
    LibraryLanes angle;
    for (int i = 0; i < kWidth; ++i) angle.set(i, std::acos(a.lane(i)));
    return angle;
  }

  Vector v;
};

template <typename L>
inline LibraryLanes<L> larger(const LibraryLanes<L>& a, const LibraryLanes<L>& b) {
  return select(a > b, a, b);
}
template <typename L>
inline LibraryLanes<L> smaller(const LibraryLanes<L>& a, const LibraryLanes<L>& b) {
  return select(a < b, a, b);
}

}  // namespace boresight::benchmarks

namespace boresight {
template <typename L>
struct TinyLength<benchmarks::LibraryLanes<L>> : TinyLength<typename L::Number> {};
template <typename L>
struct PartsOfSum<benchmarks::LibraryLanes<L>> {
  static constexpr int count = 4;
};
}  // namespace boresight

namespace Eigen {
template <typename L>
struct NumTraits<boresight::benchmarks::LibraryLanes<L>> : NumTraits<typename L::Number> {
  using Real = boresight::benchmarks::LibraryLanes<L>;
  using NonInteger = Real;
  using Nested = Real;
  using Literal = double;
  enum { RequireInitialization = 0 };
};
}  // namespace Eigen
