// One instruction set's kernel: included by the lanes_*.cpp, each compiled for its processor.
#pragma once

#include "boresight/lanes/lane_integrator.hpp"

namespace boresight {

template <int W, typename Target, typename Real>
void lane_kernel(const LaneJob* jobs, long count, const LaneSettings& settings, LaneOutcome* outcomes) {
  if (count == 0) return;
  using T = Lanes<W, Target, Real>;
  const SceneLayout& layout = *jobs[0].scene->layout;
  if (SingleRevoluteLayout::describes(layout))
    LaneIntegrator<T, SingleRevoluteLayout>(jobs[0], settings).run(jobs, count, outcomes);
  else if (layout.n == 5)
    LaneIntegrator<T, SizedLayout<5>>(jobs[0], settings).run(jobs, count, outcomes);
  else
    LaneIntegrator<T, SizedLayout<0>>(jobs[0], settings).run(jobs, count, outcomes);
}

}  // namespace boresight
