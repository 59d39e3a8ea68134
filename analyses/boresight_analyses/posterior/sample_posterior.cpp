#include "boresight_analyses/posterior/sample_posterior.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "boresight_analyses/posterior/temperature_ladder.hpp"
#include "boresight_analyses/threads/on_threads.hpp"

namespace boresight {
namespace {

constexpr double kWantedAcceptance = 0.8;  // Hoffman and Gelman 2014, section 3.2
constexpr int kFirstRound = 20;
constexpr int kStretch = 50;  // iterations that an interruption may lose

MatX factor_of(const MatX& covariance, const char* whose) {
  const Eigen::LLT<MatX> llt(covariance);
  if (llt.info() != Eigen::Success || !covariance.allFinite())
    throw std::domain_error(std::string("the covariance of ") + whose + " is not positive definite");
  return llt.matrixL();
}

// The number of the last iteration of each round of the warm-up: rounds double in length, the last tenth finds the steps alone.
std::vector<int> rounds_of(int warm_up) {
  std::vector<int> ends;
  const int adapting = warm_up - warm_up / 10;
  for (int length = kFirstRound, at = 0; at < adapting; length *= 2) {
    // A rest shorter than the round after it joins this one.
    at = adapting - at < 3 * length ? adapting : at + length;
    ends.push_back(at);
  }
  ends.push_back(warm_up);
  return ends;
}

}  // namespace

PosteriorSampler::PosteriorSampler(SampledDensity target, NormalReference reference)
    : mean_(std::move(reference.mean)), factor_(factor_of(reference.covariance, "the reference")) {
  const auto in_its_coordinates = [this](LogDensity density) -> LogDensity {
    return [density = std::move(density), this](const VecX& z, VecX& slope) {
      const double value = density(mean_ + factor_ * z, slope);
      if (slope.size() > 0 && std::isfinite(value)) slope = (factor_.transpose() * slope).eval();
      return std::isnan(value) ? -std::numeric_limits<double>::infinity() : value;
    };
  };
  target_.exact = in_its_coordinates(std::move(target.exact));
  if (target.guide) target_.guide = in_its_coordinates(std::move(target.guide));
}

ChainPlace PosteriorSampler::drawn_from_reference(const StepNumbers& numbers, std::uint64_t first_number) const {
  ChainPlace place;
  place.z.resize(mean_.size());
  for (Eigen::Index i = 0; i < mean_.size(); ++i)
    place.z[i] = numbers.normal(first_number + static_cast<std::uint64_t>(i));
  long unused = 0;  // whoever draws counts it
  see(target_, place, unused);
  return place;
}

// One run under way.
struct PosteriorSampler::Run {
  const PosteriorSampler& own;
  const SamplerOptions& options;
  const CounterStream stream;
  const std::vector<int> rounds;
  SamplerState state;

  Run(const PosteriorSampler& sampler, const SamplerOptions& asked)
      : own(sampler), options(asked), stream(asked.seed, StreamPurpose::posterior), rounds(rounds_of(asked.warm_up)) {}

  int ladders() const { return options.chains; }
  int temperatures() const { return options.temperatures; }
  Eigen::Index dimensions() const { return own.mean_.size(); }
  ChainPlace& place(int ladder, int k) { return state.place[static_cast<std::size_t>(ladder * temperatures() + k)]; }
  StepNumbers numbers(int iteration, int chain) const {
    return {stream, static_cast<std::uint64_t>(iteration), static_cast<std::uint64_t>(chain)};
  }

  // The step that suits a normal density whose covariance the shape has: Neal (2011), section 5.4.4.
  double usual_step() const { return std::pow(static_cast<double>(dimensions()), -0.25); }

  void begin() {
    const auto K = static_cast<std::size_t>(temperatures());
    const Eigen::Index d = dimensions();
    MatX precision = MatX::Identity(d, d);
    if (options.covariance.size() > 0) {
      const MatX inverse_factor = own.factor_.triangularView<Eigen::Lower>().solve(MatX::Identity(d, d));
      const MatX covariance = inverse_factor * options.covariance * inverse_factor.transpose();
      precision = Eigen::LLT<MatX>(covariance).solve(MatX::Identity(d, d));
    }
    const double narrow = 1.0 / std::sqrt(std::max(1.0, precision.diagonal().maxCoeff()));
    state.beta = first_ladder(temperatures(), options.covariance.size() > 0 ? narrow : 0.1);
    for (const double beta : state.beta) {
      const MatX here = (1.0 - beta) * MatX::Identity(d, d) + beta * precision;
      state.shape.push_back(
          {0.5 * usual_step(), factor_of(Eigen::LLT<MatX>(here).solve(MatX::Identity(d, d)), "the first guess")});
    }
    state.from_reference.assign(static_cast<std::size_t>(ladders()) * K, 0);
    state.place.resize(static_cast<std::size_t>(ladders()) * K);
    begin_round();
    for_each_on_threads(state.place.size(), options.jobs, [&](std::size_t c) {
      constexpr std::uint64_t kMostTries = 1000;
      const StepNumbers here = numbers(0, static_cast<int>(c));
      for (std::uint64_t k = 0; k < kMostTries; ++k) {
        state.place[c] = own.drawn_from_reference(here, k * static_cast<std::uint64_t>(dimensions()));
        if (std::isfinite(state.place[c].log_target)) return;
      }
      throw std::runtime_error("no place of the reference has any density");
    });
  }

