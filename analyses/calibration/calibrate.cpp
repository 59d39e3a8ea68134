#include "boresight_analyses/calibration/calibrate.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <mutex>

#include "boresight/mechanism/error.hpp"
#include "boresight_analyses/calibration/channel_noise.hpp"
#include "boresight_analyses/calibration/landscape.hpp"
#include "boresight_analyses/calibration/multibody_correction.hpp"
#include "boresight_analyses/random/counter_stream.hpp"

namespace boresight {
namespace {

struct Interrupted {};

// Where no start leads to residuals like noise, more batches are tried, and more of them followed.
constexpr int kMostStarts = 24;
constexpr int kMostFollowed = 6;

// A place lower by this share of s^2, come by along a profile, is gone to, and the profile taken anew. Below
// it the interval is at most a tenth too wide.
constexpr double kLower = 1.0;

// Rounds of looking into other valleys, and descents in each.
constexpr int kMostSettlings = 4, kDescents = 2;

// A correction that moves no parameter by more than this many standard errors is the last one.
constexpr double kSettledShift = 0.1;
// Slopes of multibody are taken over a standard error, but no wider than this.
constexpr double kWidestSlope = 0.05;

class Calibrator {
 public:
  Calibrator(CalibrationProblem& problem, const CalibrationOptions& options)
      : problem_(problem), options_(options) {
    result_.fixed.assign(problem.parameters.size(), false);
    // Free windows are short, and jitter has no time to grow in them.
    if (!follows_from_rest(problem)) loosen(problem);
  }

  CalibrationResult run() {
    try {
      for (const OutlyingReading& reading : leave_out_lone_readings(problem_)) warn_of(reading, "it is left out of the fit");
      set_noise(noise_from_differences(problem_));
      search();
      hold_what_no_impact_shows();
      set_noise(noise_from_residuals(problem_, result_.fit));
      refit("noise estimated from the residuals");
      correct();
      refit("last");
      result_.inference = infer_now();
      name_outliers();
      profile();
      explain_what_is_held();
      judge_fit();
      result_.hold_out = score_held_out(problem_, result_.fit.globals, options_.jobs);
      for (const std::string& law : options_.laws) {
        tell("contact laws", 0.0, law);
        result_.laws.push_back(
            law_score(problem_, law, result_.fit.globals, fit_options("law " + law, 25, options_.jobs)));
        result_.evaluations += result_.laws.back().evaluations;
      }
      compare(result_.laws);
      for (const Candidate& candidate : options_.candidates) {
        tell("candidates of a next test", 0.0, candidate.name);
        result_.next_tests.push_back(
            judge_candidate(problem_, result_.inference, result_.fit.globals, result_.fixed, candidate));
      }
      std::stable_sort(result_.next_tests.begin(), result_.next_tests.end(),
                       [](const NextTest& a, const NextTest& b) { return a.d_gain > b.d_gain; });
    } catch (const Interrupted&) {
      result_.interrupted = true;
      if (result_.inference.parameters.empty() && !result_.fit.windows.empty())
        result_.inference = infer_now();
    }
    if (!result_.inference.parameters.empty()) {
      const std::vector<std::string> words = boresight::verdict(problem_, result_.inference);
      result_.verdict.insert(result_.verdict.end(), words.begin(), words.end());
    }
    return std::move(result_);
  }

 private:
  void warn_of(const OutlyingReading& reading, const std::string& what_becomes_of_it) {
    char text[80];
    std::snprintf(text, sizeof text, " is %.3g robust standard deviations off: ", reading.deviations);
    result_.warnings.push_back(reading.file + ":" + std::to_string(reading.line) + ": " +
                               channel_names()[static_cast<std::size_t>(reading.channel)].name + text + what_becomes_of_it);
  }
  void name_outliers() {
    constexpr std::size_t kMostNamed = 10;
    const std::vector<OutlyingReading> found = outlying_readings(problem_, result_.fit);
    const char* counts = problem_.loss.kind == Loss::none    ? "it counts in full, as loss = \"none\" asks"
                         : problem_.loss.kind == Loss::huber ? "it counts as one just beyond the noise"
                                                             : "it hardly counts";
    for (std::size_t k = 0; k < std::min(kMostNamed, found.size()); ++k)
      warn_of(found[k], std::string(counts) + "; leave it out of the data if it is no reading");
    if (found.size() > kMostNamed)
      result_.warnings.push_back(std::to_string(found.size() - kMostNamed) + " further readings are more than 10 robust standard deviations off");
  }

