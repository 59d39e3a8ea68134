#define HWY_COMPILE_ONLY_STATIC
#include "boresight/lanes/lane_kernel.hpp"
#include "boresight/lanes/lane_kernels.hpp"

namespace boresight {
namespace {
struct Avx512;
}  // namespace

void run_lanes_avx512(const LaneJob* jobs, long count, const LaneSettings& settings, LaneOutcome* outcomes) {
  lane_kernel<8, Avx512, double>(jobs, count, settings, outcomes);
}

void run_lanes_avx512_single(const LaneJob* jobs, long count, const LaneSettings& settings, LaneOutcome* outcomes) {
  lane_kernel<16, Avx512, float>(jobs, count, settings, outcomes);
}

}  // namespace boresight
