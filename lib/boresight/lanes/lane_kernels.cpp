#include "boresight/lanes/lane_kernels.hpp"

#if defined(BORESIGHT_LANES_NEON)
#include <asm/hwcap.h>
#include <sys/auxv.h>
#endif

#include "boresight/mechanism/error.hpp"

namespace boresight {
namespace {

std::vector<LaneTarget> targets_of([[maybe_unused]] bool single) {
  std::vector<LaneTarget> found;
#if defined(BORESIGHT_X86_LANES)
  __builtin_cpu_init();
#if defined(BORESIGHT_LANES_AVX512)
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl") &&
      __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512cd") && __builtin_cpu_supports("fma"))
    found.push_back(single ? LaneTarget{"AVX-512", 16, true, run_lanes_avx512_single}
                           : LaneTarget{"AVX-512", 8, true, run_lanes_avx512});
#endif
#if defined(BORESIGHT_LANES_AVX2)
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") && __builtin_cpu_supports("bmi2"))
    found.push_back(single ? LaneTarget{"AVX2", 8, true, run_lanes_avx2_single}
                           : LaneTarget{"AVX2", 4, true, run_lanes_avx2});
#endif
#if defined(BORESIGHT_LANES_SSE4)
  if (__builtin_cpu_supports("sse4.2") && __builtin_cpu_supports("ssse3"))
    found.push_back(single ? LaneTarget{"SSE4", 4, false, run_lanes_sse4_single}
                           : LaneTarget{"SSE4", 2, false, run_lanes_sse4});
#endif
#endif
#if defined(BORESIGHT_LANES_NEON)
  if (getauxval(AT_HWCAP) & HWCAP_AES)  // it is compiled with what encrypts, for Highway asks for that
    found.push_back(single ? LaneTarget{"NEON", 4, true, run_lanes_neon_single}
                           : LaneTarget{"NEON", 2, true, run_lanes_neon});
#endif
#if defined(BORESIGHT_LANES_SCALAR)
  found.push_back({"scalar", 1, false, single ? run_lanes_scalar_single : run_lanes_scalar});
#endif
  if (found.empty()) throw ComputationError("no kernel that was built runs on this processor (BORESIGHT_LANES)");
  return found;
}

}  // namespace

const std::vector<LaneTarget>& lane_targets(LanePrecision precision) {
  static const std::vector<LaneTarget> single = targets_of(true), twice = targets_of(false);
  return precision == LanePrecision::single_precision ? single : twice;
}

}  // namespace boresight
