// The pilot of single motions: every way at neighbouring steps, means compared, the worst motion counts.
#include <algorithm>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>

#include "boresight/ladder/ladder.hpp"
#include "boresight/mechanism/error.hpp"
#include "boresight/rungs/integrator_choice.hpp"
#include "boresight_analyses/study/measurement.hpp"
#include "boresight_analyses/study/pilot_choice.hpp"

namespace boresight {
namespace {

// Steps of a dynamic rung that are tried, against its own choice.
constexpr double kShares[] = {4.0, 2.0, 1.0, 0.5, 0.25};
// Of error control.
constexpr double kTolerancesOfMotions[] = {1e-2, 1e-3, 1e-4};
// Neighbours of each way, and as many again where these leave it open.
constexpr int kFew = 3, kMany = 6;

double mean(const std::vector<double>& values) {
  double sum = 0.0;
  for (double v : values) sum += v;
  return sum / static_cast<double>(values.size());
}

double squares(const std::vector<double>& values) {
  const double m = mean(values);
  double sum = 0.0;
  for (double v : values) sum += (v - m) * (v - m);
  return sum;
}

class PilotOfMotions {
 public:
  PilotOfMotions(std::shared_ptr<const Mechanism> mechanism, const std::vector<Parameters>& motions,
                 const PilotOptions& options)
      : mechanism_(std::move(mechanism)),
        motions_(motions),
        options_(options),
        multibody_(make_rung("multibody", mechanism_)) {}

  PilotResult run() {
    result_.accuracy = options_.accuracy;
    result_.index = options_.index.title();
    result_.unit = options_.index.si_unit();
    find_reference(kFew);
    if (result_.reference_error > options_.accuracy && result_.cpu_seconds < options_.most_seconds)
      find_reference(kMany);
    good_reference_ = result_.reference_error <= options_.accuracy;
    // The rungs without steps are both tried: which one is cheaper is measured. A rung's trials end with the first step that
    // meets the accuracy: a smaller one only costs more.
    const bool met = try_rung("envelope") | try_rung("quasistatic");
    if (!met && !try_rung("perturbation")) try_rung("multibody");
    conclude(result_);
    return result_;
  }

 private:
  struct Reference {
    std::vector<double> own, fine;
    double step = 0.0;       // multibody's own [s]
    double deviation = 0.0;  // within both groups
    double estimate = 0.0, cpu_seconds = 0.0;
  };

  Measurement measured(const Rung& rung, const Parameters& parameters, const RungSetup& setup, int neighbours) {
    MeasureOptions options;
    options.index = options_.index;
    options.neighbours = neighbours;
    options.advance = [this] { return !options_.progress || options_.progress(runs_++); };
    try {
      const Measurement m = measure(rung, parameters, setup, options);
      result_.cpu_seconds += m.spent_seconds;
      return m;
    } catch (const MeasurementInterrupted&) {
      throw PilotInterrupted{};
    }
  }

  static double student(double freedom) { return boost::math::quantile(boost::math::students_t(freedom), 0.975); }

  void find_reference(int neighbours) {
    neighbours_ = neighbours;
    reference_.clear();
    result_.trials.clear();
    result_.reference_error = result_.scatter = 0.0;
    PilotTrial own;
    own.rung = "multibody";
    own.reference = true;
    for (const Parameters& motion : motions_) {
      const Measurement first = measured(*multibody_, motion, {.rung = "multibody", .step = options_.step}, neighbours);
      if (!first.refusal.empty()) throw ComputationError(first.refusal);
      const RungSetup finer = first.integrator.empty()
                                  ? RungSetup{.rung = "multibody", .step = 0.5 * first.step}
                                  : RungSetup{.rung = "multibody", .integrator = first.integrator}.finer();
      const Measurement fine = measured(*multibody_, motion, finer, neighbours);
      if (!fine.refusal.empty()) throw ComputationError(fine.refusal);
      Reference r{.own = first.values, .fine = fine.values, .step = first.step};
      r.deviation = std::sqrt((squares(r.own) + squares(r.fine)) / (2.0 * neighbours - 2.0));
      reference_.push_back(r);
      const double size = std::abs(mean(r.fine));
      if (size > nothing_of(options_.index, *mechanism_))
        result_.scatter = std::max(result_.scatter, r.deviation / size);
      if (reference_.size() == 1) {
        own.step = first.integrator.empty() ? first.step : 0.0;
        own.integrator = first.integrator;
        own.value = mean(r.own);
        own.cpu_seconds = first.cpu_seconds;
      }
      own.estimate = std::max(own.estimate, first.estimate);
      weigh(r.own, reference_.size() - 1, false, own);
    }
    result_.reference = mean(reference_[0].fine);
    result_.reference_error = own.error;
    own.accepted = own.error <= options_.accuracy;
    result_.trials.push_back(own);
  }

