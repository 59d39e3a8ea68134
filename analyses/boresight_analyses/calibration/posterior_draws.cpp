#include "boresight_analyses/calibration/posterior_draws.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <stdexcept>

#include "boresight/mechanism/error.hpp"
#include "boresight_analyses/calibration/posterior.hpp"
#include "boresight_analyses/posterior/chain_diagnostics.hpp"
#include "boresight_analyses/posterior/sample_posterior.hpp"
#include "boresight_analyses/runs/sample_record.hpp"
#include "boresight_analyses/threads/on_threads.hpp"

namespace boresight {

static void fields(Numbers& n, ChainPlace& p) { n(p.z, p.log_target, p.slope); }
static void fields(Numbers& n, HamiltonianShape& s) { n(s.step, s.factor); }
static void fields(Numbers& n, SamplerState& s) {
  n(s.iteration, s.beta, s.shape, s.place, s.log_step_sum, s.in_round, s.acceptance, s.rejection, s.sum, s.square,
    s.from_reference, s.restarts, s.evaluations);
}
static void fields(Numbers& n, SamplerStretch& s) { n(s.state, s.draws); }

namespace {

constexpr std::uint64_t kNoChain = ~std::uint64_t{0};  // its random numbers are no chain's
constexpr double kSettledRHat = 1.01, kSettledSize = 400.0;

// As wide as the density itself, and wider; between bounds no wider than what is uniform there.
MatX reference_covariance(const PosteriorDensity& density, const MatX& spread, double reach) {
  MatX C = reach * reach * density.covariance() + spread;
  VecX scale = VecX::Ones(density.size());
  for (int k = 0; k < density.size(); ++k)
    if (const double range = density.upper(k) - density.lower(k); std::isfinite(range))
      scale[k] = std::min(1.0, range / std::sqrt(12.0 * C(k, k)));
  return scale.asDiagonal() * C * scale.asDiagonal();
}

double quantile_of(std::vector<double>& values, double p) {
  const auto k = static_cast<std::ptrdiff_t>(p * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + k, values.end());
  return values[static_cast<std::size_t>(k)];
}

DrawnQuantity judged(const CalibrationProblem& problem, int g, const MatX& values, Eigen::Index column, int chains,
                     double confidence) {
  DrawnQuantity q;
  q.name = problem.global_names()[static_cast<std::size_t>(g)];
  q.si_unit = problem.global_unit(g);
  if (g < problem.parameter_count()) q.written_unit = problem.parameters[static_cast<std::size_t>(g)].written_unit;
  const Eigen::Index each = values.rows() / chains;
  std::vector<std::vector<double>> by_chain;
  std::vector<double> all(values.col(column).begin(), values.col(column).end());
  for (int c = 0; c < chains; ++c) by_chain.emplace_back(all.begin() + c * each, all.begin() + (c + 1) * each);
  q.mean = values.col(column).mean();
  q.deviation =
      std::sqrt((values.col(column).array() - q.mean).square().sum() / static_cast<double>(values.rows() - 1));
  q.low = quantile_of(all, 0.5 - 0.5 * confidence);
  q.median = quantile_of(all, 0.5);
  q.high = quantile_of(all, 0.5 + 0.5 * confidence);
  const ChainDiagnostics of = chain_diagnostics(by_chain);
  q.r_hat = of.r_hat;
  q.bulk_ess = of.bulk_ess;
  q.tail_ess = of.tail_ess;
  return q;
}

// What suspects have moved is taken off again.
void without_suspects(const PosteriorDensity& density, const CounterStream& stream, int jobs, MatX& values) {
  const MatX sampled = values;
  for_each_on_threads(static_cast<std::size_t>(values.rows()), jobs, [&](std::size_t i) {
    const StepNumbers numbers(stream, i, kNoChain);
    values.row(static_cast<Eigen::Index>(i)) =
        density
            .drawn(sampled.row(static_cast<Eigen::Index>(i)).transpose(), numbers.uniform(0),
                   [&](int k) { return numbers.normal(static_cast<std::uint64_t>(k) + 1); })
            .transpose();
  });
}

std::string judgement(const PosteriorDraws& found) {
  double r_hat = 0.0, size = static_cast<double>(found.values.rows());
  for (const DrawnQuantity& q : found.quantities) {
    r_hat = std::isnan(q.r_hat) ? q.r_hat : std::max(r_hat, q.r_hat);
    size = std::min({size, q.bulk_ess, q.tail_ess});
  }
  char text[400];
  if (found.settled)
    std::snprintf(
        text, sizeof text,
        "%ld draws of the posterior: the chains agree (R-hat at most %.3f), and the draws are worth at least %.0f "
        "independent ones.",
        static_cast<long>(found.values.rows()), r_hat, size);
  else
    std::snprintf(
        text, sizeof text,
        "%ld draws of the posterior are not enough: R-hat is up to %.3f (1.01 is asked for), and they are worth "
        "as few as %.0f independent ones (400 are asked for). [calibrate.posterior] draws, thin or "
        "temperatures: more of them.",
        static_cast<long>(found.values.rows()), r_hat, size);
  return text;
}

}  // namespace

std::optional<PosteriorDraws> posterior_draws(
    const CalibrationProblem& problem, const PosteriorDensity& density, const MatX& spread, double confidence,
    const DrawOptions& options, std::uint64_t seed, int jobs,
    const std::function<bool(double share, const std::string& estimate)>& progress) {
  const NormalReference reference{density.mean(), reference_covariance(density, spread, options.reach)};
  const MatX known = reference_covariance(density, MatX::Zero(density.size(), density.size()), 1.0);
  // Slopes of a motion take longer than the motion: the fit's parabola leads the trajectories.
  const MatX information = known.ldlt().solve(MatX::Identity(known.rows(), known.cols()));
  const PosteriorSampler sampler(
      SampledDensity{[&](const VecX& y, VecX& gradient) { return density.log_density(y, gradient); },
                     [&](const VecX& y, VecX& gradient) {
                       gradient = -(information * (y - reference.mean));
                       return 0.5 * gradient.dot(y - reference.mean);
                     }},
      reference);
  SamplerOptions sampling;
  sampling.chains = options.chains;
  sampling.temperatures = options.temperatures;
  sampling.warm_up = options.warm_up;
  sampling.draws = (options.draws + options.chains - 1) / options.chains;
  sampling.thin = options.thin;
  sampling.seed = seed;
  sampling.jobs = jobs;
  sampling.covariance = known;
  sampling.progress = [&](double share, const std::string& stage) { return !progress || progress(share, stage); };
  KeptStretches kept;
  if (problem.kept != nullptr) {
    const auto key = [&](int first) {
      return CalibrationKey("draws", problem)
          .add(first, reference.mean, reference.covariance, sampling.covariance, options.draws, options.chains,
               options.temperatures, options.warm_up, options.thin, static_cast<double>(seed))
          .value();
    };
    kept.find = [key, of = problem.kept](int first) { return kept_result<SamplerStretch>(of, key(first)); };
    kept.keep = [key, in = problem.kept](int first, const SamplerStretch& stretch) {
      in->keep(key(first), Numbers::of(stretch));
    };
  }
  PosteriorSamples sampled;
  try {
    sampled = sampler.run(sampling, kept);
  } catch (const StoreFailed&) {  // a full disk is no fault of the density's
    throw;
  } catch (const std::runtime_error& none) {
    throw ComputationError(std::string("draws of the posterior: ") + none.what());
  }
  if (sampled.interrupted) return {};
  PosteriorDraws found;
  const Eigen::Index each = sampled.draws.front().rows();
  found.values.resize(each * options.chains, density.size());
  for (int c = 0; c < options.chains; ++c)
    found.values.middleRows(c * each, each) = sampled.draws[static_cast<std::size_t>(c)];
  without_suspects(density, CounterStream(seed, StreamPurpose::posterior), jobs, found.values);
  for (int k = 0; k < density.size(); ++k) {
    const int g = density.sampled()[static_cast<std::size_t>(k)];
    if (g < problem.parameter_count())
      for (Eigen::Index i = 0; i < found.values.rows(); ++i)
        found.values(i, k) = problem.parameters[static_cast<std::size_t>(g)].value(found.values(i, k));
    found.quantities.push_back(judged(problem, g, found.values, k, options.chains, confidence));
  }
  found.beta = sampled.beta;
  found.acceptance = sampled.acceptance;
  found.swap_rejection = sampled.swap_rejection;
  found.barrier = sampled.barrier;
  found.restarts = sampled.restarts;
  found.evaluations = sampled.evaluations;
  found.settled = std::all_of(found.quantities.begin(), found.quantities.end(), [](const DrawnQuantity& q) {
    return q.r_hat < kSettledRHat && std::min(q.bulk_ess, q.tail_ess) > kSettledSize;
  });
  found.says = judgement(found);
  return found;
}

std::string csv_of(const PosteriorDraws& draws) {
  std::string out;
  for (std::size_t k = 0; k < draws.quantities.size(); ++k) out += (k > 0 ? "," : "") + draws.quantities[k].name;
  out += "\n";
  char number[40];
  for (Eigen::Index i = 0; i < draws.values.rows(); ++i) {
    for (Eigen::Index k = 0; k < draws.values.cols(); ++k) {
      std::snprintf(number, sizeof number, "%.17g", draws.values(i, k));
      out += (k > 0 ? "," : "") + std::string(number);
    }
    out += "\n";
  }
  return out;
}

std::string posterior_toml(const PosteriorDraws& draws, const CalibrationProblem& problem, const std::string& file) {
  std::string names;
  for (const DrawnQuantity& q : draws.quantities) {
    const bool of_mechanism = std::any_of(problem.parameters.begin(), problem.parameters.end(),
                                          [&](const FittedParameter& p) { return p.path == q.name; });
    if (of_mechanism) names += (names.empty() ? "\"" : ", \"") + q.name + "\"";
  }
  std::string text =
      "# What a calibration knows of the parameters, as random inputs of a study (boresight montecarlo): draws of "
      "their posterior, a row "
      "each.\n"
      "# " +
      draws.says + "\n\n[[random]]\nparameters = [" + names + "]\ndistribution = { rows = { file = \"" + file +
      "\" } }\n";
  // Those that were held have no draws, and are no better known for that.
  for (const FittedParameter& p : problem.parameters) {
    const bool drawn = std::any_of(draws.quantities.begin(), draws.quantities.end(),
                                   [&](const DrawnQuantity& q) { return q.name == p.path; });
    if (drawn) continue;
    if (p.is_error()) {
      text += "\n# " + p.path + " was held: it stays what the mechanism file says.\n";
      continue;
    }
    text += "\n# Held, as the data do not show it: all that is allowed for it.\n[[random]]\nparameter = \"" + p.path +
            "\"\ndistribution = " + all_allowed(p) + "\n";
  }
  return text;
}

}  // namespace boresight
