// The pilot of a study: ways compared pair by pair over the study's own scatter, pairs added until the answer is clear.
#include <algorithm>
#include <cmath>
#include <map>

#include "boresight/mechanism/error.hpp"
#include "boresight/rungs/integrator_choice.hpp"
#include "boresight_analyses/study/lane_sample_model.hpp"
#include "boresight_analyses/study/pilot_choice.hpp"
#include "boresight_analyses/study/setup_samples.hpp"

namespace boresight {
namespace {

// What may rank the samples takes no longer than this [s of CPU].
constexpr double kRankingSeconds = 1.0;
// What a step errs by over what half of it errs by, less one: a contact's force has a kink where it begins, which makes RK4 of
// second order through it. So the reference is good to a third of what multibody's own step is found to be off from it.
constexpr double kOwnOverReference = 3.0;
// Of error control, for rungs without lanes.
constexpr double kTolerancesOfScatter[] = {1e-2, 1e-3};

class PilotOfScatter {
 public:
  PilotOfScatter(std::shared_ptr<const Mechanism> mechanism, const std::vector<Parameters>& samples,
                 const PilotOptions& options)
      : mechanism_(std::move(mechanism)), samples_(samples), options_(options) {}

  PilotResult run() {
    result_.accuracy = options_.accuracy;
    result_.index = options_.index.title() + ", " + options_.statistic->title();
    result_.unit = options_.index.si_unit();
    choose_samples_by_rank();
    make_reference();
    const bool enough = try_tier(first_tier()) || try_tier(second_tier());
    if (!enough) try_tier(multibody_tier());
    report_reference();
    conclude(result_);
    state_errors();
    for (const auto& setup : setups_) result_.cpu_seconds += setup->spent_seconds();
    return result_;
  }

 private:
  std::function<bool()> advance() {
    return [this] { return !options_.progress || options_.progress(runs_++); };
  }

  SetupSamples& add(const RungSetup& setup) {
    setups_.push_back(
        std::make_unique<SetupSamples>(mechanism_, samples_, setup, options_.index, options_.scene_varies));
    return *setups_.back();
  }
  void compute(SetupSamples& setup, const std::vector<std::size_t>& which) {
    if (!setup.compute(which, options_.jobs, advance())) throw PilotInterrupted{};
  }
  double spent() const {
    double seconds = result_.cpu_seconds;
    for (const auto& setup : setups_) seconds += setup->spent_seconds();
    return seconds;
  }

  bool lanes_serve() const {
    RunOptions run;
    run.step = options_.step;
    run.integrator = options_.integrator;
    return options_.lanes && LaneSampleModel::serve(*mechanism_, options_.index, run);
  }

  // Ranks the samples by the cheapest way there is that takes them all in little time.
  void choose_samples_by_rank() {
    std::vector<double> ranked_by;
    RungSetup setup{.rung = lanes_serve() ? "perturbation" : "quasistatic", .lanes = lanes_serve()};
    try {
      SetupSamples& ranking = add(setup);
      for (std::size_t k = 0; k < samples_.size() && ranking.spent_seconds() < kRankingSeconds;) {
        std::vector<std::size_t> some;
        for (; k < samples_.size() && some.size() < (setup.lanes ? 64u : 8u); ++k) some.push_back(k);
        compute(ranking, some);
        for (std::size_t s : some) ranked_by.push_back(ranking.value(s));
        if (ranking.failed() > 0 && ranking.failed() == ranked_by.size()) break;
      }
    } catch (const ComputationError&) {
      ranked_by.clear();  // plain samples then
    }
    chosen_ = choose_samples(ranked_by, samples_.size(), kMostPairs, *options_.statistic);
  }

