// Samples of the perturbation rung, several a SIMD register (PerturbationLanes): for indices that are a statistic of one
// quantity over the whole motion. Error control chooses the steps, so there is no step for all samples to share.
#pragma once

#include "boresight/lanes/perturbation_lanes.hpp"
#include "boresight_analyses/study/rung_sample_model.hpp"

namespace boresight {

class LaneSampleModel final : public SampleModel {
 public:
  LaneSampleModel(std::shared_ptr<const Mechanism> mechanism, RungSampleModel::ParametersOf parameters_of, IndexChoice index);

  // Whether lanes can answer: a maximum, RMS or mean, laws that have lanes, and nothing asked that they do not have.
  static bool serve(const Mechanism& mechanism, const IndexChoice& index, const RunOptions& options);

  std::string rung() const override { return "perturbation"; }
  double step() const override { return 0.0; }
  std::string leaves_out() const override;
  std::size_t batch() const override { return 64; }
  void evaluate(std::span<const Sample> samples, std::span<Outcome> outcomes,
                const std::atomic<bool>& stop) const override;

 private:
  double nonlinearity(const Parameters& parameters, const LaneOutcome& found) const;

  std::shared_ptr<const Mechanism> mechanism_;
  RungSampleModel::ParametersOf parameters_of_;
  IndexChoice index_;
  PerturbationLanes lanes_;
};

// The model of a rung's samples: lanes where they serve, else runs of the rung one by one.
// scene_varies: whether masses, gravity or springs scatter.
std::unique_ptr<SampleModel> sample_model(const std::string& rung, std::shared_ptr<const Mechanism> mechanism,
                                          RungSampleModel::ParametersOf parameters_of, IndexChoice index, RunOptions options,
                                          bool scene_varies);

}  // namespace boresight
