#define HWY_COMPILE_ONLY_STATIC
// The lanes' kernel on xsimd's batches, of the widest kind that the compiler's flags allow.
#include <xsimd/xsimd.hpp>

#include "boresight/lanes/lane_kernel.hpp"
#include "lane_libraries/library_lanes.hpp"

namespace boresight {
namespace {

template <typename Real>
struct Xsimd {
  using Number = Real;
  using Vector = xsimd::batch<Real>;
  using Bools = xsimd::batch_bool<Real>;
  static constexpr int kWidth = static_cast<int>(Vector::size);

  static Vector load(const Real* from) { return Vector::load_unaligned(from); }
  static Vector all(Real x) { return Vector(x); }
  static Vector add(const Vector& a, const Vector& b) { return a + b; }
  static Vector subtract(const Vector& a, const Vector& b) { return a - b; }
  static Vector multiply(const Vector& a, const Vector& b) { return a * b; }
  static Vector divide(const Vector& a, const Vector& b) { return a / b; }
  static Vector negative(const Vector& a) { return -a; }
  static Vector fused(const Vector& a, const Vector& b, const Vector& c) { return xsimd::fma(a, b, c); }
  static Vector root(const Vector& a) { return xsimd::sqrt(a); }
  static Vector size(const Vector& a) { return xsimd::abs(a); }
  static Bools less(const Vector& a, const Vector& b) { return a < b; }
  static Bools not_more(const Vector& a, const Vector& b) { return a <= b; }
  static Vector choose(const Bools& where, const Vector& a, const Vector& b) { return xsimd::select(where, a, b); }
  static Bools finite(const Vector& a) {
    // By the bits: the compiler is told that there are only finite numbers.
    using Integer = xsimd::as_integer_t<Vector>;
    using Bits = typename Integer::value_type;
    constexpr Bits kExponent = sizeof(Real) == 4 ? Bits{0x7f800000} : static_cast<Bits>(0x7ff0000000000000);
    const Integer exponent = xsimd::bitwise_cast<Integer>(a) & Integer(kExponent);
    return xsimd::bool_cast(exponent != Integer(kExponent));
  }
  static Bools all_bools(bool on) { return Bools(on); }
  static bool bool_at(const Bools& m, int i) {
    bool values[kWidth];
    m.store_unaligned(values);
    return values[i];
  }
  static Bools with_bool(const Bools& m, int i, bool on) {
    bool values[kWidth];
    m.store_unaligned(values);
    values[i] = on;
    return Bools::load_unaligned(values);
  }
  static Bools both(const Bools& a, const Bools& b) { return a & b; }
  static Bools either(const Bools& a, const Bools& b) { return a | b; }
  static Bools neither(const Bools& a) { return ~a; }
  static bool any_of(const Bools& a) { return xsimd::any(a); }
};

}  // namespace

void run_lanes_on_xsimd(const LaneJob* jobs, long count, const LaneSettings& settings, LaneOutcome* outcomes) {
  accelerations_kernel<benchmarks::LibraryLanes<Xsimd<double>>>(jobs, count, settings, outcomes);
}

void run_lanes_on_xsimd_single(const LaneJob* jobs, long count, const LaneSettings& settings, LaneOutcome* outcomes) {
  accelerations_kernel<benchmarks::LibraryLanes<Xsimd<float>>>(jobs, count, settings, outcomes);
}

}  // namespace boresight
