// Several samples side by side in one SIMD register: a scalar for the templates of the contact laws and the dynamics.
//
// Lanes<W, Target, Real> behaves like Real, double or float; comparisons give a LaneMask, to be used through select() and any()
// (scalar.hpp). W is how many of them a register holds, Target a tag of the instruction set that the translation unit is
// compiled for: it makes every template instance a different type, so that code made for one processor is never linked into
// another's.
// Sums and products are rounded one by one but in fused(), square roots and quotients exactly: a lane gives the same bits as
// its neighbours do, on every instruction set that has a fused multiply-add, and on every one that has none.
#pragma once

#include <cmath>
#include <cstdint>
#include <type_traits>

#if defined(__AVX512F__) || defined(__AVX__) || defined(__SSE2__)
#include <immintrin.h>
#endif

#include "boresight/math/scalar.hpp"
#include "boresight/math/types.hpp"

namespace boresight {

// The numbers of one register, and the integers that a comparison of them gives.
template <int W, typename Real>
struct Register {
  using Integer = std::conditional_t<sizeof(Real) == 8, std::int64_t, std::int32_t>;
  using Numbers [[gnu::vector_size(W * sizeof(Real))]] = Real;
  using Integers [[gnu::vector_size(W * sizeof(Real))]] = Integer;
};
// One lane: plain numbers.
template <typename Real>
struct Register<1, Real> {
  using Integer = std::conditional_t<sizeof(Real) == 8, std::int64_t, std::int32_t>;
  using Numbers = Real;
  using Integers = Integer;
};

// Element i of a register, and a comparison as a mask of integers.
template <typename V>
auto element(const V& v, int i) {
  if constexpr (std::is_arithmetic_v<V>)
    return v;
  else
    return v[i];
}
template <typename V, typename X>
void set_element(V& v, int i, X x) {
  if constexpr (std::is_arithmetic_v<V>)
    v = x;
  else
    v[i] = x;
}
template <typename Integer, typename M>
auto as_mask(const M& compared) {
  if constexpr (std::is_same_v<M, bool>)
    return static_cast<Integer>(compared ? -1 : 0);
  else
    return compared;
}

// Which lanes a comparison holds in: a bit each where the processor has registers for that, else a whole integer each.
template <int W, typename Target, typename Real>
struct LaneMask {
  static constexpr int kBytes = W * static_cast<int>(sizeof(Real));
#if defined(__AVX512F__)
  static constexpr bool kBits = kBytes == 64;
#else
  static constexpr bool kBits = false;
#endif
  using Bits = std::conditional_t<W == 16, std::uint16_t, std::uint8_t>;
  using Integer = typename Register<W, Real>::Integer;
  using Storage = std::conditional_t<kBits, Bits, typename Register<W, Real>::Integers>;
  static constexpr Bits kAllBits = static_cast<Bits>(~Bits{});

  LaneMask() = default;
  explicit LaneMask(Storage wanted) requires(!std::is_same_v<Storage, bool>) : m(wanted) {}
  static LaneMask all(bool on) {
    if constexpr (kBits)
      return LaneMask(on ? kAllBits : Bits{});
    else
      return LaneMask(Storage{} - (on ? 1 : 0));
  }
  bool lane(int i) const {
    if constexpr (kBits)
      return (m >> i) & 1;
    else
      return element(m, i) != 0;
  }
  void set(int i, bool on) {
    if constexpr (kBits)
      m = static_cast<Bits>(on ? m | (1 << i) : m & ~(1 << i));
    else
      set_element(m, i, Integer{on ? -1 : 0});
  }

  friend LaneMask operator&(const LaneMask& a, const LaneMask& b) { return LaneMask(static_cast<Storage>(a.m & b.m)); }
  friend LaneMask operator|(const LaneMask& a, const LaneMask& b) { return LaneMask(static_cast<Storage>(a.m | b.m)); }
  friend LaneMask operator!(const LaneMask& a) { return LaneMask(static_cast<Storage>(~a.m)); }
  friend LaneMask select(const LaneMask& where, const LaneMask& a, const LaneMask& b) {
    return (where & a) | ((!where) & b);
  }

