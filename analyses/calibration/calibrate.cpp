#include "boresight_analyses/calibration/calibrate.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <cmath>
#include <mutex>

#include "boresight/mechanism/error.hpp"
#include "boresight_analyses/calibration/multibody_correction.hpp"
#include "boresight_analyses/random/counter_stream.hpp"

namespace boresight {
namespace {

struct Interrupted {};

// Where the search only feels its way, motions may jitter by a hundredth of the noise.
constexpr double kSearchTolerance = 1e-5, kSearchDerivativeTolerance = 1e-3;

// Of settle(): rounds, descents in each, and the share of the foretold rise below which a place is worth one.
constexpr int kMostSettlings = 4, kDescents = 2;
constexpr double kSurprise = 0.5;

// A correction that moves no parameter by more than this many standard errors is the last one.
constexpr double kSettledShift = 0.1;
// Slopes of multibody are taken over a standard error, but no wider than this.
constexpr double kWidestSlope = 0.05;

// A problem whose runs are followed up to a share of the whole only.
CalibrationProblem up_to(const CalibrationProblem& problem, double share) {
  CalibrationProblem part = problem;
  part.tolerance = kSearchTolerance;
  part.derivative_tolerance = kSearchDerivativeTolerance;
  for (Window& w : part.windows) {
    const std::vector<double>& t = problem.runs[w.run].data.time;
    const double end = t[w.first] + share * (t[w.last] - t[w.first]);
    if (!w.from_rest) continue;
    while (w.last > w.first + 1 && t[w.last] > end) --w.last;
    w.end = std::min(w.end, t[w.last] + problem.largest_time_offset);
  }
  return part;
}

bool grows(const CalibrationProblem& problem) {
  return std::any_of(problem.windows.begin(), problem.windows.end(),
                     [](const Window& w) { return w.from_rest; });
}

class Calibrator {
 public:
  Calibrator(CalibrationProblem& problem, const CalibrationOptions& options)
      : problem_(problem), options_(options) {
    result_.fixed.assign(problem.parameters.size(), false);
  }

  CalibrationResult run() {
    try {
      set_noise(noise_from_differences(problem_));
      const Globals best = best_start();
      grow(best, 0.25);
      hold_what_no_impact_shows();
      noise_from_residuals();
      refit("noise estimated from the residuals");
      correct();
      refit("last");
      result_.inference = infer(problem_, result_.fit, options_.confidence, result_.fixed, options_.jobs);
      explain_what_is_held();
      judge_fit();
      result_.hold_out = held_out(problem_, result_.fit.globals);
      if (options_.profile) profile();
      compare_laws();
      next_tests();
    } catch (const Interrupted&) {
      result_.interrupted = true;
      if (result_.inference.parameters.empty() && !result_.fit.windows.empty())
        result_.inference = infer(problem_, result_.fit, options_.confidence, result_.fixed, options_.jobs);
    }
    if (!result_.inference.parameters.empty()) {
      const std::vector<std::string> words = boresight::verdict(problem_, result_.inference);
      result_.verdict.insert(result_.verdict.end(), words.begin(), words.end());
    }
    return std::move(result_);
  }

 private:
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