  // Multibody's own step is the smallest that it chooses for the first samples.
  void make_reference() {
    std::vector<Parameters> first;
    for (std::size_t k = 0; k < std::min<std::size_t>(3, chosen_.sample.size()); ++k)
      first.push_back(samples_[chosen_.sample[k]]);
    RungSetup own{.rung = "multibody", .step = options_.step};
    if (own.step == 0.0) own.step = common_step("multibody", mechanism_, first, own.options());
    if (own.step == 0.0) own = {.rung = "multibody", .integrator = "rosenbrock", .tolerance = kMultibodyTolerance};
    own_ = &add(own);
    fine_ = &add(own.finer());
    take_pairs(kPairs[0]);
    if (pairs_.size() < 4)
      throw ComputationError(!fine_->refusal().empty()  ? fine_->refusal()
                             : !own_->refusal().empty() ? own_->refusal()
                                                        : "too few samples for a pilot");
  }

  // The first n chosen samples on multibody, those that it can follow.
  void take_pairs(std::size_t n) {
    n = std::min(n, chosen_.sample.size());
    const std::vector<std::size_t> which(chosen_.sample.begin(),
                                         chosen_.sample.begin() + static_cast<std::ptrdiff_t>(n));
    compute(*own_, which);
    compute(*fine_, which);
    asked_ = n;
    pairs_.clear();
    scores_.clear();
    for (std::size_t k = 0; k < n; ++k) {
      if (!std::isfinite(fine_->value(which[k])) || !std::isfinite(own_->value(which[k]))) continue;
      pairs_.push_back(which[k]);
      if (!chosen_.score.empty()) scores_.push_back(chosen_.score[k]);
    }
    reference_ = compared(*own_);
    result_.reference_error = reference_.bound() / kOwnOverReference;
    result_.reference = reference_.reference;
    result_.pairs = pairs_.size();
  }

  ScatterDifference compared(const SetupSamples& setup) const {
    const std::vector<double> values = setup.values(pairs_), reference = fine_->values(pairs_);
    return compare_scatter(values, reference, scores_, *options_.statistic, nothing_of(options_.index, *mechanism_));
  }

  bool more_pairs() {
    const double most = most_seconds(options_, own_->cpu_seconds());
    for (std::size_t n : kPairs) {
      if (n <= asked_) continue;
      if (asked_ >= chosen_.sample.size()) return false;
      // As many pairs again cost about as much again.
      const double foreseen = static_cast<double>(n - asked_) * (own_->cpu_seconds() + fine_->cpu_seconds());
      if (spent() + foreseen > most) return false;
      take_pairs(n);
      return true;
    }
    return false;
  }

  std::vector<RungSetup> first_tier() {
    if (!options_.integrator.empty())
      return {{.rung = "perturbation",
               .integrator = options_.integrator,
               .step = options_.step,
               .tolerance = options_.tolerance}};
    std::vector<RungSetup> setups = {{.rung = "envelope"}, {.rung = "quasistatic"}};
    if (lanes_serve())
      setups.push_back({.rung = "perturbation", .tolerance = kLaneTolerance, .lanes = true});
    else if (const double step = step_of_perturbation(); step > 0.0)
      setups.push_back({.rung = "perturbation", .step = step});
    else if (!perturbation_refused_ && !options_.integrators)
      setups.push_back({.rung = "perturbation", .integrator = "rosenbrock", .tolerance = kPerturbationTolerance});
    if (options_.integrators && options_.step == 0.0 && !lanes_serve())
      setups.push_back({.rung = "perturbation", .integrator = "rosenbrock", .tolerance = kTolerancesOfScatter[0]});
    return setups;
  }

  std::vector<RungSetup> second_tier() {
    if (!options_.integrator.empty() || options_.step > 0.0) return {};
    if (lanes_serve()) return {{.rung = "perturbation", .tolerance = 0.1 * kLaneTolerance, .lanes = true}};
    std::vector<RungSetup> setups;
    if (step_of_perturbation() > 0.0) setups.push_back({.rung = "perturbation", .step = 0.5 * step_of_perturbation()});
    if (options_.integrators)
      for (const char* integrator : {"rosenbrock", "dopri5"})
        setups.push_back({.rung = "perturbation", .integrator = integrator, .tolerance = kTolerancesOfScatter[1]});
    return setups;
  }

