#define HWY_COMPILE_ONLY_STATIC
#include "boresight/lanes/lane_kernel.hpp"
#include "boresight/lanes/lane_kernels.hpp"

namespace boresight {
namespace {
struct Avx2;
}  // namespace

void run_lanes_avx2(const LaneJob* jobs, long count, const LaneSettings& settings, LaneOutcome* outcomes) {
  lane_kernel<4, Avx2, double>(jobs, count, settings, outcomes);
}

void run_lanes_avx2_single(const LaneJob* jobs, long count, const LaneSettings& settings, LaneOutcome* outcomes) {
  lane_kernel<8, Avx2, float>(jobs, count, settings, outcomes);
}

}  // namespace boresight
