#include "boresight_analyses/study/pilot.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>

#include "boresight/mechanism/error.hpp"

namespace boresight {
namespace {

// Neighbouring steps whose results are as good as the first: impacts fall out differently in each.
constexpr double kNeighbours[] = {1.0, 0.985, 0.97};
// Steps of a dynamic rung that are tried, against its own choice.
constexpr double kShares[] = {4.0, 2.0, 1.0, 0.5, 0.25};

struct Runs {
  double median = 0.0, half_spread = 0.0, estimate = 0.0, step = 0.0, cpu_seconds = 0.0;
};

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
  // The rung at about this step (0: its own) on one sample.
  Runs runs(const Rung& rung, const Parameters& parameters, double step) {
    Runs out;
    std::vector<double> values;
    const bool stepless = step < 0.0;
    for (double share : kNeighbours) {
      if (options_.progress && !options_.progress(static_cast<int>(result_.trials.size()))) throw PilotInterrupted{};
      RunOptions run;
      run.sample_spacing = 0.0;
      run.events = false;
      run.step = stepless ? 0.0 : (step == 0.0 ? out.step : step) * share;
      const RunResult result = rung.run(parameters, run);
      values.push_back(options_.index.of(result.index));
      out.estimate = std::max(out.estimate, result.error.total());
      out.cpu_seconds = out.cpu_seconds == 0.0 ? result.cost.cpu_seconds : std::min(out.cpu_seconds, result.cost.cpu_seconds);
      result_.cpu_seconds += result.cost.cpu_seconds;
      if (out.step == 0.0 && result.cost.steps > 0) out.step = mechanism_->duration() / static_cast<double>(result.cost.steps);
      if (stepless && values.size() == 2) break;  // the first one may have built the scene
    }
    std::sort(values.begin(), values.end());
    out.median = values[values.size() / 2];
    out.half_spread = 0.5 * (values.back() - values.front());
    return out;
  }

  void find_reference() {
    const auto rung = make_rung("multibody", mechanism_);
    for (const Parameters& sample : samples_) {
      const Runs own = runs(*rung, sample, options_.step);
      const Runs fine = runs(*rung, sample, 0.5 * own.step);
      reference_.push_back(fine.median);
      multibody_.push_back(own);
      // The finer median is wrong by less than the coarser one differs from it; spread of three, of which the median keeps
      // about half.
      const double off = std::abs(own.median - fine.median) + 0.5 * fine.half_spread;
      const double relative = fine.median != 0.0 ? off / std::abs(fine.median) : 0.0;
      result_.reference_error = std::max(result_.reference_error, relative);
    }
    result_.reference = reference_[0];
    PilotTrial own;
    own.rung = "multibody";
    own.step = multibody_[0].step;
    own.value = multibody_[0].median;
    own.cpu_seconds = multibody_[0].cpu_seconds;
    own.reference = true;
    for (std::size_t s = 0; s < samples_.size(); ++s) {
      own.estimate = std::max(own.estimate, multibody_[s].estimate);
      const double off = std::abs(multibody_[s].median - reference_[s]) + multibody_[s].half_spread;
      if (reference_[s] != 0.0) own.error = std::max(own.error, off / std::abs(reference_[s]));
    }
    result_.trials.push_back(own);
  }

  // Returns true if one of its steps meets the accuracy.
  bool try_rung(const std::string& name) {
    const auto rung = make_rung(name, mechanism_);
    const bool stepless = name == "envelope" || name == "quasistatic";
    if (stepless) return attempt(*rung, -1.0);
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
    for (double share : kShares)
      if (attempt(*rung, share * own)) return true;
    return false;
  }

  bool attempt(const Rung& rung, double step) {
    PilotTrial trial;
    trial.rung = rung.name();
    trial.step = std::max(0.0, step);
    try {
      for (std::size_t s = 0; s < samples_.size(); ++s) {
        const Runs r = runs(rung, samples_[s], step);
        if (s == 0) trial.value = r.median, trial.cpu_seconds = r.cpu_seconds;
        trial.estimate = std::max(trial.estimate, r.estimate);
        const double reference = std::abs(reference_[s]);
        const double off = std::abs(r.median - reference_[s]) + r.half_spread;
        // An index that is zero on both (angles where axes stay parallel) agrees.
        const bool nothing = reference <= kNothing && std::abs(r.median) <= kNothing;
        trial.error = std::max(trial.error, nothing ? 0.0 : off / std::max(reference, 1e-300));
      }
      trial.accepted = trial.error <= options_.accuracy;
    } catch (const ComputationError& failure) {
      trial.refusal = failure.what();
    }
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

  static constexpr double kNothing = 1e-9;  // [m] or [rad]: rounding of a motion integrated in metres

  std::shared_ptr<const Mechanism> mechanism_;
  const std::vector<Parameters>& samples_;
  const PilotOptions& options_;
  std::vector<double> reference_;
  std::vector<Runs> multibody_;
  PilotResult result_;
};

}  // namespace

PilotResult run_pilot(std::shared_ptr<const Mechanism> mechanism, const std::vector<Parameters>& samples,
                      const PilotOptions& options) {
  return Pilot(std::move(mechanism), samples, options).run();
}

}  // namespace boresight