  void begin_round() {
    const auto K = static_cast<std::size_t>(temperatures());
    state.in_round = 0;
    state.log_step_sum.assign(K, 0.0);
    state.acceptance.assign(K, 0.0);
    state.rejection.assign(K - 1, 0.0);
    state.sum.assign(K, VecX::Zero(dimensions()));
    state.square.assign(K, MatX::Zero(dimensions(), dimensions()));
  }

  int length_of_round() const {
    int before = 0;
    for (const int end : rounds) {
      if (state.iteration < end) return end - before;
      before = end;
    }
    return 0;
  }

  void iterate() {
    const int K = temperatures(), chains = ladders() * K;
    const bool warming = state.iteration < options.warm_up;
    std::vector<double> accepted(static_cast<std::size_t>(chains), 1.0);
    std::vector<long> evaluations(static_cast<std::size_t>(chains), 0);
    // Number 0 was the beginning's.
    const int numbered = state.iteration + 1;
    for_each_on_threads(static_cast<std::size_t>(chains), options.jobs, [&](std::size_t c) {
      const int k = static_cast<int>(c) % K;
      const StepNumbers here = numbers(numbered, static_cast<int>(c));
      if (k == 0) {
        state.place[c] = own.drawn_from_reference(here, 0);
        evaluations[c] = 1;
        return;
      }
      accepted[c] = hamiltonian_step(own.target_, state.beta[static_cast<std::size_t>(k)],
                                     state.shape[static_cast<std::size_t>(k)], here, state.place[c], evaluations[c]);
    });
    for (const long more : evaluations) state.evaluations += more;
    ++state.in_round;
    for (int k = 0; k < K; ++k) {
      const auto t = static_cast<std::size_t>(k);
      double mean = 0.0;
      for (int ladder = 0; ladder < ladders(); ++ladder) {
        mean += accepted[static_cast<std::size_t>(ladder * K + k)] / ladders();
        state.sum[t] += place(ladder, k).z;
        state.square[t] += place(ladder, k).z * place(ladder, k).z.transpose();
      }
      state.acceptance[t] += mean;
      if (!warming || k == 0) continue;
      const double gain = 2.0 / std::pow(state.in_round + 4.0, 0.7);
      double& step = state.shape[t].step;
      step = std::clamp(step * std::exp(gain * (mean - kWantedAcceptance)), 1e-6, 2.0);
      if (2 * state.in_round > length_of_round()) state.log_step_sum[t] += std::log(step);
    }
    swap(numbered);
    ++state.iteration;
    if (warming && std::find(rounds.begin(), rounds.end(), state.iteration) != rounds.end()) end_round();
  }

  void swap(int numbered) {
    const int K = temperatures();
    for (int k = 0; k + 1 < K; ++k) {
      const auto t = static_cast<std::size_t>(k);
      for (int ladder = 0; ladder < ladders(); ++ladder) {
        const double probability = swap_probability(state.beta[t], state.beta[t + 1], place(ladder, k).log_ratio(),
                                                    place(ladder, k + 1).log_ratio());
        // Of pairs that have no turn the rate counts as well.
        state.rejection[t] += (1.0 - probability) / ladders();
        if ((k + numbered) % 2 != 0) continue;
        // After those of the chains' own steps.
        const StepNumbers here = numbers(numbered, ladders() * K + ladder * K + k);
        if (!(here.uniform(0) < probability)) continue;
        std::swap(place(ladder, k), place(ladder, k + 1));
        const auto c = static_cast<std::size_t>(ladder * K + k);
        std::swap(state.from_reference[c], state.from_reference[c + 1]);
      }
    }
    for (int ladder = 0; ladder < ladders(); ++ladder) {
      state.from_reference[static_cast<std::size_t>(ladder * K)] = 1;
      int& at_target = state.from_reference[static_cast<std::size_t>(ladder * K + K - 1)];
      if (at_target != 0 && numbered > options.warm_up) ++state.restarts;
      at_target = 0;
    }
  }

