#define HWY_COMPILE_ONLY_SCALAR
#include "boresight/lanes/lane_kernel.hpp"
#include "boresight/lanes/lane_kernels.hpp"

namespace boresight {
namespace {
struct Scalar;
}  // namespace

void run_lanes_scalar(const LaneJob* jobs, long count, const LaneSettings& settings, LaneOutcome* outcomes) {
  lane_kernel<1, Scalar, double>(jobs, count, settings, outcomes);
}

void run_lanes_scalar_single(const LaneJob* jobs, long count, const LaneSettings& settings, LaneOutcome* outcomes) {
  lane_kernel<1, Scalar, float>(jobs, count, settings, outcomes);
}

}  // namespace boresight