  // How far a single run of a way is from the mean of the reference's neighbours, with 95 percent confidence.
  void weigh(const std::vector<double>& values, std::size_t motion, bool stepless, PilotTrial& trial) const {
    const Reference& r = reference_[motion];
    const double size = std::abs(mean(r.fine)), n = static_cast<double>(r.fine.size());
    if (const double nothing = nothing_of(options_.index, *mechanism_);
        size <= nothing && std::abs(mean(values)) <= nothing)
      return;
    // The deviation is that of all groups; a rung without steps has none of its own.
    double sum = squares(r.own) + squares(r.fine), freedom = 2.0 * n - 2.0;
    if (!stepless && values.data() != r.own.data() && values != r.own) {
      sum += squares(values);
      freedom += static_cast<double>(values.size()) - 1.0;
    }
    const double deviation = std::sqrt(sum / freedom);
    const double off = mean(values) - mean(r.fine);
    const double chance = student(freedom) * deviation * std::sqrt((stepless ? 0.0 : 1.0) + 1.0 / n);
    const double error = (std::abs(off) + chance) / std::max(size, 1e-300);
    if (error <= trial.error) return;
    trial.error = error;
    trial.difference = off / std::max(size, 1e-300);
  }

  // Returns true if one of its steps meets the accuracy, or cannot be told from a reference that is worse than that.
  bool try_rung(const std::string& name) {
    const auto rung = make_rung(name, mechanism_);
    if (RungSetup{.rung = name}.stepless()) {
      if (!options_.integrator.empty()) return false;
      return attempt(*rung, {.rung = name});
    }
    if (!options_.integrator.empty())
      return attempt(
          *rung,
          {.rung = name, .integrator = options_.integrator, .step = options_.step, .tolerance = options_.tolerance});
    if (options_.step > 0.0) return attempt(*rung, {.rung = name, .step = options_.step});
    double own = 0.0;
    try {
      RunOptions first;
      first.sample_spacing = 0.0;
      first.events = false;
      first.integrator = "rk4";
      first.model_look = ModelLook::none;
      const RunResult trial = rung->run(motions_[0], first);
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
      if ((met = attempt(*rung, {.rung = name, .step = share * own}))) break;
    return try_integrators(*rung) || met;
  }

  // Those with error control, from loose to tight, as long as they may come out cheaper than what is chosen already.
  bool try_integrators(const Rung& rung) {
    bool met = false;
    if (!options_.integrators) return false;
    for (const std::string& integrator : integrator_names(rung.name())) {
      if (integrator == "rk4") continue;
      for (double tolerance : kTolerancesOfMotions) {
        if (attempt(rung, {.rung = rung.name(), .integrator = integrator, .tolerance = tolerance})) {
          met = true;
          break;
        }
        const PilotTrial& last = result_.trials.back();
        if (!last.refusal.empty()) break;
        if (cheapest_ > 0.0 && last.cpu_seconds > cheapest_) break;
      }
    }
    return met;
  }

  bool attempt(const Rung& rung, const RungSetup& setup) {
    PilotTrial trial;
    trial.rung = setup.rung;
    trial.step = setup.step;
    trial.integrator = setup.integrator;
    trial.tolerance = setup.tolerance;
    for (std::size_t s = 0; s < motions_.size() && trial.refusal.empty(); ++s) {
      const Measurement m = measured(rung, motions_[s], setup, neighbours_);
      trial.refusal = m.refusal;
      if (!m.refusal.empty()) break;
      if (s == 0) trial.value = mean(m.values), trial.cpu_seconds = m.cpu_seconds;
      trial.estimate = std::max(trial.estimate, m.estimate);
      weigh(m.values, s, setup.stepless(), trial);
    }
    trial.accepted = good_reference_ && trial.refusal.empty() && trial.error <= options_.accuracy;
    result_.trials.push_back(trial);
    const bool will_do = trial.accepted || (!good_reference_ && indistinguishable(trial, result_));
    if (will_do && (cheapest_ == 0.0 || trial.cpu_seconds < cheapest_)) cheapest_ = trial.cpu_seconds;
    return will_do;
  }

  std::shared_ptr<const Mechanism> mechanism_;
  const std::vector<Parameters>& motions_;
  const PilotOptions& options_;
  std::unique_ptr<Rung> multibody_;
  std::vector<Reference> reference_;
  int neighbours_ = kFew, runs_ = 0;
  bool good_reference_ = false;
  double cheapest_ = 0.0;  // CPU of the cheapest that will do [s]
  PilotResult result_;
};

}  // namespace

PilotResult pilot_of_motions(std::shared_ptr<const Mechanism> mechanism, const std::vector<Parameters>& motions,
                             const PilotOptions& options) {
  return PilotOfMotions(std::move(mechanism), motions, options).run();
}

}  // namespace boresight
