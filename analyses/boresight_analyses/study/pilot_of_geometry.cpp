// The pilot where no joint has play: errors added up linearly, or the built mechanism's joints closed exactly. Nothing is integrated and
// nothing scatters by itself, so that one evaluation of a sample says all.
#include <algorithm>
#include <cmath>
#include <numeric>

#include "boresight/ladder/ladder.hpp"
#include "boresight/mechanism/error.hpp"
#include "boresight/pointing/relative_text.hpp"
#include "boresight_analyses/study/pilot_choice.hpp"
#include "boresight_analyses/study/setup_samples.hpp"

namespace boresight {
namespace {

std::vector<std::size_t> first_of(std::size_t count) {
  std::vector<std::size_t> all(count);
  std::iota(all.begin(), all.end(), std::size_t{0});
  return all;
}

class PilotOfGeometry {
 public:
  PilotOfGeometry(std::shared_ptr<const Mechanism> mechanism, const std::vector<Parameters>& samples,
                  const PilotOptions& options)
      : mechanism_(std::move(mechanism)), samples_(samples), options_(options) {
    // Of the rungs that are linear here, one that has the options given.
    const bool steps = options_.step > 0.0 || options_.tolerance > 0.0 || !options_.integrator.empty();
    linear_ = {.rung = steps ? "perturbation" : "quasistatic",
               .integrator = options_.integrator,
               .step = options_.step,
               .tolerance = options_.tolerance};
    exact_ = linear_;
    exact_.rung = rung_names().back();
  }

  PilotResult run() {
    result_.accuracy = options_.accuracy;
    result_.geometry = true;
    result_.index = options_.index.title() + (options_.statistic ? ", " + options_.statistic->title() : "");
    result_.unit = options_.index.si_unit();
    linear_trial_.rung = linear_.rung;
    exact_trial_.rung = exact_.rung;
    exact_trial_.reference = true;
    SetupSamples exact(mechanism_, samples_, exact_, options_.index, options_.scene_varies);
    std::unique_ptr<SetupSamples> linear;
    try {
      linear = std::make_unique<SetupSamples>(mechanism_, samples_, linear_, options_.index, options_.scene_varies);
      compute(*linear, first_of(samples_.size()));
      linear_trial_.refusal = linear->refusal();
    } catch (const ComputationError& failure) {
      linear_trial_.refusal = failure.what();
    }
    if (!linear_trial_.refusal.empty()) linear.reset();
    options_.statistic ? compare_scatters(linear.get(), exact) : compare_motions(linear.get(), exact);
    not_closed_ = exact.failed();
    const bool taken = linear && not_closed_ == 0 && linear_trial_.error <= options_.accuracy;
    linear_trial_.accepted = taken;
    exact_trial_.accepted = true;
    result_.trials = {linear_trial_, exact_trial_};
    result_.chosen = taken ? 0 : 1;
    result_.met = true;
    result_.cpu_seconds = exact.spent_seconds() + (linear ? linear->spent_seconds() : 0.0);
    result_.why = why(taken);
    return result_;
  }

 private:
  void compute(SetupSamples& setup, const std::vector<std::size_t>& which) {
    if (!setup.compute(which, options_.jobs, [this] { return !options_.progress || options_.progress(runs_++); }))
      throw PilotInterrupted{};
  }

  // The linear way's reason, where it has one, names errors and joints.
  [[noreturn]] void refuse(const SetupSamples& exact) const {
    throw ComputationError(!linear_trial_.refusal.empty() ? linear_trial_.refusal : exact.refusal());
  }

  static void take(const SetupSamples& samples, PilotTrial& trial) {
    trial.estimate = samples.estimate();
    trial.cpu_seconds = samples.cpu_seconds();
  }

  // Each motion by itself, the worst counts.
  void compare_motions(const SetupSamples* linear, SetupSamples& exact) {
    const std::vector<std::size_t> all = first_of(samples_.size());
    compute(exact, all);
    if (exact.failed() > 0) refuse(exact);
    exact_trial_.value = result_.reference = exact.value(0);
    take(exact, exact_trial_);
    if (linear == nullptr) return;
    linear_trial_.value = linear->value(0);
    take(*linear, linear_trial_);
    const double nothing = nothing_of(options_.index, *mechanism_);
    for (const std::size_t k : all) {
      const double size = std::abs(exact.value(k)), off = linear->value(k) - exact.value(k);
      if (size <= nothing && std::abs(linear->value(k)) <= nothing) continue;
      const double relative = off / std::max(size, nothing);
      if (std::abs(relative) <= linear_trial_.error) continue;
      linear_trial_.error = std::abs(relative);
      linear_trial_.difference = relative;
    }
  }

