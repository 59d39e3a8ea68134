// One instruction set's kernel: included by the lanes_*.cpp, each compiled for its processor.
#pragma once

#include "boresight/lanes/lane_integrator.hpp"
#include "boresight/lanes/lane_row_step.hpp"
#include "boresight/lanes/lane_window_step.hpp"

namespace boresight {

// Subnormal numbers cost a hundred times others and mean nothing here: while this lives they are zero.
class NoSubnormals {
 public:
#if defined(__SSE2__)
  NoSubnormals() : before_(_mm_getcsr()) { _mm_setcsr(before_ | 0x8040u); }  // flush to zero, denormals are zero
  ~NoSubnormals() { _mm_setcsr(before_); }

 private:
  unsigned before_;
#endif
};

// Of the form that one revolute joint with play has. T: Lanes, or what has their interface.
template <typename T>
void accelerations_kernel(const LaneJob* jobs, long count, const LaneSettings& settings, LaneOutcome* outcomes) {
  if (count == 0) return;
  [[maybe_unused]] const NoSubnormals here;
  LaneIntegrator<T, LaneRowStep<T, SingleRevoluteLayout>>(jobs[0], settings).run(jobs, count, outcomes);
}

template <int W, typename Target, typename Real>
void lane_kernel(const LaneJob* jobs, long count, const LaneSettings& settings, LaneOutcome* outcomes) {
  if (count == 0) return;
  using T = Lanes<W, Target, Real>;
  if (jobs[0].scene->form == SceneForm::accelerations) return accelerations_kernel<T>(jobs, count, settings, outcomes);
  [[maybe_unused]] const NoSubnormals here;
  LaneIntegrator<T, LaneWindowStep<T>>(jobs[0], settings).run(jobs, count, outcomes);
}

}  // namespace boresight
