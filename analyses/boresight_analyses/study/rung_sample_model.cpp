#include "boresight_analyses/study/rung_sample_model.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>

#include "boresight/keys/numbers_together.hpp"
#include "boresight/ladder/ladder.hpp"
#include "boresight/mechanism/error.hpp"
#include "boresight/mechanism/interruption.hpp"
#include "boresight/rungs/integrator_choice.hpp"
#include "boresight/rungs/pressed_through.hpp"
#include "boresight/stepping/unstable_step.hpp"

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

namespace {

MotionMeasures measures_of(const RunResult& result) {
  MotionMeasures m{.free_flight_share = 0.0, .impacts_per_second = 0.0, .peak_acceleration = 0.0};
  for (const ContactSummary& joint : result.contact) {
    m.free_flight_share = std::max(m.free_flight_share, 1.0 - joint.contact_fraction);
    if (result.end_time > result.start)
      m.impacts_per_second += static_cast<double>(joint.impacts) / (result.end_time - result.start);
  }
  m.peak_acceleration = result.platform_acceleration_max.cwiseAbs().maxCoeff();
  return m;
}

}  // namespace

RungSampleModel::RungSampleModel(std::string rung, std::shared_ptr<const Mechanism> mechanism,
                                 ParametersOf parameters_of, IndexChoice index, RunOptions options, bool scene_varies,
                                 KeptOfRun kept)
    : rung_(std::move(rung)),
      mechanism_(std::move(mechanism)),
      parameters_of_(std::move(parameters_of)),
      index_(std::move(index)),
      options_(std::move(options)),
      scene_varies_(scene_varies),
      kept_(std::move(kept)),
      shared_(make_rung(rung_, mechanism_)) {
  options_.sample_spacing = kept_.spacing;
  options_.events = false;
  options_.start = index_.start;
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
  try {
    for (std::size_t k = 0; k < samples.size() && !stop; ++k)
      evaluate_one(scene_varies_ ? *own : *shared_, samples[k], outcomes[k], stop);
  } catch (const Interrupted&) {
    // Heard while a scene was built: the rest is not reached, as when the study hears it.
  }
  if (own) {
    const std::scoped_lock lock(mutex_);
    idle_.push_back(std::move(own));
  }
}

RunResult RungSampleModel::run(const Rung& rung, const Parameters& parameters, RunOptions options,
                               std::string& message) const {
  constexpr double kSmallestShare = 1e-3;
  for (;;) {
    try {
      return rung.run(parameters, options);
    } catch (const UnstableStep&) {
      if (options.step < kSmallestShare * options_.step || options.step == 0.0) throw;
      options.step *= 0.5;
      char text[60];
      std::snprintf(text, sizeof text, "the step was shortened to %.6g s", options.step);
      message = text;
    }
  }
}

void RungSampleModel::evaluate_one(const Rung& rung, const Sample& sample, Outcome& outcome,
                                   const std::atomic<bool>& stop) const {
  RunOptions options = options_;
  options.model_look = ModelLook::shares;
  options.progress = [&stop](const RunProgress&) { return !stop.load(std::memory_order_relaxed); };
  try {
    const Parameters parameters = parameters_of_(sample.values);
    if (const auto impossible = impossible_numbers(mechanism_->description(), parameters))
      throw ComputationError(impossible->text());
    const RunResult result = run(rung, parameters, options, outcome.message);
    outcome.cpu_seconds = result.cost.cpu_seconds;
    outcome.evaluations = static_cast<double>(result.cost.evaluations - result.cost.shared_evaluations);
    if (result.interrupted) return;
    if (const auto through = pressed_through(*mechanism_, parameters, result)) throw ComputationError(*through);
    outcome.value = index_.of(result.index);
    outcome.motion = measures_of(result);
    if (kept_.spacing > 0.0) outcome.history = kept_.of(result);
    outcome.model_error = result.error.model_of(index_.kind());
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

double common_step(const std::string& rung, const std::shared_ptr<const Mechanism>& mechanism,
                   const std::vector<Parameters>& samples, RunOptions options, const std::vector<double>& known,
                   const std::function<void(std::size_t, double)>& found) {
  if (controls_error(options)) return 0.0;
  std::unique_ptr<Rung> model;
  options.sample_spacing = 0.0;
  options.events = false;
  double step = 0.0;
  std::optional<ComputationError> refusal;
  for (std::size_t k = 0; k < samples.size(); ++k) {
    double own = k < known.size() ? known[k] : 0.0;
    if (own == 0.0) {
      if (impossible_numbers(mechanism->description(), samples[k])) continue;  // no motion is followed at this step
      if (!model) model = make_rung(rung, mechanism);
      try {
        const RunResult result = model->run(samples[k], options);
        if (result.cost.steps == 0) continue;
        // What it took shows no step that others could take.
        if (!result.integrator_taken.empty()) return 0.0;
        own = mechanism->duration() / static_cast<double>(result.cost.steps);
        if (found) found(k, own);
      } catch (const ComputationError& failure) {
        refusal = failure;
        continue;
      }
    }
    step = step == 0.0 ? own : std::min(step, own);
  }
  if (step == 0.0 && refusal) throw *refusal;
  return step;
}

}  // namespace boresight
