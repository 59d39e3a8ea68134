#include "boresight_analyses/study/pilot.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "boresight/mechanism/error.hpp"
#include "boresight/rungs/integrator_choice.hpp"
#include "boresight_analyses/study/measurement.hpp"

namespace boresight {
namespace {

// Steps of a dynamic rung that are tried, against its own choice.
constexpr double kShares[] = {4.0, 2.0, 1.0, 0.5, 0.25};
// Of error control.
constexpr double kTolerances[] = {1e-2, 1e-3, 1e-4};

class Pilot {
 public:
  Pilot(std::shared_ptr<const Mechanism> mechanism, const std::vector<Parameters>& samples, const PilotOptions& options)
      : mechanism_(std::move(mechanism)), samples_(samples), options_(options) {}

  PilotResult run() {
    result_.accuracy = options_.accuracy;
    result_.index = options_.index.title();
    result_.unit = options_.index.si_unit();
    find_reference();
    // The rungs without steps are both tried: which one is cheaper is measured. A rung's trials end with the first step that
    // meets the accuracy: a smaller one only costs more.
    const bool met = try_rung("envelope") | try_rung("quasistatic");
    if (!met && !try_rung("perturbation")) try_rung("multibody");
    conclude();
    return result_;
  }

 private:
  Measurement measured(const Rung& rung, const Parameters& parameters, double step, const std::string& integrator = "",
                       double tolerance = 0.0) {
    MeasureOptions options;
    options.index = options_.index;
    options.advance = [this] { return !options_.progress || options_.progress(static_cast<int>(result_.trials.size())); };
    const Way way{.rung = rung.name(), .integrator = integrator, .step = step, .tolerance = tolerance};
    try {
      const Measurement m = measure(rung, parameters, way, options);
      result_.cpu_seconds += m.spent_seconds;
      return m;
    } catch (const MeasurementInterrupted&) {
      throw PilotInterrupted{};
    }
  }

  void find_reference() {
    const auto rung = make_rung("multibody", mechanism_);
    for (const Parameters& sample : samples_) {
      const Measurement own = measured(*rung, sample, options_.step);
      if (!own.refusal.empty()) throw ComputationError(own.refusal);
      const Measurement fine = measured(*rung, sample, 0.5 * own.step);
      if (!fine.refusal.empty()) throw ComputationError(fine.refusal);
      reference_.push_back(fine.value);
      multibody_.push_back(own);
      // The finer median is wrong by less than the coarser one differs from it; spread of three, of which the median keeps
      // about half.
      const double off = std::abs(own.value - fine.value) + 0.5 * fine.half_spread;
      const double relative = fine.value != 0.0 ? off / std::abs(fine.value) : 0.0;
      result_.reference_error = std::max(result_.reference_error, relative);
    }
    result_.reference = reference_[0];
    PilotTrial own;
    own.rung = "multibody";
    own.step = multibody_[0].step;
    own.value = multibody_[0].value;
    own.cpu_seconds = multibody_[0].cpu_seconds;
    own.reference = true;
    for (std::size_t s = 0; s < samples_.size(); ++s) {
      own.estimate = std::max(own.estimate, multibody_[s].estimate);
      own.error = std::max(own.error, relative_error(multibody_[s], reference_[s]));
    }
    result_.trials.push_back(own);
  }

  // Returns true if one of its steps meets the accuracy.
  bool try_rung(const std::string& name) {
    const auto rung = make_rung(name, mechanism_);
    if (Way{.rung = name}.stepless()) return attempt(*rung, 0.0);
    if (options_.step > 0.0) return attempt(*rung, options_.step);
    double own = 0.0;
    try {
      RunOptions first;
      first.sample_spacing = 0.0;
      first.events = false;
      const RunResult trial = rung->run(samples_[0], first);
      own = mechanism_->duration() / static_cast<double>(trial.cost.steps);
      result_.cpu_seconds += trial.cost.cpu_seconds;
    } catch (const ComputationError& failure) {
      PilotTrial refused;
      refused.rung = name;
      refused.refusal = failure.what();
      result_.trials.push_back(refused);
      return false;
    }
    bool met = false;
    for (double share : kShares)
      if ((met = attempt(*rung, share * own))) break;
    return try_integrators(*rung) || met;
  }

  // Those with error control, from loose to tight, as long as they may come out cheaper than what is chosen already.
  bool try_integrators(const Rung& rung) {
    bool met = false;
    if (!options_.integrators) return false;
    for (const std::string& integrator : integrator_names(rung.name())) {
      if (integrator == "rk4") continue;
      for (double tolerance : kTolerances) {
        if (attempt(rung, 0.0, integrator, tolerance)) {
          met = true;
          break;
        }
        const PilotTrial& last = result_.trials.back();
        if (!last.refusal.empty()) break;
        if (result_.chosen >= 0 && last.cpu_seconds > result_.trials[result_.chosen].cpu_seconds) break;
      }
    }
    return met;
  }

  bool attempt(const Rung& rung, double step, const std::string& integrator = "", double tolerance = 0.0) {
    PilotTrial trial;
    trial.rung = rung.name();
    trial.step = step;
    trial.integrator = integrator;
    trial.tolerance = tolerance;
    for (std::size_t s = 0; s < samples_.size() && trial.refusal.empty(); ++s) {
      const Measurement m = measured(rung, samples_[s], step, integrator, tolerance);
      trial.refusal = m.refusal;
      if (s == 0) trial.value = m.value, trial.cpu_seconds = m.cpu_seconds;
      trial.estimate = std::max(trial.estimate, m.estimate);
      if (m.refusal.empty()) trial.error = std::max(trial.error, relative_error(m, reference_[s]));
    }
    trial.accepted = trial.refusal.empty() && trial.error <= options_.accuracy;
    result_.trials.push_back(trial);
    if (trial.accepted && (result_.chosen < 0 || trial.cpu_seconds < result_.trials[result_.chosen].cpu_seconds))
      result_.chosen = static_cast<int>(result_.trials.size()) - 1;
    return trial.accepted;
  }

  void conclude() {
    result_.met = result_.chosen >= 0;
    if (!result_.met)
      for (std::size_t k = 0; k < result_.trials.size(); ++k)
        if (result_.trials[k].refusal.empty() && !result_.trials[k].reference &&
            (result_.chosen < 0 || result_.trials[k].error < result_.trials[result_.chosen].error))
          result_.chosen = static_cast<int>(k);
    if (result_.chosen < 0) throw ComputationError("no rung can follow this motion: " + result_.trials.back().refusal);
    const PilotTrial& best = result_.trials[result_.chosen];
    char text[400];
    std::snprintf(text, sizeof text,
                  result_.met ? "the cheapest that comes within %.3g %% of multibody in the %s: off by %.2g %% (reference good to %.2g %%)"
                              : "none comes within %.3g %% of multibody in the %s; this one comes nearest: off by %.2g %% "
                                "(reference good to %.2g %%)",
                  100.0 * result_.accuracy, result_.index.c_str(), 100.0 * best.error, 100.0 * result_.reference_error);
    result_.why = text;
  }

  std::shared_ptr<const Mechanism> mechanism_;
  const std::vector<Parameters>& samples_;
  const PilotOptions& options_;
  std::vector<double> reference_;
  std::vector<Measurement> multibody_;
  PilotResult result_;
};

}  // namespace

PilotResult run_pilot(std::shared_ptr<const Mechanism> mechanism, const std::vector<Parameters>& samples,
                      const PilotOptions& options) {
  return Pilot(std::move(mechanism), samples, options).run();
}

}  // namespace boresight