  // A fit that has lost its way leaves more than the noise that neighbouring samples show.
  void judge_fit() {
    const VecX rough = noise_from_differences(problem_);
    double worst = 0.0;
    int channel = 0;
    for (Eigen::Index c = 0; c < rough.size(); ++c)
      if (problem_.sigma[c] * std::sqrt(result_.inference.variance_factor) / rough[c] > worst) {
        worst = problem_.sigma[c] * std::sqrt(result_.inference.variance_factor) / rough[c];
        channel = problem_.channels[static_cast<std::size_t>(c)];
      }
    if (worst < 1.25) return;
    char text[320];
    std::snprintf(text, sizeof text,
                  "The fit leaves %.2g times the noise that neighbouring samples of %s show: it stands in a "
                  "local minimum, or the "
                  "model leaves something out. Its intervals are then too narrow; more starts or shorter "
                  "windows may help.",
                  worst, channel_names()[channel].name);
    result_.verdict.insert(result_.verdict.begin(), text);
  }

  void set_noise(const VecX& sigma) {
    problem_.sigma = sigma;
    for (std::size_t c = 0; c < problem_.channels.size(); ++c)
      if (options_.noise.size() > 0 && std::isfinite(options_.noise[problem_.channels[c]]))
        problem_.sigma[static_cast<Eigen::Index>(c)] = options_.noise[problem_.channels[c]];
  }

  void tell(const std::string& stage, double share, const std::string& estimate) {
    if (options_.progress && !options_.progress(stage, share, estimate)) throw Interrupted{};
  }

  FitOptions fit_options(const std::string& stage, int iterations, int jobs) {
    FitOptions o;
    o.jobs = jobs;
    o.most_iterations = iterations;
    o.fixed = result_.fixed;
    o.progress = [this, stage](const FitProgress& p) {
      std::string text;
      const std::vector<double> values = problem_.values(p.globals);
      char number[160];
      std::snprintf(number, sizeof number, "iteration %d, cost %.6g", p.iteration, p.cost);
      text = number;
      for (std::size_t k = 0; k < std::min<std::size_t>(4, values.size()); ++k) {
        const std::string& path = problem_.parameters[k].path;
        std::snprintf(number, sizeof number, ", %s %.4g", path.substr(path.rfind('.') + 1).c_str(),
                      values[k]);
        text += number;
      }
      const std::lock_guard lock(mutex_);
      return !options_.progress || options_.progress(stage, 0.0, text);
    };
    return o;
  }

  void note(FitResult fit) {
    result_.evaluations += fit.evaluations;
    if (fit.interrupted) throw Interrupted{};
    result_.fit = std::move(fit);
  }

  // Starts on a short horizon, and from the best of them on to the whole; from the next best, and from more
  // starts, where that one loses its way. Where all do, the model does not explain the data, and the best
  // start's fit stands.
  void search() {
    const CalibrationProblem part = searched_up_to(problem_, 0.125);
    const auto cheaper = [](const Descent& a, const Descent& b) { return a.cost < b.cost; };
    std::vector<Descent> tried;
    std::size_t next = 0;
    std::optional<FitResult> best;
    for (int followed = 0; followed < kMostFollowed; ++followed) {
      while (static_cast<int>(tried.size()) < kMostStarts &&
             (next == tried.size() || leaves_more_than_noise(part, tried[next].to))) {
        try_starts(part, std::max(1, options_.starts), tried);
        std::sort(tried.begin() + static_cast<std::ptrdiff_t>(next), tried.end(), cheaper);
      }
      if (next == tried.size()) break;
      if (!grow(tried[next++].to, true)) continue;
      if (!best || result_.fit.cost < best->cost) best = result_.fit;
      if (!leaves_more_than_noise(problem_, best->globals)) break;
    }
    if (!best) {
      grow(std::min_element(tried.begin(), tried.end(), cheaper)->to, false);
      best = result_.fit;
    }
    result_.fit = *best;
  }

  struct Descent {
    Globals from, to;
    double cost = 0.0;
    long evaluations = 0;
  };

  // The start given, and others within a factor of two of it (restitution: one in the logit).
  Globals start(int number) const {
    const CounterStream stream(options_.seed, StreamPurpose::sample);
    Globals at = problem_.start();
    for (int p = 0; number > 0 && p < problem_.parameter_count(); ++p) {
      const FittedParameter& parameter = problem_.parameters[p];
      const double reach = parameter.transform == Transform::log ? std::log(2.0) : 1.0;
      const double draw = stream.uniform(static_cast<std::uint64_t>(number), static_cast<std::uint64_t>(p));
      at.u[p] = std::clamp(at.u[p] + reach * (2.0 * draw - 1.0), parameter.lowest_coordinate(),
                           parameter.highest_coordinate());
    }
    return at;
  }

