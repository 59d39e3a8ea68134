#include "command_line/montecarlo_study.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "command_line/study_input.hpp"

namespace boresight::app {

std::function<Parameters(std::span<const double>)> MonteCarloQuestion::parameters_of() const {
  return [mechanism = mechanism, inputs = plan.inputs](std::span<const double> values) {
    return inputs.parameters_with(*mechanism, values);
  };
}

std::vector<double> MonteCarloQuestion::values_of_sample(std::uint64_t number) const {
  std::vector<double> values(plan.inputs.size());
  SamplingDesign(plan.design, static_cast<int>(values.size())).point(number, values);
  plan.inputs.values(values);
  return values;
}

std::vector<Setting> MonteCarloQuestion::settings_of_sample(std::uint64_t number) const {
  const std::vector<double> values = values_of_sample(number);
  std::vector<Setting> settings;
  for (std::size_t i = 0; i < values.size(); ++i)
    for (const std::string& path : plan.inputs.parameters[i].paths) {
      const std::string& unit = plan.inputs.parameters[i].si_unit;
      settings.push_back({path, fmt::format("{:.17g}{}", values[i], unit == "1" ? "" : " " + unit)});
    }
  return settings;
}

MonteCarloQuestion read_montecarlo_question(const std::string& file, const std::vector<Setting>& settings) {
  StudyInput input(file, settings);
  MonteCarloQuestion question;
  question.plan = read_montecarlo_plan(input.root, input.study, input.mechanism->description(), input.trial);
  question.study = std::move(input.study);
  question.mechanism = std::move(input.mechanism);
  return question;
}

}  // namespace boresight::app
