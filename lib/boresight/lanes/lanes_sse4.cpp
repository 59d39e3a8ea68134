#define HWY_COMPILE_ONLY_STATIC
#include "boresight/lanes/lane_kernel.hpp"
#include "boresight/lanes/lane_kernels.hpp"

namespace boresight {
namespace {
struct Sse4;
}  // namespace

void run_lanes_sse4(const LaneJob* jobs, long count, const LaneSettings& settings, LaneOutcome* outcomes) {
  lane_kernel<2, Sse4, double>(jobs, count, settings, outcomes);
}

void run_lanes_sse4_single(const LaneJob* jobs, long count, const LaneSettings& settings, LaneOutcome* outcomes) {
  lane_kernel<4, Sse4, float>(jobs, count, settings, outcomes);
}

}  // namespace boresight
