// A Monte Carlo study as a file poses it: its mechanism, what scatters, what is wanted; and the parameters of any one
// sample.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "boresight/io/document.hpp"
#include "boresight/mechanism/mechanism.hpp"
#include "boresight_analyses/montecarlo/montecarlo_plan.hpp"
#include "boresight_analyses/study/study.hpp"

namespace boresight::app {

// An end without a word: another rank says it.
struct SilentExit {
  int status;
};

struct MonteCarloQuestion {
  Study study;
  std::shared_ptr<const Mechanism> mechanism;
  MonteCarloPlan plan;

  std::function<Parameters(std::span<const double>)> parameters_of() const;
  // SI, in the order of plan.inputs.
  std::vector<double> values_of_sample(std::uint64_t number) const;
  // The same as settings of the mechanism.
  std::vector<Setting> settings_of_sample(std::uint64_t number) const;
};

// Throws InputError.
MonteCarloQuestion read_montecarlo_question(const std::string& file, const std::vector<Setting>& settings);

}  // namespace boresight::app
