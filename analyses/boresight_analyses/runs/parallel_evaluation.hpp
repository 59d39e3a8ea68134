// The outcomes of a list of samples, computed over threads.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "boresight_analyses/study/sample_model.hpp"

namespace boresight {

struct EvaluationInterrupted {};

struct ParallelEvaluation {
  int jobs = 1;
  std::function<bool()> interrupted = {};
  // Called with each sample that was reached, one at a time, in the order in which they end.
  std::function<void(std::size_t, const Outcome&)> landed = {};
};

// values[k]: of sample k. Throws EvaluationInterrupted where not all were reached, and what the model or
// `landed` throws.
std::vector<Outcome> evaluate_all(const SampleModel& model, const std::vector<std::vector<double>>& values,
                                  const ParallelEvaluation& options);

}  // namespace boresight
