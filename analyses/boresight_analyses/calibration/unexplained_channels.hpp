// Channels whose readings the fitted model does not explain: a stuck sensor, a wrong unit, another axis or sign.
//
// The noise of each channel is taken from what the fit leaves of it, so such a channel is weighed as a very noisy one: it moves nothing, and no
// interval shows it.
#pragma once

#include <string>
#include <vector>

#include "boresight_analyses/calibration/inference.hpp"

namespace boresight {

struct UnexplainedChannel {
  int channel = 0;   // among channel_names()
  std::string says;  // a sentence for people
};

// By the residuals of `inference`. A channel that reads noise alone where the model foretells next to nothing is none of them, unless it is far
// noisier than others.
std::vector<UnexplainedChannel> unexplained_channels(const CalibrationProblem& problem, const Inference& inference);

}  // namespace boresight