  // Pair by pair, pairs added until the answer is clear or the time is spent.
  void compare_scatters(const SetupSamples* linear, SetupSamples& exact) {
    const std::vector<double> ranked_by =
        linear ? linear->values(first_of(samples_.size())) : std::vector<double>{};  // plain samples then
    const ChosenSamples chosen = choose_samples(ranked_by, samples_.size(), kMostPairs, *options_.statistic);
    std::vector<std::size_t> pairs;
    std::vector<double> scores;
    ScatterDifference found;
    for (const std::size_t n : kPairs) {
      const std::size_t most = std::min(n, chosen.sample.size());
      const std::vector<std::size_t> which(chosen.sample.begin(),
                                           chosen.sample.begin() + static_cast<std::ptrdiff_t>(most));
      compute(exact, which);
      pairs.clear();
      scores.clear();
      for (std::size_t k = 0; k < most; ++k) {
        if (!std::isfinite(exact.value(which[k]))) continue;
        pairs.push_back(which[k]);
        if (!chosen.score.empty()) scores.push_back(chosen.score[k]);
      }
      if (pairs.empty()) refuse(exact);
      if (linear == nullptr || most == chosen.sample.size()) break;
      found = difference(*linear, exact, pairs, scores, *options_.statistic);
      if (found.bound() <= options_.accuracy) break;
      if (std::abs(found.difference) - found.half_width > options_.accuracy) break;
      // As many pairs again cost about as much again.
      const double foreseen = static_cast<double>(n) * exact.cpu_seconds();
      if (exact.spent_seconds() + foreseen > most_seconds(options_, exact.cpu_seconds())) break;
    }
    result_.pairs = pairs.size();
    take(exact, exact_trial_);
    exact_trial_.pairs = pairs.size();
    const SetupSamples& shown = linear ? *linear : exact;
    found = difference(shown, exact, pairs, scores, *options_.statistic);
    exact_trial_.value = result_.reference = found.reference;
    if (linear == nullptr) return;
    take(*linear, linear_trial_);
    linear_trial_.value = found.value;
    linear_trial_.difference = found.difference;
    linear_trial_.error = found.bound();
    linear_trial_.pairs = pairs.size();
    const bool taken = exact.failed() == 0 && linear_trial_.error <= options_.accuracy;
    for (const double p : stated_probabilities(*options_.statistic))
      result_.errors.push_back({p, taken ? difference(*linear, exact, pairs, scores, {p}).bound() : 0.0});
  }

  ScatterDifference difference(const SetupSamples& setup, const SetupSamples& exact,
                               const std::vector<std::size_t>& pairs, const std::vector<double>& scores,
                               const ScatterStatistic& statistic) const {
    return compare_scatter(setup.values(pairs), exact.values(pairs), scores, statistic,
                           nothing_of(options_.index, *mechanism_));
  }

  std::string why(bool taken) const {
    const std::string pairs = result_.pairs > 0 ? " over " + std::to_string(result_.pairs) + " paired samples" : "";
    const std::string asked = relative_text(result_.accuracy, 3);
    if (taken)
      return "pure geometry, as no joint has play: errors added up linearly come within " + asked +
             " of multibody, which closes the joints exactly, in the " + result_.index + ": off by " +
             relative_text(linear_trial_.error) + " at most" + pairs;
    const std::string exactly = "the one that closes the joints exactly; no joint has play, but ";
    if (!linear_trial_.refusal.empty()) return exactly + "errors cannot be added up here: " + linear_trial_.refusal;
    if (not_closed_ > 0)
      return exactly + "with errors this large they do not close in " + std::to_string(not_closed_) + " of " +
             std::to_string(not_closed_ + result_.pairs) + " samples";
    if (std::abs(linear_trial_.difference) > result_.accuracy)
      return exactly + "errors this large do not just add up: linear in them, the " + result_.index +
             " would be off by " + relative_text(std::abs(linear_trial_.difference)) + pairs + ", and " + asked +
             " was asked for";
    return exactly + "that errors just add up is shown within " + relative_text(linear_trial_.error) + " only in the " +
           result_.index + pairs + ", and " + asked + " was asked for";
  }

  std::shared_ptr<const Mechanism> mechanism_;
  const std::vector<Parameters>& samples_;
  const PilotOptions& options_;
  RungSetup linear_, exact_;
  PilotTrial linear_trial_, exact_trial_;
  std::size_t not_closed_ = 0;  // samples in which not even multibody closes the joints
  int runs_ = 0;
  PilotResult result_;
};

}  // namespace

PilotResult pilot_of_geometry(std::shared_ptr<const Mechanism> mechanism, const std::vector<Parameters>& samples,
                              const PilotOptions& options) {
  return PilotOfGeometry(std::move(mechanism), samples, options).run();
}

}  // namespace boresight
