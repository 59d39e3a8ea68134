// The same samples on several models, and points that a method chooses as it goes: what multi-fidelity and tail estimates
// ask of the models of a study.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "boresight_analyses/runs/sample_store.hpp"
#include "boresight_analyses/runs/sampling.hpp"
#include "boresight_analyses/statistics/batch_model.hpp"
#include "boresight_analyses/study/failures.hpp"

namespace boresight {

// Thrown out of a method when the user has interrupted it.
struct MethodInterrupted {};

struct MethodOptions {
  int jobs = 1;
  std::function<void(double)> progress;  // CPU seconds spent since the last call
  std::function<bool()> interrupted;
  // Each point that did, by its number in its batch and in that order, once the batch is done.
  std::function<void(std::uint64_t, const Outcome&)> failed = {};
  // Each point, in the order in which the method asked for it, once its batch is done.
  std::function<void(const Outcome&)> answered = {};
};

// The numbers of a range that the store lacks are computed and stored. Throws MethodInterrupted; what was computed is stored.
void complete_samples(const SampleModel& model, const RandomInputs& inputs, const SamplingDesign& design,
                      const NumberRange& range, SampleStore& store, const MethodOptions& options);

struct StoredValues {
  std::vector<double> values;        // in the order of the numbers; NaN: failed
  std::vector<double> model_errors;  // of each: what the rung thinks it leaves out, relative; 0 where not known
  double typical_cost = 0.0;         // median CPU seconds of a sample: preparing what all share is not a sample's cost
  double spent = 0.0;                // CPU seconds
  double model = 0.0;                // mean of the model errors
  Failures failures;
};
StoredValues stored_values(const SampleStore& store, const NumberRange& range);

// A model as a function on the standard normal space, u -> Phi(u) -> quantiles -> index; NaN where it fails. The costs of
// all its samples are kept in `cost`. Throws MethodInterrupted.
//
// store: where every point is kept as it is done, by its place among all that the method has asked for; none: nowhere. A method
// asks for the same points again when it is begun again, and finds there those that an earlier start computed. Throws
// StoreRefused where it asks for others.
BatchModel on_normal_space(const SampleModel& model, const RandomInputs& inputs, const MethodOptions& options,
                           std::shared_ptr<std::vector<double>> cost, SampleStore* store = nullptr);

double median(std::vector<double> values);

// As large as the values may be, by each one's own model error and by what the steps do to all of them (NaN: not known), both relative.
std::vector<double> as_large_as_may_be(std::vector<double> values, const std::vector<double>& model_errors,
                                       double steps);

}  // namespace boresight
