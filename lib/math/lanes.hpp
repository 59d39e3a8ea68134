// Several samples side by side in one SIMD register: a scalar for the templates of the contact laws and the dynamics.
//
// Lanes<W, Target> behaves like double; comparisons give a LaneMask, to be used through select() and any() (scalar.hpp).
// W is the number of doubles of a register, Target a tag of the instruction set that the translation unit is compiled for:
// it makes every template instance a different type, so that code made for one processor is never linked into another's.
// Sums and products are rounded one by one (no fused multiply-add, see lib/lanes/CMakeLists.txt), square roots and quotients
// exactly: a lane gives the same bits as plain double does, on every instruction set.
#pragma once

#include <cmath>
#include <cstdint>
#include <type_traits>

#if defined(__AVX512F__) || defined(__AVX__) || defined(__SSE2__)
#include <immintrin.h>
#endif

#include "boresight/math/types.hpp"
#include "boresight/math/scalar.hpp"

namespace boresight {

// The doubles of one register, and the integers that a comparison of them gives.
template <int W>
struct Register {
  using Doubles [[gnu::vector_size(W * 8)]] = double;
  using Integers [[gnu::vector_size(W * 8)]] = std::int64_t;
};
// One lane: plain numbers.
template <>
struct Register<1> {
  using Doubles = double;
  using Integers = std::int64_t;
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
template <typename M>
auto as_mask(const M& compared) {
  if constexpr (std::is_same_v<M, bool>)
    return static_cast<std::int64_t>(compared ? -1 : 0);
  else
    return compared;
}

// Which lanes a comparison holds in: a bit each where the processor has registers for that, else a whole integer each.
template <int W, typename Target>
struct LaneMask {
#if defined(__AVX512F__)
  static constexpr bool kBits = W == 8;
#else
  static constexpr bool kBits = false;
#endif
  using Storage = std::conditional_t<kBits, std::uint8_t, typename Register<W>::Integers>;

  LaneMask() = default;
  explicit LaneMask(Storage wanted)
    requires(!std::is_same_v<Storage, bool>)
      : m(wanted) {}
  static LaneMask all(bool on) {
    if constexpr (kBits)
      return LaneMask(static_cast<std::uint8_t>(on ? 0xff : 0));
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
      m = static_cast<std::uint8_t>(on ? m | (1 << i) : m & ~(1 << i));
    else
      set_element(m, i, std::int64_t{on ? -1 : 0});
  }

  friend LaneMask operator&(const LaneMask& a, const LaneMask& b) { return LaneMask(static_cast<Storage>(a.m & b.m)); }
  friend LaneMask operator|(const LaneMask& a, const LaneMask& b) { return LaneMask(static_cast<Storage>(a.m | b.m)); }
  friend LaneMask operator!(const LaneMask& a) { return LaneMask(static_cast<Storage>(~a.m)); }
  friend LaneMask select(const LaneMask& where, const LaneMask& a, const LaneMask& b) { return (where & a) | ((!where) & b); }

  Storage m;
};

template <int W, typename Target>
inline bool any(const LaneMask<W, Target>& mask) {
#if defined(__AVX512F__)
  if constexpr (W == 8) return mask.m != 0;
#endif
#if defined(__AVX__)
  if constexpr (W == 4) return _mm256_movemask_pd((__m256d)mask.m) != 0;
#endif
#if defined(__SSE2__)
  if constexpr (W == 2) return _mm_movemask_pd((__m128d)mask.m) != 0;
#endif
  bool found = false;
  for (int i = 0; i < W; ++i) found = found || mask.lane(i);
  return found;
}

template <int W, typename Target>
struct Lanes {
  using Vector = typename Register<W>::Doubles;
  using Mask = LaneMask<W, Target>;
  static constexpr int kWidth = W;

  Lanes() = default;
  Lanes(double all) : v(all - Vector{}) {}  // NOLINT: a number is the same number in every lane
  explicit Lanes(Vector wanted)
    requires(W > 1)
      : v(wanted) {}
  double lane(int i) const { return element(v, i); }
  void set(int i, double x) { set_element(v, i, x); }

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
    if constexpr (W == 8) return Mask(_mm512_cmp_pd_mask((__m512d)a.v, (__m512d)b.v, _CMP_GT_OQ));
#endif
    if constexpr (!Mask::kBits) return Mask(as_mask(a.v > b.v));
  }
  friend Mask operator<(const Lanes& a, const Lanes& b) {
#if defined(__AVX512F__)
    if constexpr (W == 8) return Mask(_mm512_cmp_pd_mask((__m512d)a.v, (__m512d)b.v, _CMP_LT_OQ));
#endif
    if constexpr (!Mask::kBits) return Mask(as_mask(a.v < b.v));
  }
  friend Mask operator>=(const Lanes& a, const Lanes& b) {
#if defined(__AVX512F__)
    if constexpr (W == 8) return Mask(_mm512_cmp_pd_mask((__m512d)a.v, (__m512d)b.v, _CMP_GE_OQ));
#endif
    if constexpr (!Mask::kBits) return Mask(as_mask(a.v >= b.v));
  }
  friend Mask operator<=(const Lanes& a, const Lanes& b) {
#if defined(__AVX512F__)
    if constexpr (W == 8) return Mask(_mm512_cmp_pd_mask((__m512d)a.v, (__m512d)b.v, _CMP_LE_OQ));
#endif
    if constexpr (!Mask::kBits) return Mask(as_mask(a.v <= b.v));
  }

  friend Lanes select(const Mask& where, const Lanes& a, const Lanes& b) {
#if defined(__AVX512F__)
    if constexpr (W == 8) return Lanes((Vector)_mm512_mask_blend_pd(where.m, (__m512d)b.v, (__m512d)a.v));
#endif
    if constexpr (!Mask::kBits) return Lanes(where.m ? a.v : b.v);
  }
  friend Lanes sqrt(const Lanes& a) {
#if defined(__AVX512F__)
    if constexpr (W == 8) return Lanes((Vector)_mm512_maskz_sqrt_pd(0xff, (__m512d)a.v));  // GCC warns of the plain one
#endif
#if defined(__AVX__)
    if constexpr (W == 4) return Lanes((Vector)_mm256_sqrt_pd((__m256d)a.v));
#endif
#if defined(__SSE2__)
    if constexpr (W == 2) return Lanes((Vector)_mm_sqrt_pd((__m128d)a.v));
#endif
    Lanes root;
    for (int i = 0; i < W; ++i) root.set(i, __builtin_sqrt(a.lane(i)));
    return root;
  }
  friend Lanes abs(const Lanes& a) { return Lanes(a.v < 0.0 ? -a.v : a.v); }
  // One lane after the other: met on the rim of a tilted cap only.
  friend Lanes acos(const Lanes& a) {
    Lanes angle;
    for (int i = 0; i < W; ++i) angle.set(i, std::acos(a.lane(i)));
    return angle;
  }

  Vector v;
};

template <int W, typename Target>
inline Lanes<W, Target> larger(const Lanes<W, Target>& a, const Lanes<W, Target>& b) {
  return select(a > b, a, b);
}
template <int W, typename Target>
inline Lanes<W, Target> smaller(const Lanes<W, Target>& a, const Lanes<W, Target>& b) {
  return select(a < b, a, b);
}

}  // namespace boresight

namespace Eigen {
template <int W, typename Target>
struct NumTraits<boresight::Lanes<W, Target>> : NumTraits<double> {
  using Real = boresight::Lanes<W, Target>;
  using NonInteger = Real;
  using Nested = Real;
  using Literal = double;
  enum { RequireInitialization = 0 };
};
}  // namespace Eigen
