// One instruction set's kernel: included by the lanes_*.cpp, each compiled for its processor.
#pragma once

#include "boresight/lanes/lane_integrator.hpp"

namespace boresight {

template <int W, typename Target>
void lane_kernel(const LaneJob* jobs, long count, const LaneSettings& settings, LaneOutcome* outcomes) {
  if (count == 0) return;
  switch (jobs[0].scene->layout->n) {
    case 3: return LaneIntegrator<W, Target, 3>(jobs[0], settings).run(jobs, count, outcomes);
    case 5: return LaneIntegrator<W, Target, 5>(jobs[0], settings).run(jobs, count, outcomes);
    default: return LaneIntegrator<W, Target, 0>(jobs[0], settings).run(jobs, count, outcomes);
  }
}

}  // namespace boresight
