#include "boresight_analyses/function/index_function.hpp"

#include <algorithm>

#include "boresight/keys/numbers_together.hpp"
#include "boresight/keys/value_fault.hpp"
#include "boresight/mechanism/error.hpp"
#include "boresight/mechanism/interruption.hpp"
#include "boresight_analyses/random/contact_path.hpp"
#include "boresight_analyses/runs/scatter_draws.hpp"
#include "boresight_analyses/sensitivity/predictable_slopes.hpp"
#include "boresight_analyses/study/lane_sample_model.hpp"

namespace boresight {
namespace {

Parameters with(const Mechanism& mechanism, const std::vector<FunctionInput>& inputs, std::span<const double> point) {
  Parameters parameters = mechanism.parameters();
  for (std::size_t i = 0; i < inputs.size(); ++i)
    for (const ParameterPath& place : inputs[i].places) place.set(parameters, point[i]);
  return parameters;
}

bool any_varies_scene(const std::vector<FunctionInput>& inputs) {
  return std::any_of(inputs.begin(), inputs.end(), [](const FunctionInput& i) { return scene_varies(i.paths); });
}

bool all_begin_with(const FunctionInput& input, const char* room) {
  return std::all_of(input.paths.begin(), input.paths.end(),
                     [room](const std::string& path) { return path.starts_with(room); });
}

}  // namespace

IndexFunction::IndexFunction(std::shared_ptr<const Mechanism> mechanism, std::vector<FunctionInput> inputs,
                             FunctionModel model)
    : mechanism_(std::move(mechanism)),
      inputs_(std::move(inputs)),
      model_(std::move(model)),
      samples_(sample_model(
          model_.rung, mechanism_,
          [mechanism = mechanism_, inputs = inputs_](std::span<const double> point) {
            return with(*mechanism, inputs, point);
          },
          model_.index, model_.run, any_varies_scene(inputs_))) {}

std::vector<double> IndexFunction::nominal() const {
  std::vector<double> point;
  for (const FunctionInput& input : inputs_) {
    if (input.nominal.size() > 1)
      throw InputError({}, input.name(), differing_in_words(input.nominal, input.si_unit),
                       "one value, for a nominal point: as an input, the path sets all of them alike");
    point.push_back(input.nominal.front());
  }
  return point;
}

const std::atomic<bool>& IndexFunction::never() {
  static const std::atomic<bool> stop{false};
  return stop;
}

Parameters IndexFunction::parameters_at(std::span<const double> point) const {
  return with(*mechanism_, inputs_, point);
}

void IndexFunction::check(std::span<const double> point) const {
  if (point.size() != inputs_.size())
    throw InputError({}, "input", std::to_string(point.size()) + " values",
                     std::to_string(inputs_.size()) + ", one for each input");
  for (std::size_t i = 0; i < inputs_.size(); ++i) try {
      check_value(inputs_[i], point[i]);
    } catch (const ValueFault& fault) {
      throw InputError({}, inputs_[i].name(), fault.found, fault.expected, fault.nearest);
    }
  if (const auto impossible = impossible_numbers(mechanism_->description(), parameters_at(point)))
    throw InputError({}, impossible->path, impossible->found, impossible->expected);
}

Outcome IndexFunction::at(std::span<const double> point, const std::atomic<bool>& stop) const {
  check(point);
  const Sample sample{.number = 0, .values = point};
  Outcome outcome;
  const StopOfThread heard(stop);  // where a scene is built too
  samples_->evaluate({&sample, 1}, {&outcome, 1}, stop);
  return outcome;
}

std::vector<Outcome> IndexFunction::at_all(const std::vector<std::vector<double>>& points,
                                           const ParallelEvaluation& options) const {
  for (const std::vector<double>& point : points) check(point);
  return evaluate_all(*samples_, points, options);
}

std::string IndexFunction::why_no_slopes() const {
  if (model_.rung != "perturbation")
    return "exact slopes are those of the perturbation rung, and this function is of " + model_.rung;
  for (const FunctionInput& input : inputs_) {
    const bool of_error = all_begin_with(input, "error.") && mechanism_->clearances() > 0;
    if (!of_error && !std::all_of(input.paths.begin(), input.paths.end(), is_contact_path))
      return "exact slopes are those by standing errors beside play, and by numbers of a clearance's contacts; " +
             input.name() + " is neither";
  }
  return "";
}

IndexSlopes IndexFunction::slopes_at(std::span<const double> point, const std::atomic<bool>& stop) const {
  check(point);
  if (const std::string why = why_no_slopes(); !why.empty()) throw ComputationError(why);
  std::vector<std::size_t> varied, of_errors;
  std::vector<double> values;
  std::vector<std::vector<double>> errors;
  for (std::size_t i = 0; i < inputs_.size(); ++i) {
    if (all_begin_with(inputs_[i], "error.")) {
      of_errors.push_back(i);
      errors.push_back(errors_of_unit(*mechanism_, inputs_[i].places));
    } else {
      if (!(point[i] > 0.0))
        throw ComputationError("exact slopes are those by numbers above zero, and " + inputs_[i].name() + " is not");
      varied.push_back(i);
      values.push_back(point[i]);
    }
  }
  const StopOfThread heard(stop);
  const auto parameters_with = [&](const std::vector<double>& v) {
    std::vector<double> all(point.begin(), point.end());
    for (std::size_t k = 0; k < varied.size(); ++k) all[varied[k]] = v[k];
    return parameters_at(all);
  };
  IndexSlopes slopes =
      predictable_slopes(mechanism_, parameters_with, values, model_.index, model_.run.start_offset, errors);
  std::vector<double> by(inputs_.size());
  varied.insert(varied.end(), of_errors.begin(), of_errors.end());
  for (std::size_t k = 0; k < varied.size(); ++k) {
    if (!slopes.why_not[k].empty()) throw ComputationError(slopes.why_not[k]);
    by[varied[k]] = slopes.by[k];
  }
  if (!std::all_of(by.begin(), by.end(), [](double slope) { return std::isfinite(slope); }))
    throw ComputationError("the derivatives of the motion overflow");
  slopes.by = by;
  return slopes;
}

}  // namespace boresight