  // The start given, and others within a factor of two of it (restitution: one in the logit), tried on a
  // short horizon.
  Globals best_start() {
    const CalibrationProblem part = up_to(problem_, 0.125);
    const CounterStream stream(options_.seed, StreamPurpose::sample);
    std::vector<Globals> from(std::max(1, options_.starts), problem_.start()), to = from;
    std::vector<double> cost(from.size());
    for (std::size_t s = 1; s < from.size(); ++s)
      for (int p = 0; p < problem_.parameter_count(); ++p) {
        const FittedParameter& parameter = problem_.parameters[p];
        const double reach = parameter.transform == Transform::log ? std::log(2.0) : 1.0;
        double& u = from[s].u[p];
        u = std::clamp(u + reach * (2.0 * stream.uniform(s, static_cast<std::uint64_t>(p)) - 1.0),
                       parameter.lowest_coordinate(), parameter.highest_coordinate());
      }
    std::vector<long> evaluations(from.size(), 0);
    std::atomic<bool> stop{false};
    const int side_by_side = std::min<int>(options_.jobs, static_cast<int>(from.size()));
    in_parallel(static_cast<int>(from.size()), side_by_side, [&](int s) {
      Globals at = from[s];
      double here = 0.0;
      for (const double share :
           grows(part) ? std::vector<double>{0.25, 0.5, 1.0} : std::vector<double>{1.0}) {
        if (stop) return;
        FitOptions o = fit_options("start " + std::to_string(s + 1) + " of " + std::to_string(from.size()),
                                   12, std::max(1, options_.jobs / side_by_side));
        o.cost_tolerance = 1e-4;
        const FitResult found = fit(up_to(part, share), at, {}, o);
        stop = stop || found.interrupted;
        evaluations[s] += found.evaluations;
        at = found.globals;
        here = found.cost;
      }
      to[s] = at;
      cost[s] = here;
    });
    if (stop) throw Interrupted{};
    for (std::size_t s = 0; s < from.size(); ++s) {
      result_.starts.push_back({problem_.values(from[s]), problem_.values(to[s]), cost[s]});
      result_.evaluations += evaluations[s];
    }
    return to[std::min_element(cost.begin(), cost.end()) - cost.begin()];
  }

  void grow(Globals at, double share) {
    if (grows(problem_))
      for (; share < 0.99; share *= 2.0) {
        FitOptions o = fit_options("horizon " + std::to_string(static_cast<int>(100.0 * share)) + " %", 10,
                                   options_.jobs);
        o.cost_tolerance = 1e-5;
        const FitResult found = fit(up_to(problem_, share), at, {}, o);
        result_.evaluations += found.evaluations;
        if (found.interrupted) throw Interrupted{};
        at = found.globals;
        if (share > 0.4) look_around(up_to(problem_, share), at);
      }
    note(fit(problem_, at, {}, fit_options("whole data", 30, options_.jobs)));
    settle("whole data");
  }

  // Impacts make small local minima all along a valley: whether a step of a few to some thirty percent of one
  // parameter alone leads to a lower place. Moves `at` there.
  bool look_around(const CalibrationProblem& problem, Globals& at) {
    std::vector<Globals> tried = {at};
    for (int p = 0; p < problem.parameter_count(); ++p)
      for (const double step : {-0.2, -0.03, 0.03, 0.2}) {
        if (result_.fixed[p]) continue;
        Globals moved = at;
        moved.u[p] = std::clamp(at.u[p] + step, problem.parameters[p].lowest_coordinate(),
                                problem.parameters[p].highest_coordinate());
        tried.push_back(moved);
      }
    std::vector<double> cost(tried.size(), 0.0);
    in_parallel(static_cast<int>(tried.size()), options_.jobs, [&](int k) {
      for (const Window& w : problem.windows)
        if (w.from_rest && !w.held_out)
          cost[k] += problem.cost(w, tried[k], VecX::Zero(problem.state_size(w)));
    });
    const auto best = std::min_element(cost.begin(), cost.end());
    if (!(*best < 0.999 * cost[0])) return false;
    at = tried[best - cost.begin()];
    return true;
  }

