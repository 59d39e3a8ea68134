// Turns accepted states into a RunResult: indices over every step, samples at the spacing asked for, peaks,
// clearances. Shared by all rungs.
#pragma once

#include "boresight/formulations/force_elements.hpp"
#include "boresight/mechanism/ideal_motion.hpp"
#include "boresight/rungs/rung.hpp"

namespace boresight {

class MotionRecorder {
 public:
  // expected_steps: to reserve room for the indices.
  MotionRecorder(const Mechanism& mechanism, const IdealMotion& ideal, const RunOptions& options,
                 double expected_steps);

  // One accepted state: motion and acceleration of the boresight body. Returns the pose error. bound: errors
  // to count instead of those of this pose (a rung that bounds each index on its own).
  const PoseError& accept(double t, const BodyMotion& body, const BodyAcceleration& acceleration,
                          const PoseError* bound = nullptr);
  // Whether a state at t, accepted next, will be sampled.
  bool wants_sample(double t) const { return spacing_ > 0.0 && t >= (samples_ - kSlack) * spacing_; }
  // True if the state accepted last is to be sampled: then call the two below, bodies first.
  bool sampling() const { return sampling_; }
  // The bodies to sample then: those asked for, and all of them where the sample is a frame.
  const std::vector<int>& bodies_wanted() const { return framing_ ? bodies_of_frame_ : bodies_of_sample_; }
  void sample_body(int wanted, const BodyMotion& body,
                   const BodyAcceleration& acceleration);  // wanted: index in those
  void sample_clearance(int clearance, const PlayMotion<double>& motion,
                        const std::array<ContactState<double>, kContactPlaces>& contact);

  double position_error_max() const { return position_error_max_; }
  RunResult finish();

 private:
  static constexpr double kSlack = 1e-6;  // of the spacing, so that rounding of t does not shift a sample by a step
  PoseSample pose_sample(int body, const BodyMotion& motion, const BodyAcceleration& acceleration) const;

  const Mechanism& mechanism_;
  const IdealMotion& ideal_;
  double spacing_, frame_spacing_;
  double samples_ = 0.0, frames_ = 0.0;  // spacings until the next one: a sum of spacings would drift off them
  double t_ = 0.0, position_error_max_ = 0.0;
  bool sampling_ = false, framing_ = false;
  const bool watched_;  // by the caller, who hears an interruption through RunOptions::progress
  unsigned accepted_ = 0;
  std::vector<int> bodies_of_sample_, bodies_of_frame_;
  double start_;
  IndicesOverTime indices_;
  PoseError error_;
  RunResult result_;
};

}  // namespace boresight
