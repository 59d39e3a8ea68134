// Samples of standing errors alone, without play: pure geometry (GeometricErrors), for the scene rungs, which all agree there.
#pragma once

#include "boresight/scene/geometric_errors.hpp"
#include "boresight_analyses/study/rung_sample_model.hpp"

namespace boresight {

class GeometricSampleModel final : public SampleModel {
 public:
  // rung: in whose name. typical: StandingCurvature.
  GeometricSampleModel(std::string rung, std::shared_ptr<const Mechanism> mechanism,
                       RungSampleModel::ParametersOf parameters_of, IndexChoice index,
                       const std::vector<double>& typical = {});

  // Whether samples on this rung are pure geometry. Steps and integrators then mean nothing.
  static bool serve(const std::string& rung, const Mechanism& mechanism);

  std::string rung() const override { return rung_; }
  double step() const override { return 0.0; }
  std::string leaves_out() const override;
  std::size_t batch() const override { return 1024; }
  void evaluate(std::span<const Sample> samples, std::span<Outcome> outcomes,
                const std::atomic<bool>& stop) const override;

 private:
  std::string rung_;
  std::shared_ptr<const Mechanism> mechanism_;
  RungSampleModel::ParametersOf parameters_of_;
  GeometricErrors geometry_;
};

}  // namespace boresight
