// From a design (values of the variables) to the outcomes of its samples, computed over threads once and
// remembered.
//
// Sample k of every design draws the same random numbers (common random numbers): two designs differ by the
// designs, not by luck. The model sees the variables first, then the study's random parameters.
#pragma once

#include <functional>
#include <map>
#include <span>
#include <vector>

#include "boresight_analyses/random/random_inputs.hpp"
#include "boresight_analyses/runs/evaluation_store.hpp"
#include "boresight_analyses/runs/parallel_evaluation.hpp"
#include "boresight_analyses/study/failures.hpp"
#include "boresight_analyses/study/sample_model.hpp"

namespace boresight {

class DesignEvaluator {
 public:
  struct Options {
    std::size_t samples = 1;  // per design
    std::uint64_t seed = 1;
    int jobs = 1;
    std::function<bool()> interrupted = {};
    std::function<void()> landed = {};  // after each design that was computed
  };

  // `inputs`: nullptr where nothing scatters; `store`: nullptr to keep evaluations in memory alone. All must
  // outlive it.
  DesignEvaluator(const SampleModel& model, const RandomInputs* inputs, EvaluationStore* store, Options options);

  // Throws EvaluationInterrupted. The reference holds until the evaluator goes.
  const std::vector<Outcome>& at(std::span<const double> design);

  const Options& options() const { return options_; }
  std::int64_t computed() const { return computed_; }  // designs, in this process
  std::int64_t reused() const { return reused_; }      // found in the store
  double cpu_seconds() const { return cpu_seconds_; }
  // Of the samples of all designs asked for so far, numbered in the order of the asking.
  const Failures& failures() const { return failures_; }
  std::uint64_t runs() const { return runs_; }
  // All designs asked for so far, with their outcomes.
  const std::map<std::vector<double>, std::vector<Outcome>>& all() const { return seen_; }

 private:
  const SampleModel& model_;
  const RandomInputs* inputs_;
  EvaluationStore* store_;
  Options options_;
  std::map<std::vector<double>, std::vector<Outcome>> seen_;
  std::int64_t computed_ = 0, reused_ = 0;
  double cpu_seconds_ = 0.0;
  Failures failures_;
  std::uint64_t runs_ = 0;
  const std::vector<Outcome>& keep(const std::vector<double>& design, std::vector<Outcome> outcomes);
};

}  // namespace boresight