  Storage m;
};

template <int W, typename Target, typename Real>
inline bool any(const LaneMask<W, Target, Real>& mask) {
  using Mask = LaneMask<W, Target, Real>;
  if constexpr (Mask::kBits) return mask.m != 0;
#if defined(__AVX__)
  if constexpr (Mask::kBytes == 32) return _mm256_movemask_ps((__m256)mask.m) != 0;
#endif
#if defined(__SSE2__)
  if constexpr (Mask::kBytes == 16) return _mm_movemask_ps((__m128)mask.m) != 0;
#endif
  bool found = false;
  for (int i = 0; i < W; ++i) found = found || mask.lane(i);
  return found;
}

template <int W, typename Target, typename Real = double>
struct Lanes {
  using Vector = typename Register<W, Real>::Numbers;
  using Mask = LaneMask<W, Target, Real>;
  using Number = Real;
  static constexpr int kWidth = W;
  static constexpr bool kSingle = std::is_same_v<Real, float>;

  Lanes() = default;
  Lanes(double all) : v(static_cast<Real>(all) - Vector{}) {}  // NOLINT: a number is the same number in every lane
  explicit Lanes(Vector wanted) requires(!std::is_arithmetic_v<Vector>) : v(wanted) {}
  Real lane(int i) const { return element(v, i); }
  void set(int i, double x) { set_element(v, i, static_cast<Real>(x)); }

  Lanes& operator+=(const Lanes& b) { return v += b.v, *this; }
  Lanes& operator-=(const Lanes& b) { return v -= b.v, *this; }
  Lanes& operator*=(const Lanes& b) { return v *= b.v, *this; }
  Lanes& operator/=(const Lanes& b) { return v /= b.v, *this; }
  friend Lanes operator+(const Lanes& a, const Lanes& b) { return Lanes(a.v + b.v); }
  friend Lanes operator-(const Lanes& a, const Lanes& b) { return Lanes(a.v - b.v); }
  friend Lanes operator*(const Lanes& a, const Lanes& b) { return Lanes(a.v * b.v); }
  friend Lanes operator/(const Lanes& a, const Lanes& b) { return Lanes(a.v / b.v); }
  friend Lanes operator-(const Lanes& a) { return Lanes(-a.v); }
  friend Mask operator>(const Lanes& a, const Lanes& b) {
#if defined(__AVX512F__)
    if constexpr (Mask::kBits && kSingle) return Mask(_mm512_cmp_ps_mask((__m512)a.v, (__m512)b.v, _CMP_GT_OQ));
    if constexpr (Mask::kBits && !kSingle) return Mask(_mm512_cmp_pd_mask((__m512d)a.v, (__m512d)b.v, _CMP_GT_OQ));
#endif
    if constexpr (!Mask::kBits) return Mask(as_mask<typename Mask::Integer>(a.v > b.v));
  }
  friend Mask operator<(const Lanes& a, const Lanes& b) {
#if defined(__AVX512F__)
    if constexpr (Mask::kBits && kSingle) return Mask(_mm512_cmp_ps_mask((__m512)a.v, (__m512)b.v, _CMP_LT_OQ));
    if constexpr (Mask::kBits && !kSingle) return Mask(_mm512_cmp_pd_mask((__m512d)a.v, (__m512d)b.v, _CMP_LT_OQ));
#endif
    if constexpr (!Mask::kBits) return Mask(as_mask<typename Mask::Integer>(a.v < b.v));
  }
  friend Mask operator>=(const Lanes& a, const Lanes& b) {
#if defined(__AVX512F__)
    if constexpr (Mask::kBits && kSingle) return Mask(_mm512_cmp_ps_mask((__m512)a.v, (__m512)b.v, _CMP_GE_OQ));
    if constexpr (Mask::kBits && !kSingle) return Mask(_mm512_cmp_pd_mask((__m512d)a.v, (__m512d)b.v, _CMP_GE_OQ));
#endif
    if constexpr (!Mask::kBits) return Mask(as_mask<typename Mask::Integer>(a.v >= b.v));
  }
  friend Mask operator<=(const Lanes& a, const Lanes& b) {
#if defined(__AVX512F__)
    if constexpr (Mask::kBits && kSingle) return Mask(_mm512_cmp_ps_mask((__m512)a.v, (__m512)b.v, _CMP_LE_OQ));
    if constexpr (Mask::kBits && !kSingle) return Mask(_mm512_cmp_pd_mask((__m512d)a.v, (__m512d)b.v, _CMP_LE_OQ));
#endif
    if constexpr (!Mask::kBits) return Mask(as_mask<typename Mask::Integer>(a.v <= b.v));
  }

