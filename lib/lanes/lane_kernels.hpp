// The kernels, one an instruction set. All give the same bits; they differ in how many samples go side by side.
#pragma once

#include "boresight/lanes/lane_batch.hpp"

namespace boresight {

void run_lanes_scalar(const LaneJob* jobs, long count, const LaneSettings& settings, LaneOutcome* outcomes);
void run_lanes_sse2(const LaneJob* jobs, long count, const LaneSettings& settings, LaneOutcome* outcomes);
void run_lanes_avx2(const LaneJob* jobs, long count, const LaneSettings& settings, LaneOutcome* outcomes);
void run_lanes_avx512(const LaneJob* jobs, long count, const LaneSettings& settings, LaneOutcome* outcomes);

struct LaneTarget {
  const char* name;
  int lanes;
  LaneKernel kernel;
};

// Those that this processor has, widest first; the scalar one is always there.
const std::vector<LaneTarget>& lane_targets();

}  // namespace boresight