  // `count` more of them, side by side.
  void try_starts(const CalibrationProblem& part, int count, std::vector<Descent>& tried) {
    const int before = static_cast<int>(tried.size()), side_by_side = std::min(options_.jobs, count);
    std::vector<Descent> more(count);
    std::atomic<bool> stop{false};
    in_parallel(count, side_by_side, [&](int s) {
      Descent& d = more[s];
      d.from = d.to = start(before + s);
      for (const double share :
           follows_from_rest(part) ? std::vector<double>{0.25, 0.5, 1.0} : std::vector<double>{1.0}) {
        if (stop) return;
        FitOptions o =
            fit_options("start " + std::to_string(before + s + 1) + " of " + std::to_string(before + count),
                        12, std::max(1, options_.jobs / side_by_side));
        o.cost_tolerance = 1e-4;
        const FitResult found = fit(searched_up_to(part, share), d.to, {}, o);
        stop = stop || found.interrupted;
        d.evaluations += found.evaluations;
        d.to = found.globals;
        d.cost = found.cost;
      }
    });
    if (stop) throw Interrupted{};
    for (const Descent& d : more) {
      result_.starts.push_back({problem_.values(d.from), problem_.values(d.to), d.cost});
      result_.evaluations += d.evaluations;
      tried.push_back(d);
    }
  }

  // On a horizon that doubles from a quarter to the whole. give_up: returns false as soon as the place is
  // lost.
  bool grow(Globals at, bool give_up) {
    for (double share = 0.25; share < 0.99 && follows_from_rest(problem_); share *= 2.0) {
      FitOptions o =
          fit_options("horizon " + std::to_string(static_cast<int>(100.0 * share)) + " %", 10, options_.jobs);
      o.cost_tolerance = 1e-5;
      const CalibrationProblem part = searched_up_to(problem_, share);
      const FitResult found = fit(part, at, {}, o);
      result_.evaluations += found.evaluations;
      if (found.interrupted) throw Interrupted{};
      at = found.globals;
      if (share > 0.4) look_around(part, result_.fixed, options_.jobs, at);
      if (give_up && leaves_more_than_noise(part, at)) return false;
    }
    if (follows_from_rest(problem_)) {
      const FitResult found =
          fit(searched_up_to(problem_, 1.0), at, {}, fit_options("whole data", 20, options_.jobs));
      result_.evaluations += found.evaluations;
      if (found.interrupted) throw Interrupted{};
      at = found.globals;
    }
    note(fit(problem_, at, {}, fit_options("whole data", 30, options_.jobs)));
    settle("whole data");
    return true;
  }

  // Goes on from other valleys until none leads lower.
  void settle(const std::string& stage) {
    if (!follows_from_rest(problem_)) return;
    for (int round = 0; round < kMostSettlings; ++round) {
      const double before = result_.fit.cost;
      const Inference inference = infer_now();
      std::vector<Globals> places =
          other_valleys(problem_, result_.fit, inference, result_.fixed, options_.jobs, result_.evaluations);
      places.resize(std::min<std::size_t>(kDescents, places.size()));
      for (const Globals& place : places) {
        FitResult found =
            fit(problem_, place, {}, fit_options(stage + ", another valley", 15, options_.jobs));
        if (found.interrupted) throw Interrupted{};
        result_.evaluations += found.evaluations;
        if (found.cost < result_.fit.cost) result_.fit = std::move(found);
      }
      if (!(result_.fit.cost < before - 0.1 * inference.variance_factor)) return;
    }
  }

  // Intervals by the loss itself. Where a profile comes by a lower place than the optimum, that is the
  // optimum.
  void profile() {
    if (!options_.profile) return;
    for (int round = 0; round < kMostSettlings; ++round) {
      tell("profile likelihood", 0.0, "");
      FitResult lower = result_.fit;
      result_.profiles = profile_likelihood(problem_, result_.fit, result_.inference, result_.fixed,
                                            options_.confidence, options_.jobs, lower);
      if (!(lower.cost < result_.fit.cost - kLower * result_.inference.variance_factor)) break;
      note(fit(problem_, lower.globals, lower.states, fit_options("from a lower place", 15, options_.jobs)));
      result_.inference = infer_now();
    }
    take_intervals(result_.profiles, options_.confidence, problem_, result_.inference);
  }