  std::vector<RungSetup> multibody_tier() {
    if (!options_.integrator.empty())
      return {{.rung = "multibody",
               .integrator = options_.integrator,
               .step = options_.step,
               .tolerance = options_.tolerance}};
    std::vector<RungSetup> setups = {own_->setup()};
    // Multibody's implicit method may be cheaper where contacts rest.
    if (options_.integrators && options_.step == 0.0)
      setups.push_back({.rung = "multibody", .integrator = "rosenbrock", .tolerance = kMultibodyTolerance});
    return setups;
  }

  // Perturbation's own, for all samples; 0 where it takes an integrator of its own, or cannot follow them, which is then told.
  double step_of_perturbation() {
    if (options_.step > 0.0) return options_.step;
    if (perturbation_step_ >= 0.0) return perturbation_step_;
    std::vector<Parameters> first;
    for (std::size_t k = 0; k < std::min<std::size_t>(3, pairs_.size()); ++k) first.push_back(samples_[pairs_[k]]);
    try {
      perturbation_step_ = common_step("perturbation", mechanism_, first, {});
    } catch (const ComputationError& failure) {
      perturbation_step_ = 0.0;
      perturbation_refused_ = true;
      PilotTrial refused;
      refused.rung = "perturbation";
      refused.refusal = failure.what();
      result_.trials.push_back(refused);
    }
    return perturbation_step_;
  }

  struct Candidate {
    SetupSamples* samples = nullptr;
    bool rejected = false, accepted = false;
    ScatterDifference found;
  };

  // Tries these ways side by side, on more pairs until one is accepted, all are rejected, or the time is spent.
  // Returns true if one of them will do.
  bool try_tier(const std::vector<RungSetup>& setups) {
    std::vector<Candidate> candidates;
    for (const RungSetup& setup : setups) {
      const bool own = setup.rung == "multibody" && setup.integrator.empty() && setup.step == own_->setup().step;
      candidates.push_back({.samples = own ? own_ : known(setup), .rejected = false, .accepted = false, .found = {}});
    }
    for (;;) {
      bool accepted = false, open = false;
      for (Candidate& c : candidates) {
        if (c.rejected) continue;
        judge(c);
        accepted = accepted || c.accepted;
        open = open || !c.rejected;
      }
      // Multibody is what the others are held against: where nothing cheaper is left more pairs would only confirm it.
      if (accepted || !open || hopeless() || !more_pairs()) break;
    }
    bool will_do = false;
    for (const Candidate& c : candidates) {
      PilotTrial trial = trial_of(*c.samples, c.found);
      trial.accepted = c.accepted && good_reference();
      trial.reference = c.samples == own_;
      will_do = will_do || trial.accepted || (!good_reference() && indistinguishable(trial, result_));
      result_.trials.push_back(trial);
    }
    return will_do;
  }

  // Whether no number of pairs that the pilot may take would show the reference to be good enough.
  bool hopeless() const {
    const double at_best = reference_.half_width * std::sqrt(static_cast<double>(pairs_.size()) / kMostPairs);
    const double enough = kOwnOverReference * options_.accuracy;
    return at_best > enough || std::abs(reference_.difference) - reference_.half_width > enough;
  }
  bool good_reference() const { return result_.reference_error <= options_.accuracy; }

  // What ranked the samples has computed these already.
  SetupSamples* known(const RungSetup& setup) {
    for (const auto& w : setups_)
      if (w->setup().family() == setup.family() && w->setup().lanes == setup.lanes && w->setup().step == setup.step &&
          (w->setup().tolerance == setup.tolerance ||
           (setup.lanes && w->setup().tolerance == 0.0 && setup.tolerance == kLaneTolerance)))
        return w.get();
    return &add(setup);
  }

