#include "boresight/lanes/lane_kernel.hpp"
#include "boresight/lanes/lane_kernels.hpp"

namespace boresight {
namespace {
struct Sse2;
}  // namespace

void run_lanes_sse2(const LaneJob* jobs, long count, const LaneSettings& settings, LaneOutcome* outcomes) {
  lane_kernel<2, Sse2>(jobs, count, settings, outcomes);
}

}  // namespace boresight
