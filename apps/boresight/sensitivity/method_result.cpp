#include "sensitivity/method_result.hpp"

#include <fmt/format.h>

namespace boresight::app {

std::unique_ptr<MethodResult> method_result(const Study& study, const SensitivityPlan& plan, const SampleStore& store) {
  switch (plan.method) {
    case SensitivityMethod::sobol:
      return sobol_result(study, plan, store);
    case SensitivityMethod::morris:
      return screening_result(study, plan, store);
    case SensitivityMethod::shapley:
      return shapley_result(study, plan, store);
  }
  return nullptr;
}

std::string share_text(double share) {
  const std::string text = fmt::format("{:.3f}", share);
  return text == "-0.000" ? "0.000" : text;
}

Json parameters_of(const SensitivityPlan& plan, std::size_t g) {
  Json parameters = Json::array();
  for (const int i : plan.groups[g]) parameters.push_back(plan.inputs.parameters[static_cast<std::size_t>(i)].name());
  return parameters;
}

}  // namespace boresight::app
