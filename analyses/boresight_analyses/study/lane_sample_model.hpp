// Samples of the perturbation rung, several a SIMD register (PerturbationLanes): for indices that are a statistic of one
// quantity over the whole motion, and for how steadily joints hold; peak accelerations they do not give. Error control chooses the
// steps, so there is no step for all samples to share.
#pragma once

#include <mutex>
#include <optional>

#include "boresight/lanes/perturbation_lanes.hpp"
#include "boresight_analyses/study/rung_sample_model.hpp"

namespace boresight {

class LaneSampleModel final : public SampleModel {
 public:
  // scene_varies: whether masses or gravity scatter; then each sample's scene takes longer to prepare than it does to run.
  // tolerance: PerturbationLanes::run(). typical: StandingCurvature.
  LaneSampleModel(std::shared_ptr<const Mechanism> mechanism, RungSampleModel::ParametersOf parameters_of,
                  IndexChoice index, bool scene_varies, double tolerance = kLaneTolerance,
                  std::vector<double> typical = {});

  // Whether lanes can answer: a maximum, RMS or mean, laws that have lanes, and nothing asked that they do not have. A
  // tolerance without an integrator is theirs.
  static bool serve(const Mechanism& mechanism, const IndexChoice& index, const RunOptions& options);

  std::string rung() const override { return "perturbation"; }
  double step() const override { return 0.0; }
  std::string leaves_out() const override;
  // Lanes run empty towards the end of a batch: 15 % of their time at four samples a lane, 1 % at sixty-four.
  std::size_t batch() const override { return scene_varies_ ? 64 : 1024; }
  void evaluate(std::span<const Sample> samples, std::span<Outcome> outcomes,
                const std::atomic<bool>& stop) const override;
  void evaluate_each(std::span<const Sample> samples, std::span<Outcome> outcomes, const std::atomic<bool>& stop,
                     const std::function<void(std::size_t)>& reached) const override;

 private:
  void take(const LaneOutcome& found, const Parameters& parameters, Outcome& outcome) const;
  double nonlinearity(const Parameters& parameters, const LaneOutcome& found) const;
  double nonlinearity_of_play(const Parameters& parameters, const LaneOutcome& found) const;
  double times_nonlinearity(const std::atomic<bool>& stop) const;

  std::shared_ptr<const Mechanism> mechanism_;
  RungSampleModel::ParametersOf parameters_of_;
  IndexChoice index_;
  bool scene_varies_;
  PerturbationLanes lanes_;
  double tolerance_;
  mutable std::mutex mutex_;
  mutable std::optional<double> times_;  // times_nonlinearity(), once it is known
};

// The model of a rung's samples: pure geometry where there is no play, lanes where they serve, at the tolerance of the options if they
// have one, else runs of the rung one by one.
// scene_varies: whether masses, gravity or springs scatter. typical: StandingCurvature.
std::unique_ptr<SampleModel> sample_model(const std::string& rung, std::shared_ptr<const Mechanism> mechanism,
                                          RungSampleModel::ParametersOf parameters_of, IndexChoice index,
                                          RunOptions options, bool scene_varies, std::vector<double> typical = {});

}  // namespace boresight
