#include "boresight/lanes/lane_kernels.hpp"

namespace boresight {

const std::vector<LaneTarget>& lane_targets() {
  static const std::vector<LaneTarget> targets = [] {
    std::vector<LaneTarget> found;
#if defined(BORESIGHT_X86_LANES)
    __builtin_cpu_init();
    if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl") &&
        __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512cd") && __builtin_cpu_supports("fma"))
      found.push_back({"AVX-512", 8, run_lanes_avx512});
    if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") && __builtin_cpu_supports("bmi2"))
      found.push_back({"AVX2", 4, run_lanes_avx2});
    found.push_back({"SSE2", 2, run_lanes_sse2});
#endif
    found.push_back({"scalar", 1, run_lanes_scalar});
    return found;
  }();
  return targets;
}

}  // namespace boresight
