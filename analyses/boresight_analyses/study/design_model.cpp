#include "boresight_analyses/study/design_model.hpp"

#include <algorithm>

#include "boresight_analyses/study/geometric_sample_model.hpp"

namespace boresight {
namespace {

// kLaneTolerance is what converges an index to 1 %.
constexpr double kAccuracyOfLaneTolerance = 0.01;

}  // namespace

DesignModel design_model(RungChoice& choice, const DesignsAsked& asked) {
  DesignModel model;
  model.run = asked.run;
  const bool lanes = asked.samples && !asked.peak_acceleration && choice.name == "perturbation" &&
                     LaneSampleModel::serve(*asked.mechanism, asked.index, asked.run);
  if (lanes) {
    const double by_accuracy = kLaneTolerance * std::min(1.0, asked.accuracy / kAccuracyOfLaneTolerance);
    // Without an integrator it is one of lanes, which the pilot found.
    const bool found = choice.tolerance > 0.0 && choice.integrator.empty();
    choice.tolerance = asked.run.tolerance > 0.0 ? asked.run.tolerance
                       : found                   ? std::min(choice.tolerance, by_accuracy)
                                                 : by_accuracy;
    choice.step = 0.0;
    choice.integrator.clear();
    model.run.tolerance = choice.tolerance;
    model.samples =
        sample_model(choice.name, asked.mechanism, asked.parameters_of, asked.index, model.run, asked.scene_varies);
    return model;
  }
  if (asked.samples && !asked.peak_acceleration && GeometricSampleModel::serve(choice.name, *asked.mechanism)) {
    model.samples =
        std::make_unique<GeometricSampleModel>(choice.name, asked.mechanism, asked.parameters_of, asked.index);
    return model;
  }
  apply(choice, model.run);
  model.run = options_on(choice.name, asked.mechanism, asked.corners, model.run);
  model.samples = std::make_unique<RungSampleModel>(choice.name, asked.mechanism, asked.parameters_of, asked.index,
                                                    model.run, asked.scene_varies);
  return model;
}

}  // namespace boresight
