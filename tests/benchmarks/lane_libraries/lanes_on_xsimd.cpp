// The lanes' kernel on xsimd's batches, of the widest kind that the compiler's flags allow, with the interface of math/lanes.hpp.
#define HWY_COMPILE_ONLY_STATIC
#include <xsimd/xsimd.hpp>

#include "boresight/lanes/lane_kernel.hpp"

namespace boresight {
namespace {

template <typename Real>
struct XsimdMask {
  using Storage = xsimd::batch_bool<Real>;
  static constexpr int kWidth = static_cast<int>(xsimd::batch<Real>::size);
  XsimdMask() = default;
  explicit XsimdMask(Storage wanted) : m(wanted) {}
  static XsimdMask all(bool on) { return XsimdMask(Storage(on)); }
  bool lane(int i) const {
    bool values[kWidth];
    m.store_unaligned(values);
    return values[i];
  }
  void set(int i, bool on) {
    bool values[kWidth];
    m.store_unaligned(values);
    values[i] = on;
    m = Storage::load_unaligned(values);
  }
  friend XsimdMask operator&(const XsimdMask& a, const XsimdMask& b) { return XsimdMask(a.m & b.m); }
  friend XsimdMask operator|(const XsimdMask& a, const XsimdMask& b) { return XsimdMask(a.m | b.m); }
  friend XsimdMask operator!(const XsimdMask& a) { return XsimdMask(~a.m); }
  friend XsimdMask select(const XsimdMask& where, const XsimdMask& a, const XsimdMask& b) {
    return (where & a) | ((!where) & b);
  }
  friend bool any(const XsimdMask& a) { return xsimd::any(a.m); }

  Storage m;
};

template <typename Real>
struct XsimdLanes {
  using Number = Real;
  using Vector = xsimd::batch<Real>;
  using Mask = XsimdMask<Real>;
  using L = XsimdLanes;
  static constexpr int kWidth = Mask::kWidth;

  XsimdLanes() = default;
  XsimdLanes(double all) : v(static_cast<Real>(all)) {}  // NOLINT: a number is the same number in every lane
  explicit XsimdLanes(Vector wanted) : v(wanted) {}
  static L load(const Real* from) { return L(Vector::load_unaligned(from)); }
  Real lane(int i) const { return v.get(static_cast<std::size_t>(i)); }
  void set(int i, double x) {
    Real values[kWidth];
    v.store_unaligned(values);
    values[i] = static_cast<Real>(x);
    v = Vector::load_unaligned(values);
  }

  L& operator+=(const L& b) { return v += b.v, *this; }
  L& operator-=(const L& b) { return v -= b.v, *this; }
  L& operator*=(const L& b) { return v *= b.v, *this; }
  L& operator/=(const L& b) { return v /= b.v, *this; }
  friend L operator+(const L& a, const L& b) { return L(a.v + b.v); }
  friend L operator-(const L& a, const L& b) { return L(a.v - b.v); }
  friend L operator*(const L& a, const L& b) { return L(a.v * b.v); }
  friend L operator/(const L& a, const L& b) { return L(a.v / b.v); }
  friend L operator-(const L& a) { return L(-a.v); }
  friend Mask operator>(const L& a, const L& b) { return Mask(a.v > b.v); }
  friend Mask operator<(const L& a, const L& b) { return Mask(a.v < b.v); }
  friend Mask operator>=(const L& a, const L& b) { return Mask(a.v >= b.v); }
  friend Mask operator<=(const L& a, const L& b) { return Mask(a.v <= b.v); }
  friend L select(const Mask& where, const L& a, const L& b) { return L(xsimd::select(where.m, a.v, b.v)); }
  friend L fused(const L& a, const L& b, const L& c) { return L(xsimd::fma(a.v, b.v, c.v)); }
  friend L sqrt(const L& a) { return L(xsimd::sqrt(a.v)); }
  friend L abs(const L& a) { return L(xsimd::abs(a.v)); }
  friend L larger(const L& a, const L& b) { return select(a > b, a, b); }
  friend L smaller(const L& a, const L& b) { return select(a < b, a, b); }
  // By the bits: the compiler is told that there are only finite numbers.
  friend Mask is_finite(const L& a) {
    using Integer = xsimd::as_integer_t<Vector>;
    using Bits = typename Integer::value_type;
    constexpr Bits kExponent = sizeof(Real) == 4 ? Bits{0x7f800000} : static_cast<Bits>(0x7ff0000000000000);
    const Integer exponent = xsimd::bitwise_cast<Integer>(a.v) & Integer(kExponent);
    return Mask(xsimd::bool_cast(exponent != Integer(kExponent)));
  }
  // Met on the rim of a tilted cap only.
  friend L acos(const L& a) {
    L angle;
    for (int i = 0; i < kWidth; ++i) angle.set(i, std::acos(a.lane(i)));
    return angle;
  }

  Vector v;
};

}  // namespace

template <typename Real>
struct TinyLength<XsimdLanes<Real>> : TinyLength<Real> {};
template <typename Real>
struct PartsOfSum<XsimdLanes<Real>> {
  static constexpr int count = 4;
};

}  // namespace boresight

namespace Eigen {
template <typename Scalar>
struct NumTraits<boresight::XsimdLanes<Scalar>> : NumTraits<Scalar> {
  using Real = boresight::XsimdLanes<Scalar>;
  using NonInteger = Real;
  using Nested = Real;
  using Literal = double;
  enum { RequireInitialization = 0 };
};
}  // namespace Eigen

namespace boresight {

void run_lanes_on_xsimd(const LaneJob* jobs, long count, const LaneSettings& settings, LaneOutcome* outcomes) {
  accelerations_kernel<XsimdLanes<double>>(jobs, count, settings, outcomes);
}

void run_lanes_on_xsimd_single(const LaneJob* jobs, long count, const LaneSettings& settings, LaneOutcome* outcomes) {
  accelerations_kernel<XsimdLanes<float>>(jobs, count, settings, outcomes);
}

}  // namespace boresight
