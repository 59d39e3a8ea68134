// The kernels, one an instruction set and precision. Of one precision all that fuse give the same bits, and
// all that do not; they differ in how many samples go side by side.
#pragma once

#include "boresight/lanes/lane_batch.hpp"

namespace boresight {

enum class LanePrecision { single_precision, double_precision };

void run_lanes_scalar(const LaneJob* jobs, long count, const LaneSettings& settings, LaneOutcome* outcomes);
void run_lanes_sse4(const LaneJob* jobs, long count, const LaneSettings& settings, LaneOutcome* outcomes);
void run_lanes_neon(const LaneJob* jobs, long count, const LaneSettings& settings, LaneOutcome* outcomes);
void run_lanes_avx2(const LaneJob* jobs, long count, const LaneSettings& settings, LaneOutcome* outcomes);
void run_lanes_avx512(const LaneJob* jobs, long count, const LaneSettings& settings, LaneOutcome* outcomes);
void run_lanes_scalar_single(const LaneJob* jobs, long count, const LaneSettings& settings, LaneOutcome* outcomes);
void run_lanes_sse4_single(const LaneJob* jobs, long count, const LaneSettings& settings, LaneOutcome* outcomes);
void run_lanes_neon_single(const LaneJob* jobs, long count, const LaneSettings& settings, LaneOutcome* outcomes);
void run_lanes_avx2_single(const LaneJob* jobs, long count, const LaneSettings& settings, LaneOutcome* outcomes);
void run_lanes_avx512_single(const LaneJob* jobs, long count, const LaneSettings& settings, LaneOutcome* outcomes);

struct LaneTarget {
  const char* name;
  int lanes;
  bool fuses;  // with fused multiply-adds
  LaneKernel kernel;
};

// Those that were built and this processor runs, widest first. Throws ComputationError where there are none.
const std::vector<LaneTarget>& lane_targets(LanePrecision precision);

}  // namespace boresight
