#include "boresight/lanes/lane_kernel.hpp"
#include "boresight/lanes/lane_kernels.hpp"

namespace boresight {
namespace {
struct Sse2;
}  // namespace

void run_lanes_sse2(const LaneJob* jobs, long count, const LaneSettings& settings, LaneOutcome* outcomes) {
  lane_kernel<2, Sse2, double>(jobs, count, settings, outcomes);
}

void run_lanes_sse2_single(const LaneJob* jobs, long count, const LaneSettings& settings, LaneOutcome* outcomes) {
  lane_kernel<4, Sse2, float>(jobs, count, settings, outcomes);
}

}  // namespace boresight