  // Away from the optimum by some standard errors of a parameter, along the line on which the others follow it,
  // the cost rises as the parabola of the information says, unless another valley is near: from the places
  // where it rises least the fit goes down once more. Ends where nothing lower is found.
  void settle(const std::string& stage) {
    if (!grows(problem_)) return;
    for (int round = 0; round < kMostSettlings; ++round) {
      const FitResult here = result_.fit;
      const Inference inference =
          infer(problem_, here, options_.confidence, result_.fixed, options_.jobs);
      struct Trial {
        Globals at;
        double foretold = 0.0, cost = 0.0;
        double share(double least) const { return (cost - least) / foretold; }
      };
      std::vector<Trial> trials;
      for (int p = 0; p < problem_.parameter_count(); ++p)
        for (const double step : {-24.0, -12.0, -6.0, -3.0, 3.0, 6.0, 12.0, 24.0}) {
          if (result_.fixed[p]) continue;
          Trial t{here.globals, step * step * inference.variance_factor};
          moved_along(inference.covariance.col(p) * step / std::sqrt(inference.covariance(p, p)), t.at);
          trials.push_back(t);
        }
      in_parallel(static_cast<int>(trials.size()), options_.jobs, [&](int k) {
        for (const Window& w : problem_.windows)
          if (!w.held_out) trials[k].cost += problem_.cost(w, trials[k].at, VecX::Zero(problem_.state_size(w)));
      });
      result_.evaluations += static_cast<long>(trials.size());
      std::sort(trials.begin(), trials.end(),
                [&](const Trial& a, const Trial& b) { return a.share(here.cost) < b.share(here.cost); });
      FitResult best = here;
      for (std::size_t k = 0; k < std::min<std::size_t>(kDescents, trials.size()); ++k) {
        if (!(trials[k].share(here.cost) < kSurprise)) break;
        FitResult found = fit(problem_, trials[k].at, {}, fit_options(stage + ", another valley", 15, options_.jobs));
        result_.evaluations += found.evaluations;
        if (found.interrupted) throw Interrupted{};
        if (found.cost < best.cost) best = std::move(found);
      }
      if (!(best.cost < here.cost - 0.1 * inference.variance_factor)) return;
      result_.fit = std::move(best);
    }
  }

  // Held parameters have no covariance, and stay.
  void moved_along(const VecX& step, Globals& at) const {
    int g = 0;
    for (int p = 0; p < problem_.parameter_count(); ++p, ++g)
      if (std::isfinite(step[g]))
        at.u[p] = std::clamp(at.u[p] + step[g], problem_.parameters[p].lowest_coordinate(),
                             problem_.parameters[p].highest_coordinate());
    if (problem_.fit_time_offset)
      at.time_offset = std::clamp(at.time_offset + step[g++], -problem_.largest_time_offset,
                                  problem_.largest_time_offset);
    if (problem_.fit_bias) at.bias += step.tail(at.bias.size());
  }

  void refit(const std::string& stage) {
    note(fit(problem_, result_.fit.globals, result_.fit.states, fit_options(stage, 15, options_.jobs)));
  }