  MatX covariance_of_round(std::size_t k) const {
    const double n = static_cast<double>(state.in_round) * ladders();
    const VecX mean = state.sum[k] / n;
    MatX covariance = state.square[k] / n - mean * mean.transpose();
    // Few draws leave directions out: a little towards what they say of each coordinate alone (as Stan's manual, section 15.2, has it).
    const double weight = n / (n + 5.0);
    const VecX own_variance = covariance.diagonal().cwiseMax(1e-12);
    covariance *= weight;
    covariance.diagonal() = own_variance;
    return covariance;
  }

  void end_round() {
    const auto K = static_cast<std::size_t>(temperatures());
    const int steps_counted = state.in_round - state.in_round / 2;
    for (std::size_t k = 1; k < K; ++k) state.shape[k].step = std::exp(state.log_step_sum[k] / steps_counted);
    if (state.iteration < options.warm_up) {
      std::vector<double> rate = state.rejection;
      for (double& r : rate) r /= state.in_round;
      const std::vector<double> evened = evened_ladder(state.beta, rate);
      std::vector<MatX> covariance(K);
      for (std::size_t k = 0; k < K; ++k) covariance[k] = covariance_of_round(k);
      for (std::size_t k = 1; k < K; ++k) {
        // Where the new exponent lies among the old ones.
        const auto above = static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(
            std::lower_bound(state.beta.begin(), state.beta.end(), evened[k]) - state.beta.begin(), 1,
            static_cast<std::ptrdiff_t>(K) - 1));
        const double share = (evened[k] - state.beta[above - 1]) / (state.beta[above] - state.beta[above - 1]);
        state.shape[k] = {usual_step(), factor_of((1.0 - share) * covariance[above - 1] + share * covariance[above],
                                                  "a temperature's draws")};
      }
      state.beta = evened;
    }
    begin_round();
  }

  PosteriorSamples result(const std::vector<std::vector<VecX>>& draws, bool interrupted) const {
    PosteriorSamples found;
    for (const std::vector<VecX>& of_ladder : draws) {
      MatX table(static_cast<Eigen::Index>(of_ladder.size()), dimensions());
      for (std::size_t i = 0; i < of_ladder.size(); ++i)
        table.row(static_cast<Eigen::Index>(i)) = (own.mean_ + own.factor_ * of_ladder[i]).transpose();
      found.draws.push_back(std::move(table));
    }
    const double iterations = std::max(1, state.in_round);
    found.beta = state.beta;
    for (const double a : state.acceptance) found.acceptance.push_back(a / iterations);
    for (const double r : state.rejection) found.swap_rejection.push_back(r / iterations);
    for (const HamiltonianShape& s : state.shape) found.step.push_back(s.step);
    found.barrier = communication_barrier(found.swap_rejection);
    found.restarts = state.restarts;
    found.evaluations = state.evaluations;
    found.interrupted = interrupted;
    return found;
  }
};

PosteriorSamples PosteriorSampler::run(const SamplerOptions& options, const KeptStretches& kept) const {
  Run run(*this, options);
  run.begin();
  std::vector<std::vector<VecX>> draws(static_cast<std::size_t>(options.chains));
  const int last = options.warm_up + options.draws * options.thin;
  while (run.state.iteration < last) {
    const int first = run.state.iteration;
    if (options.progress &&
        !options.progress(static_cast<double>(first) / last, first < options.warm_up ? "warm-up" : "draws"))
      return run.result(draws, true);
    SamplerStretch stretch;
    if (std::optional<SamplerStretch> found = kept.find ? kept.find(first) : std::nullopt) {
      stretch = std::move(*found);
      run.state = stretch.state;
    } else {
      stretch.draws.resize(draws.size());
      while (run.state.iteration < std::min(last, first + kStretch)) {
        run.iterate();
        if (run.state.iteration <= options.warm_up || (run.state.iteration - options.warm_up) % options.thin != 0)
          continue;
        for (int ladder = 0; ladder < options.chains; ++ladder)
          stretch.draws[static_cast<std::size_t>(ladder)].push_back(run.place(ladder, options.temperatures - 1).z);
      }
      stretch.state = run.state;
      if (kept.keep) kept.keep(first, stretch);
    }
    for (std::size_t ladder = 0; ladder < draws.size(); ++ladder)
      draws[ladder].insert(draws[ladder].end(), stretch.draws[ladder].begin(), stretch.draws[ladder].end());
  }
  return run.result(draws, false);
}

}  // namespace boresight
