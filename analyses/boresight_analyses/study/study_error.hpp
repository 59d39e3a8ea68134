// What a study's answer is off by because its motions advance in steps: its way and the same way finer, compared pair by
// pair on samples of the study itself. Cheap ways pay for many pairs; dear ones for a few, within a share of the study.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "boresight_analyses/study/scatter_comparison.hpp"
#include "boresight_analyses/study/setup_samples.hpp"

namespace boresight {

struct StudyDiscretisation {
  bool measured = false;
  double relative = 0.0;  // of the statistic, with 95 percent confidence
  std::string why;        // how it was measured, or why not
  double cpu_seconds = 0.0;
};

struct StudyErrorOptions {
  IndexChoice index = {};
  ScatterStatistic statistic = {};
  bool scene_varies = true;
  std::uint64_t runs = 0;      // of the study: a tenth of what they take is what the measurement may
  double least_seconds = 0.5;  // of CPU that it may take in any case
  int jobs = 1;
  std::function<bool()> advance = {};
};

// samples: of the study, in its own order. Never throws for a motion that cannot be followed: it is then not measured.
StudyDiscretisation measure_study_discretisation(std::shared_ptr<const Mechanism> mechanism,
                                                 const std::vector<Parameters>& samples, const RungSetup& setup,
                                                 const StudyErrorOptions& options);

}  // namespace boresight
