// The model that judges the designs of a search, each by many samples: on lanes, or as pure geometry, where they say what is asked, else
// run by run with one step for all designs.
#pragma once

#include "boresight_analyses/study/lane_sample_model.hpp"
#include "boresight_analyses/study/rung_choice.hpp"

namespace boresight {

struct DesignsAsked {
  std::shared_ptr<const Mechanism> mechanism;
  RungSampleModel::ParametersOf parameters_of;
  IndexChoice index;
  RunOptions run;                   // the user's own
  std::vector<Parameters> corners;  // designs whose motions find the common step
  bool scene_varies = true;         // from design to design, or over the scatter
  double accuracy = 0.01;           // of the index, relative
  bool samples = true;              // each design is judged by many samples
  bool peak_acceleration = false;   // is asked, which lanes do not say
};

struct DesignModel {
  std::unique_ptr<SampleModel> samples;
  RunOptions run;  // of the motions, where they are runs of their own
};

// choice: the rung, with what a pilot found; where lanes serve, their tolerance takes the place of its step.
// Throws OptionRefused, ComputationError.
DesignModel design_model(RungChoice& choice, const DesignsAsked& asked);

}  // namespace boresight