  Inference infer_now() const {
    return infer(problem_, result_.fit, options_.confidence, result_.fixed, options_.jobs);
  }

  void refit(const std::string& stage) {
    note(fit(problem_, result_.fit.globals, result_.fit.states, fit_options(stage, 15, options_.jobs)));
  }

  // Restitution is a matter of impacts alone: where none is seen in its joints, no fit can know it.
  void hold_what_no_impact_shows() {
    const Inference first = infer_now();
    const MechanismDescription& m = problem_.runs.front().mechanism->description();
    bool any = false;
    for (std::size_t p = 0; p < problem_.parameters.size(); ++p) {
      const std::string& path = problem_.parameters[p].path;
      if (!path.ends_with(".restitution")) continue;
      int impacts = 0;
      for (std::size_t c = 0; c < m.clearances.size(); ++c)
        if (path.starts_with("clearance.*.") ||
            path.starts_with("clearance." + m.joints[m.clearances[c].joint].name + "."))
          impacts += first.impacts[c];
      if (impacts > 0) continue;
      result_.fixed[p] = any = true;
      held_.push_back({static_cast<int>(p),
                       "the data hold no impact in its joint, and restitution shows in impacts alone"});
    }
    if (!any) return;
    for (const auto& [p, why] : held_) result_.fit.globals.u[p] = problem_.start().u[p];
    refit("restitution held: no impacts");
  }
  void explain_what_is_held() {
    for (const auto& [p, why] : held_) {
      ParameterEstimate& e = result_.inference.parameters[p];
      e.identifiable = false;
      e.reason = why;
    }
  }

  // First an offset, multibody less the fit's rung at the optimum. From there on multibody's own value and
  // slopes, until that moves nothing that matters; slopes are taken anew where the fit has left the width
  // over which they were taken.
  void correct() {
    if (options_.corrections == 0 || !follows_from_rest(problem_)) return;
    std::vector<std::vector<MatX>> slopes;
    VecX slopes_at, width;
    bool settled = false;
    for (int step = 0;; ++step) {
      const Globals at = result_.fit.globals;
      tell("multibody at the optimum", 0.0, "correction " + std::to_string(step + 1));
      MultibodyAt multibody = multibody_at(problem_, at, options_.jobs);
      const CorrectionSize size = size_of(problem_, at, multibody);
      result_.confirmation = size.confirmation;
      if (step == options_.corrections || settled) return;
      const VecX error = infer_now().covariance.diagonal().cwiseSqrt().head(problem_.parameter_count());
      if (step > 0 && (slopes.empty() || ((at.u - slopes_at).cwiseAbs() - width).maxCoeff() > 0.0)) {
        slopes_at = at.u;
        width.setZero(error.size());
        for (int p = 0; p < width.size(); ++p)
          if (!result_.fixed[p]) width[p] = std::min(error[p], kWidestSlope);
        slopes = multibody_slopes(problem_, at, width, options_.jobs);
      }
      problem_.corrections.clear();
      for (std::size_t r = 0; r < problem_.runs.size(); ++r) {
        ModelCorrection correction{std::move(multibody.difference[r]), {}};
        if (!slopes.empty())
          correction.tangent = {at.u,
                                at.time_offset,
                                std::move(multibody.reading[r]),
                                std::move(multibody.by_time[r]),
                                slopes[r],
                                std::move(multibody.motion[r])};
        problem_.corrections.push_back(std::move(correction));
      }
      refit("corrected by multibody");
      // The landscape is another one now.
      if (step == 0) settle("corrected by multibody");
      settled = step > 0;
      for (int p = 0; p < problem_.parameter_count(); ++p)
        if (!result_.fixed[p] && std::abs(result_.fit.globals.u[p] - at.u[p]) > kSettledShift * error[p])
          settled = false;
      result_.corrections.push_back({problem_.values(result_.fit.globals),
                                     (result_.fit.globals.u - at.u).lpNorm<Eigen::Infinity>(),
                                     size.difference});
      set_noise(noise_from_residuals(problem_, result_.fit));
    }
  }

  CalibrationProblem& problem_;
  const CalibrationOptions& options_;
  CalibrationResult result_;
  std::vector<std::pair<int, std::string>> held_;
  std::mutex mutex_;
};

}  // namespace

CalibrationResult calibrate(CalibrationProblem& problem, const CalibrationOptions& options) {
  return Calibrator(problem, options).run();
}

}  // namespace boresight
