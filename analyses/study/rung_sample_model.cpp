#include "boresight_analyses/study/rung_sample_model.hpp"

#include <cmath>

#include "boresight/mechanism/error.hpp"

namespace boresight {

const char* to_string(Outcome::Status status) {
  switch (status) {
    case Outcome::Status::done:
      return "done";
    case Outcome::Status::failed:
      return "failed";
    case Outcome::Status::not_reached:
      return "not reached";
  }
  return "";
}

RungSampleModel::RungSampleModel(std::string rung, std::shared_ptr<const Mechanism> mechanism, ParametersOf parameters_of,
                                 IndexChoice index, RunOptions options, bool scene_varies)
    : rung_(std::move(rung)),
      mechanism_(std::move(mechanism)),
      parameters_of_(std::move(parameters_of)),
      index_(std::move(index)),
      options_(std::move(options)),
      scene_varies_(scene_varies),
      shared_(make_rung(rung_, mechanism_)) {
  options_.sample_spacing = 0.0;  // the index is all that is kept
  options_.events = false;
}

void RungSampleModel::evaluate(std::span<const Sample> samples, std::span<Outcome> outcomes,
                               const std::atomic<bool>& stop) const {
  std::unique_ptr<Rung> own;
  if (scene_varies_) {
    const std::scoped_lock lock(mutex_);
    if (!idle_.empty()) {
      own = std::move(idle_.back());
      idle_.pop_back();
    }
  }
  if (scene_varies_ && !own) own = make_rung(rung_, mechanism_);
  for (std::size_t k = 0; k < samples.size() && !stop; ++k)
    evaluate_one(scene_varies_ ? *own : *shared_, samples[k], outcomes[k], stop);
  if (own) {
    const std::scoped_lock lock(mutex_);
    idle_.push_back(std::move(own));
  }
}

void RungSampleModel::evaluate_one(const Rung& rung, const Sample& sample, Outcome& outcome,
                                   const std::atomic<bool>& stop) const {
  RunOptions options = options_;
  options.progress = [&stop](const RunProgress&) { return !stop.load(std::memory_order_relaxed); };
  try {
    const RunResult result = rung.run(parameters_of_(sample.values), options);
    outcome.cpu_seconds = result.cost.cpu_seconds;
    if (result.interrupted) return;
    outcome.value = index_.of(result.index);
    outcome.model_error = result.error.model;
    outcome.discretisation_error = result.error.discretisation;
    outcome.status = Outcome::Status::done;
    if (!std::isfinite(outcome.value)) {
      outcome.status = Outcome::Status::failed;
      outcome.value = std::numeric_limits<double>::quiet_NaN();
      outcome.message = "the index is not a finite number";
    }
  } catch (const ComputationError& failure) {
    outcome.status = Outcome::Status::failed;
    outcome.message = failure.what();
  }
}

}  // namespace boresight
