#include "boresight_analyses/calibration/calibrate.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <mutex>

#include "boresight/mechanism/error.hpp"
#include "boresight_analyses/calibration/calibrator.hpp"
#include "boresight_analyses/calibration/landscape.hpp"
#include "boresight_analyses/calibration/multibody_correction.hpp"
#include "boresight_analyses/random/counter_stream.hpp"

namespace boresight {
namespace {

// A correction that moves no parameter by more than this many standard errors is the last one.
constexpr double kSettledShift = 0.1;
// Each leaves out some data that the one before could not follow.
constexpr int kMostSearches = 3;
// Slopes of multibody are taken over a standard error, but no wider than this.
constexpr double kWidestSlope = 0.05;

}  // namespace

Calibrator::Calibrator(CalibrationProblem& problem, const CalibrationOptions& options)
    : problem_(problem), options_(options) {
  result_.fixed.assign(problem.parameters.size(), false);
  // Free windows are short, and jitter has no time to grow in them.
  if (!follows_from_rest(problem)) loosen(problem);
}

CalibrationResult Calibrator::run() {
  try {
    for (const OutlyingReading& reading : leave_out_lone_readings(problem_))
      warn_of(reading, "it is left out of the fit");
    if (problem_.follows_play()) {
      set_noise(noise_from_differences(problem_));
      fit_masses_that_show();
      // Where it ends in what no step foretells it has lost its way: once more, without those data.
      for (int searches = 0; searches < kMostSearches; ++searches) {
        search();
        if (keep_what_is_foretold(problem_, result_.fit.globals)) break;
      }
      say_what_is_left_out();
      reach(Done::whole_data);
      hold_what_no_impact_shows();
      set_noise(noise_from_residuals(problem_, result_.fit));
      refit("noise estimated from the residuals");
      correct();
      refit("last");
      reach(Done::corrections);
    } else {
      fit_poses();
    }
    weigh_fit();
    if (result_.model_error && (result_.model_error->contradicted() || result_.model_error->departs()) &&
        leads_lower()) {
      stabilise("windows joined");
      set_noise(noise_from_residuals(problem_, result_.fit));
      correct();
      refit("last");
      weigh_fit();
    }
    name_outliers();
    name_unexplained_channels();
    explain_what_is_held();
    judge_fit();
    score_what_is_held_out();
    for (const std::string& law : options_.laws) {
      tell("contact laws", law);
      try {
        result_.laws.push_back(
            law_score(problem_, law, result_.fit.globals, fit_options("law " + law, 25, options_.jobs)));
      } catch (const ComputationError& failure) {  // no reason to lose the rest
        result_.warnings.push_back("law " + law + " is not compared: " + failure.what());
        continue;
      }
      result_.evaluations += result_.laws.back().evaluations;
    }
    compare(result_.laws);
    draw();
    for (const Candidate& candidate : options_.candidates) {
      tell("candidates of a next test", candidate.name);
      result_.next_tests.push_back(
          judge_candidate(problem_, result_.inference, result_.fit.globals, result_.fixed, candidate));
    }
    std::stable_sort(result_.next_tests.begin(), result_.next_tests.end(),
                     [](const NextTest& a, const NextTest& b) { return a.d_gain > b.d_gain; });
  } catch (const CalibrationInterrupted&) {
    result_.interrupted = true;
    if (result_.inference.parameters.empty() && !result_.fit.windows.empty()) result_.inference = infer_now();
  }
  if (!result_.inference.parameters.empty()) {
    const std::vector<std::string> words = boresight::verdict(problem_, result_.inference);
    result_.verdict.insert(result_.verdict.end(), words.begin(), words.end());
    if (result_.model_error) {
      const std::vector<std::string> more = in_words(*result_.model_error, problem_, result_.inference);
      result_.verdict.insert(result_.verdict.end(), more.begin(), more.end());
    }
  }
  return std::move(result_);
}

void Calibrator::warn_of(const OutlyingReading& reading, const std::string& what_becomes_of_it) {
  char text[80];
  std::snprintf(text, sizeof text, " is %.3g robust standard deviations off: ", reading.deviations);
  result_.warnings.push_back(reading.file + ":" + std::to_string(reading.line) + ": " +
                             channel_names()[static_cast<std::size_t>(reading.channel)].name + text +
                             what_becomes_of_it);
}

void Calibrator::name_outliers() {
  constexpr std::size_t kMostNamed = 10;
  const std::vector<OutlyingReading> found = outlying_readings(problem_, result_.fit);
  const char* counts = problem_.loss.kind == Loss::none    ? "it counts in full, as loss = \"none\" asks"
                       : problem_.loss.kind == Loss::huber ? "it counts as one just beyond the noise"
                                                           : "it hardly counts";
  for (std::size_t k = 0; k < std::min(kMostNamed, found.size()); ++k)
    warn_of(found[k], std::string(counts) + "; leave it out of the data if it is no reading");
  if (found.size() > kMostNamed)
    result_.warnings.push_back(std::to_string(found.size() - kMostNamed) +
                               " further readings are more than 10 robust standard deviations off");
}

void Calibrator::name_unexplained_channels() {
  result_.unexplained = unexplained_channels(problem_, result_.inference);
  for (const UnexplainedChannel& channel : result_.unexplained) result_.warnings.push_back(channel.says);
}

void Calibrator::fit_poses() {
  warn_of_play();
  constexpr int kMostRounds = 60;
  constexpr double kSettled = 0.01;
  const VecX first = noise_from_sizes(problem_);
  set_noise(first);
  note(fit(problem_, problem_.start(), {}, fit_options("errors", 40, options_.jobs)));
  std::vector<bool> told;
  for (std::size_t c = 0; c < problem_.channels.size(); ++c) told.push_back(noise_is_told(static_cast<int>(c)));
  for (int round = 0; round < kMostRounds; ++round) {
    const VecX before = problem_.sigma;
    ChannelNoises noises = noises_from_residuals(problem_, result_.fit, told, problem_.noise_of);
    // Data without any noise would weigh without bound.
    set_noise(noises.sigma.cwiseMax(1e-6 * first));
    problem_.noise_of = std::move(noises.shared);
    refit("noise estimated from the residuals");
    const bool settled = (problem_.sigma.cwiseQuotient(before).array() - 1.0).abs().maxCoeff() < kSettled;
    if (settled && result_.fit.converged) return;
  }
}

void Calibrator::score_what_is_held_out() {
  try {
    cut_what_is_held_out(result_.fit.globals);
    result_.hold_out = score_held_out(problem_, result_.fit.globals, options_.jobs);
  } catch (const ComputationError& failure) {
    result_.warnings.push_back(std::string("what is held out is not scored: ") + failure.what());
  }
}

void Calibrator::judge_fit() {
  if (!problem_.follows_play()) return judge_poses();
  const VecX rough = noise_from_differences(problem_).cwiseMax(noise_of_steps(problem_));
  double worst = 0.0;
  int channel = 0;
  for (Eigen::Index c = 0; c < rough.size(); ++c)
    // Whoever says what the noise is is not told otherwise by readings that are too coarse to show it.
    if (!noise_is_told(static_cast<int>(c)) &&
        problem_.sigma[c] * std::sqrt(result_.inference.variance_factor) / rough[c] > worst) {
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

void Calibrator::warn_of_play() {
  const MechanismDescription& m = problem_.runs.front().mechanism->description();
  std::string joints;
  for (const ClearanceDescription& c : m.clearances)
    joints += (joints.empty() ? "" : ", ") + m.joints[static_cast<std::size_t>(c.joint)].name;
  if (!joints.empty())
    result_.warnings.push_back(
        "the play of " + joints +
        " is not followed, as no parameter of a clearance is fitted: what it moves counts as noise");
}

// Poses lie anywhere, and no neighbours say how noisy they are: only where the noise is known can a fit be judged by it.
void Calibrator::judge_poses() {
  const double left = std::sqrt(result_.inference.variance_factor);
  // Of N values a standard deviation is known to 1 / sqrt(2 N); three of them, and a tenth.
  if (!problem_.noise_told || left < 1.1 + 3.0 / std::sqrt(2.0 * static_cast<double>(result_.inference.values))) return;
  char text[240];
  std::snprintf(
      text, sizeof text,
      "The fit leaves %.2g times the noise that is given: errors that are not fitted, play, or what gives way. "
      "Its intervals are widened by as much.",
      left);
  result_.verdict.insert(result_.verdict.begin(), text);
}

bool Calibrator::noise_is_told(int channel) const {
  return options_.noise.size() > 0 &&
         std::isfinite(options_.noise[problem_.channels[static_cast<std::size_t>(channel)]]);
}

void Calibrator::set_noise(const VecX& sigma) {
  problem_.noise_told =
      options_.noise.size() > 0 && std::all_of(problem_.channels.begin(), problem_.channels.end(),
                                               [&](int c) { return std::isfinite(options_.noise[c]); });
  problem_.sigma = problem_.follows_play() ? VecX(sigma.cwiseMax(noise_of_steps(problem_))) : sigma;
  for (std::size_t c = 0; c < problem_.channels.size(); ++c)
    if (noise_is_told(static_cast<int>(c)))
      problem_.sigma[static_cast<Eigen::Index>(c)] = options_.noise[problem_.channels[c]];
}

double Calibrator::share_at(Done what) {
  switch (what) {
    case Done::starts:
      return 0.1;
    case Done::horizon:
      return 0.7;
    case Done::whole_data:
      return 0.8;
    case Done::corrections:
      return 0.9;
    case Done::all:
      break;
  }
  return 1.0;
}

void Calibrator::tell(const std::string& stage, const std::string& estimate) {
  if (options_.progress && !options_.progress(stage, reached_, estimate)) throw CalibrationInterrupted{};
}

void Calibrator::note(FitResult fit) {
  result_.evaluations += fit.evaluations;
  if (fit.interrupted) throw CalibrationInterrupted{};
  optima_.push_back(fit.globals);
  result_.fit = std::move(fit);
}

Inference Calibrator::infer_now() const {
  return infer(problem_, result_.fit, options_.confidence, result_.fixed, options_.jobs);
}

void Calibrator::refit(const std::string& stage) {
  note(fit(problem_, result_.fit.globals, result_.fit.states, fit_options(stage, 15, options_.jobs)));
}

void Calibrator::hold_what_no_impact_shows() {
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
    held_.push_back(
        {static_cast<int>(p), "the data hold no impact in its joint, and restitution shows in impacts alone"});
  }
  if (!any) return;
  for (const auto& [p, why] : held_) result_.fit.globals.u[p] = problem_.start().u[p];
  refit("restitution held: no impacts");
}

void Calibrator::explain_what_is_held() {
  for (const auto& [p, why] : held_) {
    ParameterEstimate& e = result_.inference.parameters[p];
    e.identifiable = false;
    e.reason = why;
  }
}

void Calibrator::weigh_fit() {
  result_.inference = infer_now();
  profile();
  weigh_model_error();
}

void Calibrator::weigh_model_error() {
  if (!options_.discrepancy || !problem_.follows_play()) return;
  tell("what the model may be wrong by", "");
  suspects_ = suspects(problem_, result_.fit, *options_.discrepancy, options_.jobs);
  // Places within three errors of one another are one: the curvature of its loss knows of it.
  std::vector<Globals> others;
  const VecX error = result_.inference.covariance.diagonal().cwiseSqrt();
  const auto apart = [&](const Globals& a, const Globals& b) {
    double most = 0.0;
    for (int p = 0; p < problem_.parameter_count(); ++p)
      if (!result_.fixed[p]) most = std::max(most, std::abs(a.u[p] - b.u[p]) / error[p]);
    return most > 3.0;
  };
  for (const Globals& optimum : optima_)
    if (apart(optimum, result_.fit.globals) &&
        std::all_of(others.begin(), others.end(), [&](const Globals& other) { return apart(optimum, other); }))
      others.push_back(optimum);
  result_.model_error = model_error(problem_, result_.fit, suspects_, others, result_.fixed,
                                    result_.inference.variance_factor, options_.jobs);
  if (result_.model_error->contradicted()) span(path_ends_, problem_, result_.fit.globals, *result_.model_error);
  take_model_error(*result_.model_error, options_.confidence, problem_, result_.fit.globals, result_.inference);
}

void Calibrator::draw() {
  if (!options_.draws) return;
  if (std::all_of(result_.fixed.begin(), result_.fixed.end(), [](bool held) { return held; })) {
    result_.verdict.push_back("No posterior is drawn: every parameter is held.");
    return;
  }
  reach(Done::all);
  tell(kDrawsStage, "");
  const PosteriorDensity density(problem_, result_.fit, result_.fixed, suspects_, result_.inference.variance_factor,
                                 result_.model_error ? result_.model_error->disagreement : 1.0, options_.jobs);
  // Where other optima count, the errors of the fit span them.
  MatX spread = MatX::Zero(density.size(), density.size());
  if (result_.model_error && result_.model_error->optima > 1)
    spread = result_.inference.covariance(density.sampled(), density.sampled());
  result_.draws = posterior_draws(problem_, density, spread, options_.confidence, *options_.draws, options_.seed,
                                  options_.jobs, [&](double share, const std::string& stage) {
                                    if (options_.progress && !options_.progress(kDrawsStage, share, stage))
                                      throw CalibrationInterrupted{};
                                    return true;
                                  });
  result_.evaluations += result_.draws->evaluations;
  result_.verdict.push_back(result_.draws->says);
}

void Calibrator::correct() {
  if (options_.corrections == 0 || !follows_from_rest(problem_)) return;
  std::vector<std::vector<MatX>> slopes;
  VecX slopes_at, width;
  bool settled = false;
  for (int step = 0;; ++step) {
    const Globals at = result_.fit.globals;
    tell("multibody at the optimum", "correction " + std::to_string(step + 1));
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
                              at.lag,
                              std::move(multibody.reading[r]),
                              std::move(multibody.by_time[r]),
                              std::move(multibody.by_lag[r]),
                              slopes[r],
                              std::move(multibody.motion[r])};
      problem_.corrections.push_back(std::move(correction));
    }
    refit("corrected by multibody");
    // The landscape is another one now.
    if (step == 0) stabilise("corrected by multibody");
    settled = step > 0;
    for (int p = 0; p < problem_.parameter_count(); ++p)
      if (!result_.fixed[p] && std::abs(result_.fit.globals.u[p] - at.u[p]) > kSettledShift * error[p]) settled = false;
    result_.corrections.push_back({problem_.values(result_.fit.globals),
                                   (result_.fit.globals.u - at.u).lpNorm<Eigen::Infinity>(), size.difference});
    set_noise(noise_from_residuals(problem_, result_.fit));
  }
}

CalibrationResult calibrate(CalibrationProblem& problem, const CalibrationOptions& options) {
  return Calibrator(problem, options).run();
}

}  // namespace boresight