  // Restitution is a matter of impacts alone: where none is seen in its joints, no fit can know it.
  void hold_what_no_impact_shows() {
    const Inference first = infer(problem_, result_.fit, options_.confidence, result_.fixed, options_.jobs);
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

  void noise_from_residuals() {
    std::vector<std::vector<double>> sizes(problem_.channels.size());
    int unknowns = problem_.global_count();
    for (std::size_t k = 0; k < result_.fit.windows.size(); ++k) {
      const Window& w = problem_.windows[result_.fit.windows[k]];
      WindowResiduals at;
      problem_.evaluate(w, result_.fit.globals, result_.fit.states[k], false, at);
      unknowns += w.from_rest ? 0 : problem_.state_size(w);
      for (Eigen::Index i = 0; i < at.r.size(); ++i) sizes[at.channel[i]].push_back(std::abs(at.r[i]));
    }
    std::size_t all = 0;
    for (const auto& s : sizes) all += s.size();
    VecX sigma = problem_.sigma;
    for (std::size_t c = 0; c < sizes.size(); ++c) {
      if (sizes[c].empty()) continue;
      std::nth_element(sizes[c].begin(), sizes[c].begin() + static_cast<std::ptrdiff_t>(sizes[c].size() / 2),
                       sizes[c].end());
      const double freedom = static_cast<double>(all) / std::max(1.0, static_cast<double>(all) - unknowns);
      // Never far below what differences say: a channel fitted too well is not a quiet one.
      sigma[static_cast<Eigen::Index>(c)] *=
          std::max(0.5, 1.4826 * sizes[c][sizes[c].size() / 2] * std::sqrt(freedom));
    }
    set_noise(sigma);
  }

  // Multibody less the fit's rung at the optimum: offset, from the second correction on slopes too, until it moves
  // nothing that matters. The slopes are taken where the first correction has led.
  void correct() {
    if (options_.corrections == 0 || !grows(problem_)) return;
    std::vector<std::vector<MatX>> slopes;
    bool settled = false;
    for (int step = 0;; ++step) {
      const Globals at = result_.fit.globals;
      tell("multibody at the optimum", 0.0, "correction " + std::to_string(step + 1));
      const ReadingDifference difference = multibody_differences(problem_, {at}, options_.jobs).front();
      const CorrectionSize size = size_of(problem_, at, difference);
      result_.confirmation = size.confirmation;
      if (step == options_.corrections || settled) return;
      const VecX error = infer(problem_, result_.fit, options_.confidence, result_.fixed, options_.jobs)
                             .covariance.diagonal()
                             .cwiseSqrt();
      if (step == 1) {
        VecX width = VecX::Zero(problem_.parameter_count());
        for (int p = 0; p < problem_.parameter_count(); ++p)
          if (!result_.fixed[p]) width[p] = std::min(error[p], kWidestSlope);
        slopes = multibody_slopes(problem_, at, width, options_.jobs);
      }
      problem_.corrections.clear();
      for (std::size_t r = 0; r < difference.size(); ++r)
        problem_.corrections.push_back(
            {at.u, difference[r], slopes.empty() ? std::vector<MatX>() : slopes[r]});
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
      noise_from_residuals();
    }
  }

  std::optional<HoldOut> held_out(const CalibrationProblem& problem, const Globals& globals) {
    std::vector<int> windows;
    for (std::size_t w = 0; w < problem.windows.size(); ++w)
      if (problem.windows[w].held_out) windows.push_back(static_cast<int>(w));
    if (windows.empty()) return {};
    HoldOut score;
    const std::vector<VecX> states = guess_states(problem, windows, globals, options_.jobs);
    double sum = 0.0;
    for (std::size_t k = 0; k < windows.size(); ++k) {
      WindowResiduals at;
      problem.evaluate(problem.windows[windows[k]], globals, states[k], false, at);
      for (Eigen::Index i = 0; i < at.r.size(); ++i) sum += std::pow(problem.loss.residual(at.r[i]), 2);
      score.values += at.r.size() - (problem.windows[windows[k]].from_rest ? 0 : states[k].size());
    }
    score.rms = std::sqrt(sum / static_cast<double>(std::max(1L, score.values)));
    return score;
  }

  void profile() {
    const boost::math::chi_squared one(1.0);
    const double rise = boost::math::quantile(one, options_.confidence);
    std::vector<int> wanted;
    for (int p = 0; p < problem_.parameter_count(); ++p)
      if (!result_.fixed[p]) wanted.push_back(p);
    result_.profiles.resize(wanted.size());
    tell("profile likelihood", 0.0, "");
    in_parallel(static_cast<int>(wanted.size()), options_.jobs, [&](int k) {
      Profile& profile = result_.profiles[k];
      profile.parameter = wanted[k];
      const double deviation = std::min(result_.inference.parameters[wanted[k]].coordinate_error, 1.0);
      std::vector<std::pair<double, double>> points = {{0.0, 0.0}};
      for (const double side : {-1.0, 1.0}) {
        Globals at = result_.fit.globals;
        std::vector<VecX> states = result_.fit.states;
        for (const double step : {1.0, 2.0, 3.0}) {
          const FittedParameter& parameter = problem_.parameters[wanted[k]];
          at.u[wanted[k]] = std::clamp(result_.fit.globals.u[wanted[k]] + side * step * deviation,
                                       parameter.lowest_coordinate(), parameter.highest_coordinate());
          FitOptions o;
          o.most_iterations = 6;
          o.fixed = result_.fixed;
          o.fixed[wanted[k]] = true;
          const FitResult found = fit(problem_, at, states, o);
          at = found.globals;
          states = found.states;
          const double risen =
              std::max(0.0, found.cost - result_.fit.cost) / result_.inference.variance_factor;
          points.emplace_back(at.u[wanted[k]] - result_.fit.globals.u[wanted[k]], risen);
        }
      }
      std::sort(points.begin(), points.end());
      const FittedParameter& parameter = problem_.parameters[wanted[k]];
      const double u0 = result_.fit.globals.u[wanted[k]];
      for (const auto& [u, risen] : points) {
        profile.value.push_back(parameter.value(u0 + u));
        profile.cost_rise.push_back(risen);
      }
      // The root of the rise is nearly straight: interpolate in it.
      const auto crossing = [&](int side) {
        for (std::size_t i = 0; i + 1 < points.size(); ++i) {
          const auto& [a, ra] = points[i];
          const auto& [b, rb] = points[i + 1];
          if (side < 0 ? b > 0.0 : a < 0.0) continue;
          if ((ra - rise) * (rb - rise) > 0.0) continue;
          const double sa = std::sqrt(ra), sb = std::sqrt(rb);
          return parameter.value(u0 + a + (b - a) * (std::sqrt(rise) - sa) / (sb - sa));
        }
        return std::numeric_limits<double>::quiet_NaN();
      };
      profile.low = crossing(-1);
      profile.high = crossing(1);
    });
  }

  void compare_laws() {
    if (options_.laws.empty()) return;
    for (const std::string& law : options_.laws) {
      tell("contact laws", 0.0, law);
      CalibrationProblem other = problem_;
      for (CalibrationRun& run : other.runs) {
        MechanismDescription description = run.mechanism->description();
        for (ClearanceDescription& c : description.clearances) c.contact_law = law;
        run.mechanism = std::make_shared<const Mechanism>(std::move(description));
      }
      const FitResult found =
          fit(other, result_.fit.globals, {}, fit_options("law " + law, 25, options_.jobs));
      result_.evaluations += found.evaluations;
      const double parameters = law == "hertz" ? other.global_count() - 1.0 : other.global_count();
      LawScore score{law, found.cost, found.cost + 2.0 * parameters, 0.0, {}, found.reason};
      if (const auto held = held_out(other, found.globals)) score.held_out = held->rms;
      result_.laws.push_back(score);
    }
    double best = std::numeric_limits<double>::infinity();
    for (const LawScore& s : result_.laws) best = std::min(best, s.aic);
    for (LawScore& s : result_.laws) s.difference = s.aic - best;
  }

  void next_tests() {
    const int G = problem_.global_count(), P = problem_.parameter_count();
    std::vector<int> free;
    for (int g = 0; g < G; ++g)
      if (g >= P || !result_.fixed[g]) free.push_back(g);
    const auto part = [&](const MatX& H) {
      MatX out(free.size(), free.size());
      for (std::size_t a = 0; a < free.size(); ++a)
        for (std::size_t b = 0; b < free.size(); ++b) out(a, b) = H(free[a], free[b]);
      return MatX(out + 1e-8 * MatX::Identity(out.rows(), out.cols()));
    };
    if (free.empty()) return;
    const MatX H = part(result_.inference.information);
    const MatX before = H.inverse();
    for (const Candidate& candidate : options_.candidates) {
      tell("candidates of a next test", 0.0, candidate.name);
      NextTest test{candidate.name, 0.0, 0.0, {}, ""};
      try {
        CalibrationProblem one = problem_;
        MeasuredData data;
        for (double t = 0.0; t <= candidate.mechanism->duration() * (1.0 + 1e-12); t += 1e-3) {
          data.time.push_back(std::min(t, candidate.mechanism->duration()));
          data.line.push_back(0);
        }
        data.channels = problem_.channels;
        data.value = MatX::Zero(static_cast<Eigen::Index>(data.time.size()),
                                static_cast<Eigen::Index>(data.channels.size()));
        one.runs = {CalibrationRun(candidate.name, candidate.mechanism, data)};
        one.corrections.clear();
        one.loss.kind = Loss::none;
        const double length = problem_.windows.front().end - problem_.windows.front().start;
        one.prepare(problem_.windows.front().from_rest ? std::max(length, data.time.back()) : length, true);
        MatX more = MatX::Zero(G, G);
        for (const Window& w : one.windows) {
          WindowResiduals at;
          one.evaluate(w, result_.fit.globals, VecX::Zero(one.state_size(w)), true, at);
          more += window_information(one, w, at).information;
        }
        const MatX with = part(result_.inference.information + more), after = with.inverse();
        test.d_gain = std::log(with.determinant()) - std::log(H.determinant());
        double sum_before = 0.0, sum_after = 0.0;
        for (std::size_t a = 0; a < free.size(); ++a) {
          if (free[a] >= P) continue;
          const auto i = static_cast<Eigen::Index>(a);
          const double relative =
              std::pow(problem_.parameters[free[a]].slope(result_.fit.globals.u[free[a]]) /
                           problem_.parameters[free[a]].value(result_.fit.globals.u[free[a]]),
                       2);
          sum_before += relative * before(i, i);
          sum_after += relative * after(i, i);
          test.error_ratio.push_back(std::sqrt(after(i, i) / before(i, i)));
        }
        test.a_ratio = sum_after / sum_before;
      } catch (const ComputationError& fault) {
        test.refusal = fault.what();
      }
      result_.next_tests.push_back(test);
    }
    std::stable_sort(result_.next_tests.begin(), result_.next_tests.end(),
                     [](const NextTest& a, const NextTest& b) { return a.d_gain > b.d_gain; });
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

void hold_out_windows(CalibrationProblem& problem, double share) {
  if (share <= 0.0) return;
  const int every = std::max(2, static_cast<int>(std::lround(1.0 / share)));
  for (std::size_t w = 0; w < problem.windows.size(); ++w)
    problem.windows[w].held_out = static_cast<int>(w) % every == every - 1;
}

std::string posterior_toml(const CalibrationProblem& problem, const CalibrationResult& result) {
  std::string out =
      "# What a calibration knows of the parameters, as random inputs of a study (boresight montecarlo). "
      "Gaussian in the\n"
      "# coordinates of the fit: logarithms, so lognormal; restitution: normal, truncated to where it can "
      "be.\n";
  char text[400];
  const int P = problem.parameter_count();
  const auto quantity = [](double value, const std::string& unit) {
    char number[64];
    if (unit == "1" || unit.empty())
      std::snprintf(number, sizeof number, "%.17g", value);
    else
      std::snprintf(number, sizeof number, "\"%.17g %s\"", value, unit.c_str());
    return std::string(number);
  };
  for (int p = 0; p < P; ++p) {
    const ParameterEstimate& e = result.inference.parameters[p];
    const FittedParameter& parameter = problem.parameters[p];
    std::string distribution;
    if (!e.identifiable) {
      out += "\n# Not identifiable (" + e.reason + "): all that is allowed for it.";
      distribution = "{ uniform = { min = " + quantity(parameter.lower, e.si_unit) +
                     ", max = " + quantity(parameter.upper, e.si_unit) + " } }";
    } else if (parameter.transform == Transform::log) {
      std::snprintf(text, sizeof text, "%.17g", std::exp(e.coordinate_error));
      distribution =
          "{ lognormal = { median = " + quantity(e.value, e.si_unit) + ", factor = " + text + " } }";
    } else {
      distribution = "{ normal = { mean = " + quantity(e.value, e.si_unit) +
                     ", sd = " + quantity(e.standard_error, e.si_unit) + " }, truncate = [" +
                     quantity(parameter.lower, e.si_unit) + ", " + quantity(parameter.upper, e.si_unit) +
                     "] }";
    }
    out += "\n[[random]]\nparameter = \"" + e.name + "\"\ndistribution = " + distribution + "\n";
  }
  for (int a = 0; a < P; ++a)
    for (int b = a + 1; b < P; ++b) {
      const double rho = result.inference.correlation(a, b);
      const auto& first = result.inference.parameters[a];
      const auto& second = result.inference.parameters[b];
      if (!first.identifiable || !second.identifiable || !std::isfinite(rho)) continue;
      std::snprintf(
          text, sizeof text,
          "\n[[correlation]]\nparameters = [\"%s\", \"%s\"]\ncoefficient = %.6f\nmeasure = \"normal\"\n",
          first.name.c_str(), second.name.c_str(), std::clamp(rho, -0.999, 0.999));
      out += text;
    }
  return out;
}

}  // namespace boresight
