#include "boresight_analyses/study/lane_sample_model.hpp"

#include <algorithm>
#include <cmath>

#include "boresight/keys/numbers_together.hpp"
#include "boresight/ladder/ladder.hpp"
#include "boresight/mechanism/error.hpp"
#include "boresight/mechanism/interruption.hpp"
#include "boresight/rungs/cpu_clock.hpp"
#include "boresight/rungs/pressed_through.hpp"
#include "boresight/stepping/measured_error.hpp"
#include "boresight_analyses/study/geometric_sample_model.hpp"
#include "boresight_analyses/study/measurement.hpp"
#include "boresight_analyses/study/shared_time.hpp"

namespace boresight {

bool LaneSampleModel::serve(const Mechanism& mechanism, const IndexChoice& index, const RunOptions& options) {
  const bool statistic = index.statistic == "max" || index.statistic == "rms" || index.statistic == "mean";
  return statistic && PerturbationLanes::serve(mechanism) && options.step == 0.0 && options.integrator.empty();
}

LaneSampleModel::LaneSampleModel(std::shared_ptr<const Mechanism> mechanism,
                                 RungSampleModel::ParametersOf parameters_of, IndexChoice index, bool scene_varies,
                                 double tolerance, std::vector<double> typical)
    : mechanism_(std::move(mechanism)),
      parameters_of_(std::move(parameters_of)),
      index_(std::move(index)),
      scene_varies_(scene_varies),
      lanes_(mechanism_, index_.kind(), index_.start, std::move(typical)),
      tolerance_(tolerance) {}

namespace {

// What one unit of the index is as a displacement [m]: of a turn, what it displaces by across the mechanism.
double displacement_of(const IndexChoice& index, const Mechanism& mechanism) {
  if (index.kind() == PointingQuantity::position_error) return 1.0;
  if (index.kind() != PointingQuantity::line_of_sight_error) return mechanism.characteristic_length();
  return distance_of_target(mechanism);
}

}  // namespace

// Of what the lanes keep: the deviation over the mechanism's size, times how much the mechanism magnifies its offsets. Standing errors
// displace the pose beside the play, however far: that magnifies no offset.
double LaneSampleModel::nonlinearity_of_play(const Parameters& parameters, const LaneOutcome& found) const {
  const double unit = displacement_of(index_, *mechanism_);
  const double deviation = found.max * unit / mechanism_->characteristic_length();
  double offset = 0.0;
  for (const ClearanceParameters& c : parameters.clearance) offset = std::max(offset, widest_gap(c));
  offset += found.max_penetration;
  return offset > 0.0 ? deviation * std::max(1.0, found.max_of_play * unit / offset) : 0.0;
}

// So is what a sample's model misses of its play, or more where the rung itself knows of more of what the play alone does; and what being
// linear in standing errors misses besides.
double LaneSampleModel::nonlinearity(const Parameters& parameters, const LaneOutcome& found) const {
  double of_play = nonlinearity_of_play(parameters, found);
  if (times_ && found.max > 0.0) {
    LaneOutcome alone = found;
    alone.max = found.max_of_play;
    const double share = std::min(1.0, found.max_of_play / found.max);
    of_play = std::max(of_play, share * std::min(1.0, *times_ * nonlinearity_of_play(parameters, alone)));
  }
  return of_play + lanes_.error_of_linearity(parameters, found.max);
}

// How much more than that, as a factor, the rung finds that it misses of the file's own motion without standing errors, where it follows what
// pushes the motion besides: lanes cannot look at this sample by sample. 1 where the rung cannot follow that motion, or not in reasonable
// time.
double LaneSampleModel::times_nonlinearity(const std::atomic<bool>& stop) const {
  constexpr int kMostLooks = 1000;  // steps are bounded so, at some thousand a look
  const std::scoped_lock lock(mutex_);
  if (times_) return *times_;
  Parameters drawn = mechanism_->parameters();
  std::fill(drawn.error.begin(), drawn.error.end(), 0.0);
  int looks = 0;
  RunOptions options;
  options.start = index_.start;
  options.sample_spacing = 0.0;
  options.events = false;
  options.progress = [&](const RunProgress&) { return !stop && ++looks <= kMostLooks; };
  double times = 1.0;
  try {
    const RunResult result = make_rung("perturbation", mechanism_)->run(drawn, options);
    LaneOutcome found;
    found.max = found.max_of_play = result.index.of(index_.kind()).max;
    for (const ContactSummary& contact : result.contact)
      found.max_penetration = std::max(found.max_penetration, contact.max_penetration);
    const double of_play = nonlinearity_of_play(drawn, found);
    if (!result.interrupted && of_play > 0.0) times = std::max(1.0, result.error.model_of(index_.kind()) / of_play);
  } catch (const ComputationError&) {
  }
  if (!stop) times_ = times;
  return times;
}

std::string LaneSampleModel::leaves_out() const { return make_rung("perturbation", mechanism_)->leaves_out(); }

void LaneSampleModel::take(const LaneOutcome& found, const Parameters& parameters, Outcome& outcome) const {
  if (found.status != LaneStatus::done) {
    outcome.status = Outcome::Status::failed;
    outcome.message =
        std::string(found.status == LaneStatus::step_too_small ? "the error estimate asked for a vanishing step"
                                                               : "too many steps") +
        " at t = " + std::to_string(found.t) + " s";
    return;
  }
  if (const auto through = pressed_through(parameters, found.max_penetration)) {
    outcome.status = Outcome::Status::failed;
    outcome.message = *through;
    return;
  }
  outcome.value = index_.statistic == "max"   ? found.max
                  : index_.statistic == "rms" ? std::sqrt(found.mean_square)
                                              : found.mean;
  const double counted = mechanism_->duration() - index_.start;
  outcome.motion.free_flight_share = found.free_flight_share;
  if (counted > 0.0) outcome.motion.impacts_per_second = static_cast<double>(found.impacts) / counted;
  outcome.model_error = nonlinearity(parameters, found);
  outcome.discretisation_error = kNotMeasured;
  outcome.status = Outcome::Status::done;
}

void LaneSampleModel::evaluate(std::span<const Sample> samples, std::span<Outcome> outcomes,
                               const std::atomic<bool>& stop) const {
  evaluate_each(samples, outcomes, stop, [](std::size_t) {});
}

void LaneSampleModel::evaluate_each(std::span<const Sample> samples, std::span<Outcome> outcomes,
                                    const std::atomic<bool>& stop,
                                    const std::function<void(std::size_t)>& reached) const {
  if (stop) return;
  try {
    times_nonlinearity(stop);
  } catch (const Interrupted&) {
    return;
  }
  SharedTime time(thread_cpu_seconds());
  std::vector<Parameters> parameters;
  std::vector<std::size_t> place;  // of each of them among the samples
  for (std::size_t k = 0; k < samples.size(); ++k) {
    Parameters drawn = parameters_of_(samples[k].values);
    if (const auto impossible = impossible_numbers(mechanism_->description(), drawn)) {
      outcomes[k].status = Outcome::Status::failed;
      outcomes[k].message = impossible->text();
      reached(k);
      continue;
    }
    parameters.push_back(std::move(drawn));
    place.push_back(k);
  }
  std::vector<LaneOutcome> found(parameters.size());
  const auto prepared = [&](std::size_t count, double attempts) { time.begin(count, thread_cpu_seconds(), attempts); };
  const auto ended = [&](std::size_t i, double attempts) {
    Outcome& outcome = outcomes[place[i]];
    take(found[i], parameters[i], outcome);
    outcome.evaluations = static_cast<double>(found[i].steps + found[i].rejected);
    outcome.cpu_seconds = time.end(outcome.evaluations, attempts, thread_cpu_seconds());
    reached(place[i]);
  };
  try {
    lanes_.run(parameters, found, tolerance_, {.stop = &stop, .ended = ended, .prepared = prepared});
  } catch (const ComputationError& failure) {
    // Some sample's scene or errors: the others are none the worse for it.
    const auto open = [&](std::size_t k) { return outcomes[k].status == Outcome::Status::not_reached; };
    const auto count = static_cast<double>(std::count_if(place.begin(), place.end(), open));
    const double in_vain = time.unpaid(thread_cpu_seconds()) / std::max(1.0, count);
    for (const std::size_t k : place) {
      if (stop) break;
      if (!open(k)) continue;
      if (samples.size() > 1) {
        evaluate_each(samples.subspan(k, 1), outcomes.subspan(k, 1), stop, [&](std::size_t) {
          outcomes[k].cpu_seconds += in_vain;
          reached(k);
        });
        continue;
      }
      outcomes[k].cpu_seconds = in_vain;
      outcomes[k].status = Outcome::Status::failed;
      outcomes[k].message = failure.what();
      reached(k);
    }
  } catch (const Interrupted&) {  // heard while a scene was built
  }
}

std::unique_ptr<SampleModel> sample_model(const std::string& rung, std::shared_ptr<const Mechanism> mechanism,
                                          RungSampleModel::ParametersOf parameters_of, IndexChoice index,
                                          RunOptions options, bool scene_varies, std::vector<double> typical) {
  if (GeometricSampleModel::serve(rung, *mechanism))
    return std::make_unique<GeometricSampleModel>(rung, std::move(mechanism), std::move(parameters_of),
                                                  std::move(index), typical);
  if (rung == "perturbation" && LaneSampleModel::serve(*mechanism, index, options))
    return std::make_unique<LaneSampleModel>(std::move(mechanism), std::move(parameters_of), std::move(index),
                                             scene_varies, options.tolerance > 0.0 ? options.tolerance : kLaneTolerance,
                                             std::move(typical));
  return std::make_unique<RungSampleModel>(rung, std::move(mechanism), std::move(parameters_of), std::move(index),
                                           std::move(options), scene_varies);
}

}  // namespace boresight
