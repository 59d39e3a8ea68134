// The perturbation rung for many samples at once: one index of each, several samples a SIMD register.
//
//   PerturbationLanes lanes(mechanism, PointingQuantity::position_error);
//   lanes.run(samples, outcomes);            // const: share it between threads
//
// Where the rung itself (make_rung("perturbation", ...)) gives a whole pointing history, this gives the statistics of one
// index and a summary of the contacts. The index is |G(t) (z, eps)|, first order in the deviation z and the standing errors eps: against the rung's own, which
// displaces the bodies by finite turns, it differs by the deviation squared (1e-6 of the index where that is 1 mrad).
// A sample's outcome is the same to the last bit whatever runs beside it, on every processor with fused multiply-adds (AVX2 or
// later; those without agree among each other) and for any split of the
// samples into calls (in double precision with contacts on a tilted rim: where the C library gives the same arc cosine).
#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <span>

#include "boresight/lanes/lane_kernels.hpp"
#include "boresight/scene/scene_rung.hpp"

namespace boresight {

// The tolerance at which the default scene's index is converged to 1 % (maximum) and 0.5 % (RMS) at 0.1 to 0.3 mm and 0 to
// 500 kg; measured in tests/lib/lanes.
inline constexpr double kLaneTolerance = 1e-3;

// Down to this tolerance single precision is enough: its rounding, some 1e-6 of a contact's force, stays far below the error
// that a step may have. Half the numbers' size is twice the lanes. Measured in tests/lib/lanes.
inline constexpr double kSinglePrecisionTolerance = 2e-4;
constexpr LanePrecision lane_precision(double tolerance) {
  return tolerance < kSinglePrecisionTolerance ? LanePrecision::double_precision : LanePrecision::single_precision;
}

// Samples that come out one by one, and work that can be stopped.
struct LaneWatch {
  const std::atomic<bool>* stop = nullptr;  // once it is set, run() returns soon; what was not reached says so
  // Called as each sample's outcome is there, in the order in which they end, from the thread that called run(). attempts: steps
  // tried so far, of all samples together. What it throws leaves run().
  std::function<void(std::size_t sample, double attempts)> ended = {};
  // Called before it, as so many samples are prepared and their motions begin; those prepared before have all ended by then.
  std::function<void(std::size_t samples, double attempts)> prepared = {};
};

class PerturbationLanes {
 public:
  // Whether all joints' play has lanes: journals with Hertz's geometry and any damping factor, modified Coulomb friction or none.
  static bool serve(const Mechanism& mechanism);
  // Throws ComputationError near a singular pose, as the rung does.
  // start: the index's statistics leave out what comes before [s]. typical: StandingCurvature.
  PerturbationLanes(std::shared_ptr<const Mechanism> mechanism, PointingQuantity quantity, double start = 0.0,
                    std::vector<double> typical = {});
  ~PerturbationLanes();

  // tolerance: largest error of one step in an offset, relative to its clearance c, and in its rate, relative to the speed
  // sqrt(c a) that a free flight across the clearance reaches under the scene's accelerations a; where several joints have play,
  // the quickest of their flights counts for all.
  // outcomes: as many as samples.
  void run(std::span<const Parameters> samples, std::span<LaneOutcome> outcomes, double tolerance = kLaneTolerance,
           const LaneWatch& watch = {}) const;
  // With one instruction set's kernel in particular.
  void run(const LaneTarget& target, std::span<const Parameters> samples, std::span<LaneOutcome> outcomes,
           double tolerance = kLaneTolerance, const LaneWatch& watch = {}) const;

  // What being linear in the sample's standing errors may change of its index (largest value [m or rad]), relative: StandingCurvature.
  double error_of_linearity(const Parameters& sample, double index) const;

 private:
  struct Prepared;
  struct ErrorsOverTime;
  struct Batch;
  void add(const Parameters& sample, double tolerance, Batch& to) const;
  // start: what the drawing's is changed to.
  void add_errors(const Parameters& sample, const Prepared& prepared, SceneStart& start, Batch& to) const;
  std::shared_ptr<const ErrorsOverTime> errors_for(const std::shared_ptr<const PreparedScene>& scene) const;
  std::shared_ptr<const Prepared> prepared_for(const Parameters& parameters) const;
  std::shared_ptr<const TimeTable> gain_over_time(const PreparedScene& scene) const;

  std::shared_ptr<const Mechanism> mechanism_;
  PointingQuantity quantity_;
  double start_;
  std::vector<double> typical_errors_;
  double longest_step_ = 0.0;  // across which loads and motion change little [s]
  struct Cache;
  std::unique_ptr<Cache> cache_;
};

}  // namespace boresight