  void judge(Candidate& c) {
    c.accepted = false;
    try {
      compute(*c.samples, pairs_);
    } catch (const ComputationError& failure) {  // no scene
      c.rejected = true;
      c.found = {};
      why_refused_[c.samples] = failure.what();
      return;
    }
    for (std::size_t k : pairs_)
      if (!std::isfinite(c.samples->value(k))) {
        c.rejected = true;
        why_refused_[c.samples] = c.samples->refusal();
        return;
      }
    c.found = compared(*c.samples);
    c.accepted = c.found.bound() <= options_.accuracy && good_reference();
    c.rejected = std::abs(c.found.difference) - c.found.half_width > options_.accuracy + result_.reference_error;
  }

  PilotTrial trial_of(const SetupSamples& samples, const ScatterDifference& found) const {
    PilotTrial trial;
    const RungSetup& setup = samples.setup();
    trial.rung = setup.rung;
    trial.step = setup.step;
    trial.integrator = setup.integrator;
    trial.tolerance = setup.tolerance > 0.0 ? setup.tolerance : setup.lanes ? kLaneTolerance : 0.0;
    trial.lanes = setup.lanes;
    if (const auto refused = why_refused_.find(&samples); refused != why_refused_.end()) {
      trial.refusal = refused->second;
      return trial;
    }
    trial.value = found.value;
    trial.difference = found.difference;
    trial.error = found.bound();
    trial.estimate = samples.estimate();
    trial.cpu_seconds = samples.cpu_seconds();
    trial.pairs = found.pairs;
    return trial;
  }

  void state_errors() {
    const PilotTrial& chosen = result_.trials[result_.chosen];
    for (const auto& setup : setups_) {
      const PilotTrial trial = trial_of(*setup, {});
      if (trial.rung != chosen.rung || trial.step != chosen.step || trial.integrator != chosen.integrator ||
          trial.tolerance != chosen.tolerance || trial.lanes != chosen.lanes || setup.get() == fine_)
        continue;
      for (const double p : stated_probabilities(*options_.statistic)) {
        const std::vector<double> reference = fine_->values(pairs_);
        const ScatterDifference d =
            compare_scatter(setup->values(pairs_), reference, scores_, {p}, nothing_of(options_.index, *mechanism_));
        // The reference is off by something itself, as its own step shows.
        const ScatterDifference own =
            compare_scatter(own_->values(pairs_), reference, scores_, {p}, nothing_of(options_.index, *mechanism_));
        result_.errors.push_back({p, d.bound() + own.bound() / kOwnOverReference});
      }
      return;
    }
  }

  // Where no tier has shown it, multibody at its own step stands among the trials all the same.
  void report_reference() {
    for (const PilotTrial& t : result_.trials)
      if (t.reference) return;
    PilotTrial own = trial_of(*own_, reference_);
    own.reference = true;
    own.accepted = own.error <= options_.accuracy && good_reference() && options_.integrator.empty();
    result_.trials.push_back(own);
  }

  std::shared_ptr<const Mechanism> mechanism_;
  const std::vector<Parameters>& samples_;
  const PilotOptions& options_;
  ChosenSamples chosen_;
  std::vector<std::unique_ptr<SetupSamples>> setups_;
  SetupSamples *own_ = nullptr, *fine_ = nullptr;
  std::size_t asked_ = 0;
  std::vector<std::size_t> pairs_;
  std::vector<double> scores_;
  ScatterDifference reference_;
  std::map<const SetupSamples*, std::string> why_refused_;
  double perturbation_step_ = -1.0;
  bool perturbation_refused_ = false;
  int runs_ = 0;
  PilotResult result_;
};

}  // namespace

PilotResult pilot_of_scatter(std::shared_ptr<const Mechanism> mechanism, const std::vector<Parameters>& samples,
                             const PilotOptions& options) {
  return PilotOfScatter(std::move(mechanism), samples, options).run();
}

}  // namespace boresight
