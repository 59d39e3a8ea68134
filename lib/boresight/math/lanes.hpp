// Several samples side by side in one SIMD register: a scalar for the templates of the contact laws and the dynamics, on Highway's vectors
// (github.com/google/highway), so that every processor that Highway knows is served by one source.
//
// Lanes<W, Target, Real> behaves like Real, double or float; comparisons give a LaneMask, to be used through select() and any()
// (scalar.hpp). W is how many of them a register holds, Target a tag of the instruction set that the translation unit is
// compiled for: it makes every template instance a different type, so that code made for one processor is never linked into
// another's. The unit says before this header that it is compiled for one processor: HWY_COMPILE_ONLY_STATIC, or, for plain numbers,
// HWY_COMPILE_ONLY_SCALAR.
// Sums and products are rounded one by one but in fused(), square roots and quotients exactly: a lane gives the same bits as
// its neighbours do, on every instruction set that has a fused multiply-add, and on every one that has none.
#pragma once

#if !defined(HWY_COMPILE_ONLY_STATIC) && !defined(HWY_COMPILE_ONLY_SCALAR)
#error "define HWY_COMPILE_ONLY_STATIC or HWY_COMPILE_ONLY_SCALAR before boresight/math/lanes.hpp"
#endif
#define HWY_DISABLE_PCLMUL_AES  // Highway takes a processor for wide only if it encrypts too, which nothing here asks for
#include <hwy/highway.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <type_traits>

#include "boresight/math/scalar.hpp"
#include "boresight/math/types.hpp"

namespace boresight {

namespace hn = hwy::HWY_NAMESPACE;  // of the unit's instruction set

// Which lanes a comparison holds in: what the processor keeps it in.
template <int W, typename Target, typename Real>
struct LaneMask {
  using Tag = hn::CappedTag<Real, W>;
  using Storage = hn::Mask<Tag>;
  static_assert(hn::MaxLanes(Tag()) == W, "W is what a register of this instruction set holds");

  LaneMask() = default;
  explicit LaneMask(Storage wanted) : m(wanted) {}
  static LaneMask all(bool on) { return LaneMask(hn::FirstN(Tag(), on ? std::size_t{W} : 0)); }
  bool lane(int i) const { return (bits() >> i) & 1; }
  void set(int i, bool on) {
    const std::uint64_t wanted = on ? bits() | (std::uint64_t{1} << i) : bits() & ~(std::uint64_t{1} << i);
    m = hn::LoadMaskBits(Tag(), reinterpret_cast<const std::uint8_t*>(&wanted));
  }

  friend LaneMask operator&(const LaneMask& a, const LaneMask& b) { return LaneMask(hn::And(a.m, b.m)); }
  friend LaneMask operator|(const LaneMask& a, const LaneMask& b) { return LaneMask(hn::Or(a.m, b.m)); }
  friend LaneMask operator!(const LaneMask& a) { return LaneMask(hn::Not(a.m)); }
  friend LaneMask select(const LaneMask& where, const LaneMask& a, const LaneMask& b) {
    return (where & a) | ((!where) & b);
  }
  friend bool any(const LaneMask& a) { return !hn::AllFalse(Tag(), a.m); }

  Storage m;

 private:
  std::uint64_t bits() const {
    std::uint64_t found = 0;  // Highway writes up to eight bytes
    hn::StoreMaskBits(Tag(), m, reinterpret_cast<std::uint8_t*>(&found));
    return found;
  }
};

template <int W, typename Target, typename Real = double>
struct Lanes {
  using Mask = LaneMask<W, Target, Real>;
  using Tag = typename Mask::Tag;
  using Vector = hn::Vec<Tag>;
  using Number = Real;
  static constexpr int kWidth = W;
  static constexpr bool kSingle = std::is_same_v<Real, float>;

  Lanes() = default;
  Lanes(double all) : v(hn::Set(Tag(), static_cast<Real>(all))) {}  // NOLINT: the same in every lane
  explicit Lanes(Vector wanted) : v(wanted) {}
  static Lanes load(const Real* from) { return Lanes(hn::LoadU(Tag(), from)); }
  Real lane(int i) const {
    Real x;
    std::memcpy(&x, reinterpret_cast<const char*>(&v) + sizeof(Real) * static_cast<std::size_t>(i), sizeof x);
    return x;
  }
  void set(int i, double number) {
    const Real x = static_cast<Real>(number);
    std::memcpy(reinterpret_cast<char*>(&v) + sizeof(Real) * static_cast<std::size_t>(i), &x, sizeof x);
  }

