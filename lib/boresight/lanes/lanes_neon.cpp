#define HWY_COMPILE_ONLY_STATIC
#include "boresight/lanes/lane_kernel.hpp"
#include "boresight/lanes/lane_kernels.hpp"

namespace boresight {
namespace {
struct Neon;
}  // namespace

void run_lanes_neon(const LaneJob* jobs, long count, const LaneSettings& settings, LaneOutcome* outcomes) {
  lane_kernel<2, Neon, double>(jobs, count, settings, outcomes);
}

void run_lanes_neon_single(const LaneJob* jobs, long count, const LaneSettings& settings, LaneOutcome* outcomes) {
  lane_kernel<4, Neon, float>(jobs, count, settings, outcomes);
}

}  // namespace boresight