  friend Lanes select(const Mask& where, const Lanes& a, const Lanes& b) {
#if defined(__AVX512F__)
    if constexpr (Mask::kBits && kSingle) return Lanes((Vector)_mm512_mask_blend_ps(where.m, (__m512)b.v, (__m512)a.v));
    if constexpr (Mask::kBits && !kSingle)
      return Lanes((Vector)_mm512_mask_blend_pd(where.m, (__m512d)b.v, (__m512d)a.v));
#endif
    if constexpr (!Mask::kBits) return Lanes(where.m ? a.v : b.v);
  }
  friend Lanes fused(const Lanes& a, const Lanes& b, const Lanes& c) {
    [[maybe_unused]] constexpr int kBytes = Mask::kBytes;
#if defined(__AVX512F__)
    if constexpr (kBytes == 64 && kSingle) return Lanes((Vector)_mm512_fmadd_ps((__m512)a.v, (__m512)b.v, (__m512)c.v));
    if constexpr (kBytes == 64 && !kSingle)
      return Lanes((Vector)_mm512_fmadd_pd((__m512d)a.v, (__m512d)b.v, (__m512d)c.v));
#endif
#if defined(__FMA__)
    if constexpr (kBytes == 32 && kSingle) return Lanes((Vector)_mm256_fmadd_ps((__m256)a.v, (__m256)b.v, (__m256)c.v));
    if constexpr (kBytes == 32 && !kSingle)
      return Lanes((Vector)_mm256_fmadd_pd((__m256d)a.v, (__m256d)b.v, (__m256d)c.v));
#endif
    return Lanes(a.v * b.v + c.v);
  }
  friend Lanes sqrt(const Lanes& a) {
    [[maybe_unused]] constexpr int kBytes = Mask::kBytes;
#if defined(__AVX512F__)  // with a mask, for GCC warns of the plain ones
    if constexpr (kBytes == 64 && kSingle) return Lanes((Vector)_mm512_maskz_sqrt_ps(Mask::kAllBits, (__m512)a.v));
    if constexpr (kBytes == 64 && !kSingle) return Lanes((Vector)_mm512_maskz_sqrt_pd(Mask::kAllBits, (__m512d)a.v));
#endif
#if defined(__AVX__)
    if constexpr (kBytes == 32 && kSingle) return Lanes((Vector)_mm256_sqrt_ps((__m256)a.v));
    if constexpr (kBytes == 32 && !kSingle) return Lanes((Vector)_mm256_sqrt_pd((__m256d)a.v));
#endif
#if defined(__SSE2__)
    if constexpr (kBytes == 16 && kSingle) return Lanes((Vector)_mm_sqrt_ps((__m128)a.v));
    if constexpr (kBytes == 16 && !kSingle) return Lanes((Vector)_mm_sqrt_pd((__m128d)a.v));
#endif
    Lanes root;
    for (int i = 0; i < W; ++i) root.set(i, std::sqrt(a.lane(i)));
    return root;
  }
  // Neither infinite nor not a number; by the bits, for compilers may be told that there are only finite numbers.
  friend Mask is_finite(const Lanes& a) {
#if defined(__AVX512F__) && defined(__AVX512DQ__)
    constexpr int kNotFinite = 0x99;  // quiet and signalling, positive and negative
    if constexpr (Mask::kBits && kSingle) return !Mask(_mm512_fpclass_ps_mask((__m512)a.v, kNotFinite));
    if constexpr (Mask::kBits && !kSingle) return !Mask(_mm512_fpclass_pd_mask((__m512d)a.v, kNotFinite));
#endif
    using Integer = typename Mask::Integer;
    constexpr Integer kExponent = kSingle ? Integer{0x7f800000} : static_cast<Integer>(0x7ff0000000000000);
    if constexpr (!Mask::kBits) {
      const auto bits = __builtin_bit_cast(typename Register<W, Real>::Integers, a.v);
      return Mask(as_mask<Integer>((bits & kExponent) != kExponent));
    }
  }
  friend Lanes abs(const Lanes& a) { return Lanes(a.v < Real(0) ? -a.v : a.v); }
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