  Lanes& operator+=(const Lanes& b) { return *this = *this + b; }
  Lanes& operator-=(const Lanes& b) { return *this = *this - b; }
  Lanes& operator*=(const Lanes& b) { return *this = *this * b; }
  Lanes& operator/=(const Lanes& b) { return *this = *this / b; }
  friend Lanes operator+(const Lanes& a, const Lanes& b) { return Lanes(hn::Add(a.v, b.v)); }
  friend Lanes operator-(const Lanes& a, const Lanes& b) { return Lanes(hn::Sub(a.v, b.v)); }
  friend Lanes operator*(const Lanes& a, const Lanes& b) { return Lanes(hn::Mul(a.v, b.v)); }
  friend Lanes operator/(const Lanes& a, const Lanes& b) { return Lanes(hn::Div(a.v, b.v)); }
  friend Lanes operator-(const Lanes& a) { return Lanes(hn::Neg(a.v)); }
  friend Mask operator>(const Lanes& a, const Lanes& b) { return Mask(hn::Gt(a.v, b.v)); }
  friend Mask operator<(const Lanes& a, const Lanes& b) { return Mask(hn::Lt(a.v, b.v)); }
  friend Mask operator>=(const Lanes& a, const Lanes& b) { return Mask(hn::Ge(a.v, b.v)); }
  friend Mask operator<=(const Lanes& a, const Lanes& b) { return Mask(hn::Le(a.v, b.v)); }

  friend Lanes select(const Mask& where, const Lanes& a, const Lanes& b) {
    return Lanes(hn::IfThenElse(where.m, a.v, b.v));
  }
  friend Lanes fused(const Lanes& a, const Lanes& b, const Lanes& c) { return Lanes(hn::MulAdd(a.v, b.v, c.v)); }
  friend Lanes sqrt(const Lanes& a) { return Lanes(hn::Sqrt(a.v)); }
  // Neither infinite nor not a number; by the bits, for compilers may be told that there are only finite numbers.
  friend Mask is_finite(const Lanes& a) { return Mask(hn::IsFinite(a.v)); }
  friend Lanes abs(const Lanes& a) { return Lanes(hn::Abs(a.v)); }
  // Met on the rim of a tilted cap only. Single precision: Abramowitz and Stegun (1964), Handbook of Mathematical Functions, 4.4.46,
  // off by 2e-8 at most; double precision: one lane after the other.
  friend Lanes acos(const Lanes& a) {
    if constexpr (kSingle) {
      constexpr double c[] = {1.5707963050, -0.2145988016, 0.0889789874, -0.0501743046,
                              0.0308918810, -0.0170881256, 0.0066700901, -0.0012624911};
      const Lanes x = abs(a);
      Lanes sum(c[7]);
      for (int k = 6; k >= 0; --k) sum = fused(sum, x, Lanes(c[k]));
      const Lanes angle = sqrt(Lanes(1.0) - x) * sum;
      return select(a < Lanes(0.0), Lanes(3.14159265358979323846) - angle, angle);
    }
    Lanes angle;
    for (int i = 0; i < W; ++i) angle.set(i, std::acos(a.lane(i)));
    return angle;
  }

  Vector v;
};

template <int W, typename Target, typename Real>
inline Lanes<W, Target, Real> larger(const Lanes<W, Target, Real>& a, const Lanes<W, Target, Real>& b) {
  return select(a > b, a, b);
}
template <int W, typename Target, typename Real>
inline Lanes<W, Target, Real> smaller(const Lanes<W, Target, Real>& a, const Lanes<W, Target, Real>& b) {
  return select(a < b, a, b);
}

template <int W, typename Target>
struct TinyLength<Lanes<W, Target, float>> : TinyLength<float> {};
template <int W, typename Target, typename Real>
struct PartsOfSum<Lanes<W, Target, Real>> {
  static constexpr int count = 4;
};

}  // namespace boresight

namespace Eigen {
template <int W, typename Target, typename Scalar>
struct NumTraits<boresight::Lanes<W, Target, Scalar>> : NumTraits<Scalar> {
  using Real = boresight::Lanes<W, Target, Scalar>;
  using NonInteger = Real;
  using Nested = Real;
  using Literal = double;
  enum { RequireInitialization = 0 };
};
}  // namespace Eigen
