#include "boresight_analyses/calibration/inference.hpp"

#include <algorithm>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <cstdio>

#include "boresight/keys/units.hpp"
#include "boresight/math/eigenvalues.hpp"
#include "boresight/pointing/relative_text.hpp"
#include "boresight_analyses/calibration/channel_noise.hpp"
#include "boresight_analyses/calibration/channel_variances.hpp"
#include "boresight_analyses/statistics/effective_samples.hpp"

namespace boresight {
namespace {

std::vector<double> autocorrelations_of(const std::vector<ResidualSeries>& series, int lags) {
  std::vector<double> sum(lags + 1, 0.0);
  for (const ResidualSeries& s : series)
    for (int l = 0; l <= lags; ++l)
      for (std::size_t i = 0; i + l < s.residual.size(); ++i) {
        // Outliers would drown the rest.
        const auto clipped = [&](std::size_t k) { return std::clamp(s.residual[k], -3.0, 3.0); };
        sum[l] += clipped(i) * clipped(i + l);
      }
  for (int l = lags; l >= 0; --l) sum[l] /= sum[0] > 0.0 ? sum[0] : 1.0;
  return sum;
}

// Eliminates what was held. of_unseen: what a direction has whose information is less than `least`.
MatX inverse_of(const MatX& H, const std::vector<int>& free, double least, double of_unseen) {
  MatX out = MatX::Constant(H.rows(), H.cols(), std::numeric_limits<double>::quiet_NaN());
  if (free.empty()) return out;
  MatX part(free.size(), free.size());
  for (std::size_t a = 0; a < free.size(); ++a)
    for (std::size_t b = 0; b < free.size(); ++b) part(a, b) = H(free[a], free[b]);
  // Parameters and biases are of different units, and so are their informations: 1 beside 1e18. Scaled, each loses its own digits alone.
  VecX unit = VecX::Ones(part.rows());
  for (Eigen::Index a = 0; a < unit.size(); ++a)
    if (part(a, a) > 1e-8) unit[a] = 1.0 / std::sqrt(part(a, a));
  Eigen::SelfAdjointEigenSolver<MatX> eigen(MatX(unit.asDiagonal() * part * unit.asDiagonal()));
  VecX values = eigen.eigenvalues();
  for (double& v : values) v = v > least ? 1.0 / v : of_unseen;
  const MatX inverse = unit.asDiagonal() * eigen.eigenvectors() * values.asDiagonal() *
                       eigen.eigenvectors().transpose() * unit.asDiagonal();
  for (std::size_t a = 0; a < free.size(); ++a)
    for (std::size_t b = 0; b < free.size(); ++b) out(free[a], free[b]) = inverse(a, b);
  return out;
}

std::string number(const char* format, double value) {
  char text[64];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

}  // namespace

// The standard error in the unit that the user wrote, else in millionths of a metre or radian.
static std::string size_in_its_unit(const ParameterEstimate& e) {
  if (!e.written_unit.empty())
    return number("%.2g", e.standard_error / scale_of_unit(e.written_unit, unit_called(e.si_unit, true))) + " " +
           e.written_unit;
  const bool small = e.si_unit == "m" || e.si_unit == "rad";
  return number("%.2g", small ? 1e6 * e.standard_error : e.standard_error) + (small ? " u" : " ") + e.si_unit;
}

// Why the data know an error, or not: its standard error beside what it may well be.
static void assess_error(const FittedParameter& parameter, ParameterEstimate& e) {
  const double share = e.standard_error / parameter.size;
  e.identifiable = share < kUnknown && !parameter.at_bound(parameter.coordinate(e.value));
  if (parameter.at_bound(parameter.coordinate(e.value)))
    e.reason = "the fit ran into the bound of what is allowed for it";
  else if (parameter.has_prior)
    e.reason = "its standard error is " + (share < kSaidAsMultiple ? relative_text(share) + " of what was known before"
                                                                   : relative_text(share, 2, "what was known before"));
  else
    e.reason = (e.identifiable ? "known to " : "its standard error is ") + size_in_its_unit(e);
}

void assess_identifiability(const FittedParameter& parameter, ParameterEstimate& e) {
  if (parameter.is_error()) return assess_error(parameter, e);
  // What is left of a prior's error where the data say next to nothing.
  constexpr double kAsBefore = 0.9;
  const double share = e.standard_error / e.value;
  e.identifiable = false;
  e.by_prior = parameter.has_prior && e.standard_error > kAsBefore * parameter.prior;
  if (parameter.at_bound(parameter.coordinate(e.value))) {
    e.reason = "the fit ran into the bound of what is allowed for it: the data ask for less or more, or for nothing";
  } else if (!(share < kUnknown)) {
    e.reason =
        "its standard error is " + (share < kSaidAsMultiple ? relative_text(share) + " of it" : relative_text(share));
  } else {
    e.identifiable = true;
    e.reason = e.by_prior
                   ? "not told by the data: known to " + number("%.2g %%", 100.0 * share) + ", as was assumed before"
                   : "known to " + number("%.2g %%", 100.0 * share);
  }
}

WindowInformation window_information(const CalibrationProblem& problem, const Window& w, const WindowResiduals& at) {
  const Eigen::Index N = at.r.size(), G = at.by_global.cols();
  VecX weight(N), score(N);
  for (Eigen::Index i = 0; i < N; ++i) {
    weight[i] = problem.loss.weight(at.r[i]);
    score[i] = problem.loss.score(at.r[i]);
  }
  MatX A = at.by_global;
  if (!w.from_rest) {
    MatX Hss = problem.prior_deviation(w).cwiseAbs2().cwiseInverse().asDiagonal();
    Hss += at.by_state.transpose() * weight.asDiagonal() * at.by_state;
    A -= at.by_state * Hss.ldlt().solve(at.by_state.transpose() * weight.asDiagonal() * at.by_global);
  }
  WindowInformation out;
  out.information = A.transpose() * weight.asDiagonal() * at.by_global;
  out.information = 0.5 * (out.information + out.information.transpose()).eval();
  out.scores = MatX::Zero(w.last - w.first + 1, G);
  for (Eigen::Index i = 0; i < N; ++i) out.scores.row(at.sample[i] - w.first) += score[i] * A.row(i);
  out.rows = std::move(A);
  return out;
}

namespace {

// Sum over a window's values a_i a_j^T rho^|i - j|, values of one channel: what noise does that follows itself as a first-order process does.
MatX products_of_followers(const MatX& rows, const std::vector<int>& channel, double rho) {
  MatX sum = MatX::Zero(rows.cols(), rows.cols());
  VecX later = VecX::Zero(rows.cols());
  for (Eigen::Index i = rows.rows() - 1; i >= 0; --i) {
    const auto next = static_cast<std::size_t>(i + 1);
    if (next < channel.size() && channel[next] == channel[next - 1])
      later = rho * (rows.row(i + 1).transpose() + later);
    else
      later.setZero();
    const VecX a = rows.row(i);
    sum += a * a.transpose() + a * later.transpose() + later * a.transpose();
  }
  return sum;
}

// What of the data is of each noise: those that are estimated, then the one of all that are told. None: they have one variance factor.
std::vector<SharedNoise> noises_of(const CalibrationProblem& problem) {
  int estimated = 0;
  for (const int noise : problem.noise_of) estimated = std::max(estimated, noise + 1);
  if (estimated == 0) return {};
  const int G = problem.global_count();
  const bool any_told = std::any_of(problem.noise_of.begin(), problem.noise_of.end(), [](int n) { return n < 0; });
  std::vector<SharedNoise> noises(static_cast<std::size_t>(estimated + any_told));
  for (SharedNoise& one : noises) one.information = MatX::Zero(G, G);
  if (any_told) noises.back().estimated = false;
  return noises;
}

// The i-th value of a window.
void add_value(std::vector<SharedNoise>& noises, const CalibrationProblem& problem, const WindowResiduals& at,
               const WindowInformation& part, Eigen::Index i) {
  const int noise = problem.noise_of[static_cast<std::size_t>(at.channel[static_cast<std::size_t>(i)])];
  SharedNoise& its = noise < 0 ? noises.back() : noises[static_cast<std::size_t>(noise)];
  const double psi = problem.loss.score(at.r[i]), slope = problem.loss.weight(at.r[i]);
  its.values += 1.0;
  its.psi_square += psi * psi;
  its.psi_slope += slope;
  its.information.noalias() += slope * part.rows.row(i).transpose() * at.by_global.row(i);
}

}  // namespace

Inference infer(const CalibrationProblem& problem, const FitResult& fit, double confidence,
                const std::vector<bool>& fixed, int jobs) {
  const int G = problem.global_count(), P = problem.parameter_count(), count = static_cast<int>(fit.windows.size());
  Inference out;
  std::vector<WindowInformation> parts(count);
  std::vector<WindowResiduals> residuals(count);
  for_each_on_threads(count, jobs, [&](int k) {
    const Window& w = problem.windows[fit.windows[k]];
    problem.evaluate(w, fit.globals, fit.states[k], true, residuals[k]);
    parts[k] = window_information(problem, w, residuals[k]);
  });
  out.information = MatX::Zero(G, G);
  MatX white = out.information;
  out.impacts.assign(problem.runs.front().mechanism->clearances(), 0);
  double psi_square = 0.0, psi_slope = 0.0;
  std::vector<SharedNoise> noises = noises_of(problem);
  for (int k = 0; k < count; ++k) {
    const Window& w = problem.windows[fit.windows[k]];
    out.information += parts[k].information;
    white += parts[k].scores.transpose() * parts[k].scores;
    out.unknowns += w.from_rest ? 0 : problem.state_size(w);
    out.values += residuals[k].r.size();
    for (int joint : residuals[k].motion.impact_joint) ++out.impacts[joint];
    out.grazing += static_cast<int>(residuals[k].motion.grazing.size());
    for (Eigen::Index i = 0; i < residuals[k].r.size(); ++i) {
      const double r = residuals[k].r[i];
      psi_square += problem.loss.score(r) * problem.loss.score(r);
      psi_slope += problem.loss.weight(r);
      if (!noises.empty()) add_value(noises, problem, residuals[k], parts[k], i);
      if (out.residuals.empty() || out.residuals.back().run != w.run ||
          out.residuals.back().channel != residuals[k].channel[i] || i == 0) {
        // A window's residuals come channel by channel.
        out.residuals.push_back({w.run, residuals[k].channel[i], {}, {}, {}, {}});
      }
      ResidualSeries& series = out.residuals.back();
      const int sample = residuals[k].sample[i], channel = residuals[k].channel[i];
      const double measured = problem.runs[w.run].data.value(sample, problem.column(w.run, channel));
      series.time.push_back(problem.runs[w.run].data.time[sample]);
      series.residual.push_back(r);
      series.measured.push_back(measured);
      series.model.push_back(measured + r * problem.sigma[channel]);
    }
  }
  const MatX data_information = out.information;
  out.information.diagonal() += problem.prior_information();
  std::vector<int> free;
  for (int g = 0; g < G; ++g)
    if (g >= P || fixed.empty() || !fixed[g]) free.push_back(g);
  out.unknowns += static_cast<int>(free.size());
  const double freedom = std::max(1.0, static_cast<double>(out.values - out.unknowns));
  const double mean_slope = psi_slope / static_cast<double>(out.values);
  out.variance_factor = psi_square / freedom / std::max(mean_slope, 1e-3);
  // A fit that goes through all readings leaves nothing to measure the noise by: it is what it was told to be, or nobody knows it.
  const bool nothing_left = out.values <= out.unknowns;
  if (nothing_left) out.variance_factor = 1.0;
  if (problem.follows_play())
    out.variance_factor =
        std::max(out.variance_factor, std::pow(noise_of_steps(problem).cwiseQuotient(problem.sigma).maxCoeff(), 2));

  // Do residuals follow one another?
  int longest = 0;
  for (int k = 0; k < count; ++k) longest = std::max(longest, static_cast<int>(parts[k].scores.rows()));
  out.autocorrelations = autocorrelations_of(out.residuals, std::min(60, std::max(1, longest / 4)));
  out.autocorrelation = out.autocorrelations.size() > 1 ? out.autocorrelations[1] : 0.0;
  const double noise = 3.0 / std::sqrt(static_cast<double>(out.values));
  const bool lost_in_time = *std::min_element(out.autocorrelations.begin(), out.autocorrelations.end()) <= noise;
  const std::vector<double> until_lost =
      lost_in_time ? out.autocorrelations : autocorrelations_of(out.residuals, std::max(1, longest / 2));
  out.per_independent_one =
      values_per_independent_one(until_lost, noise, static_cast<double>(out.values), out.unknowns);
  // A direction that nothing sees gets a large variance in place of an infinite one.
  constexpr double kUnseen = 1e-13;
  const MatX inverse = inverse_of(out.information, free, kUnseen, 1.0 / kUnseen);
  MatX bread = inverse;
  for (double& v : bread.reshaped())
    if (std::isnan(v)) v = 0.0;
  const MatX told = bread * problem.prior_information().asDiagonal() * bread;
  // M^-1 (s^2 H + Q) M^-1, without the difference of large numbers where the data see nothing.
  out.covariance = out.variance_factor * inverse - (out.variance_factor - 1.0) * told;
  out.departure = MatX::Zero(G, G);
  MatX seen = out.departure;
  ChannelVariances channels;
  if (!noises.empty() && !nothing_left) {
    seen = inverse_of(out.information, free, kHardlySeen, 0.0);
    for (double& v : seen.reshaped())
      if (std::isnan(v)) v = 0.0;
    channels = ChannelVariances(std::move(noises), seen, problem.prior_information());
    out.departure = channels.departure(out.variance_factor);
    out.covariance += seen * out.departure * seen;
  }
  out.white_covariance = inverse;
  out.growth = VecX::Ones(G);
  double freedom_of_errors = freedom;
  if (out.autocorrelation > noise) {
    int lost = 1;
    while (lost + 1 < static_cast<int>(until_lost.size()) && until_lost[static_cast<std::size_t>(lost)] > noise) ++lost;
    // Scores add up to nothing at the optimum: over all of them nothing would be left.
    out.lags = std::min(2 * lost, std::max(1, longest / 2));
    MatX meat = white;
    for (const WindowInformation& part : parts)
      for (int l = 1; l <= out.lags && l < part.scores.rows(); ++l) {
        const Eigen::Index rest = part.scores.rows() - l;
        const MatX cross = part.scores.topRows(rest).transpose() * part.scores.bottomRows(rest);
        meat += (1.0 - l / (out.lags + 1.0)) * (cross + cross.transpose());
      }
    const MatX robust = out.values / freedom * bread * meat * bread + told;
    // Sums of the residuals' own products are too small, since the fit has taken the slow part out of them: no less than what a first-order
    // process does that is worth as few independent values, with its variance over the freedom that is left of these (Bayley and Hammersley
    // 1946). With play, what lasts is the model's own error, which is estimated by itself (model_error.hpp).
    VecX least = VecX::Zero(G);
    if (!problem.follows_play()) {
      const double tau = out.per_independent_one, rho = (tau - 1.0) / (tau + 1.0);
      freedom_of_errors = std::max(1.0, static_cast<double>(out.values) / tau - out.unknowns);
      MatX together = MatX::Zero(G, G), apart = together;
      for (int k = 0; k < count; ++k) {
        const std::vector<int>& channel = residuals[static_cast<std::size_t>(k)].channel;
        together += products_of_followers(parts[k].rows, channel, rho);
        apart += parts[k].rows.transpose() * parts[k].rows;
      }
      const VecX of_followers = (bread * together * bread).diagonal(), of_others = (bread * apart * bread).diagonal();
      for (int g : free)
        if (of_others[g] > 0.0) least[g] = of_followers[g] / of_others[g] * freedom / (tau * freedom_of_errors);
    }
    // Never narrower than the white ones.
    for (int g : free) {
      out.growth[g] = std::max({1.0, robust(g, g) / out.covariance(g, g), least[g]});
      out.covariance.row(g) *= std::sqrt(out.growth[g]);
      out.covariance.col(g) *= std::sqrt(out.growth[g]);
    }
  }
  const VecX deviation = out.covariance.diagonal().cwiseSqrt();
  out.correlation = deviation.cwiseInverse().asDiagonal() * out.covariance * deviation.cwiseInverse().asDiagonal();
  Eigen::SelfAdjointEigenSolver<MatX> eigen(out.information.topLeftCorner(P, P) / out.variance_factor);
  out.rank = static_cast<int>((eigen.eigenvalues().array() > 1.0 / (kUnknown * kUnknown)).count());

  const double normal = boost::math::quantile(boost::math::normal(), 0.5 + 0.5 * confidence);
  // Of what changes along a column of the inverse information.
  const auto quantile_along = [&](const VecX& z) {
    if (nothing_left) return normal;
    const double degrees = std::max(1.0, channels.freedom(z, freedom) * freedom_of_errors / freedom);
    return boost::math::quantile(boost::math::students_t(degrees), 0.5 + 0.5 * confidence);
  };
  const std::vector<std::string> names = problem.global_names();
  for (int g = 0; g < G; ++g) {
    ParameterEstimate e;
    e.name = names[g];
    const double quantile = quantile_along(seen.col(g));
    e.quantile = quantile;
    e.student = quantile / normal;
    e.coordinate_error = deviation[g];
    if (g < P) {
      const FittedParameter& p = problem.parameters[g];
      const double u = fit.globals.u[g];
      e.si_unit = p.si_unit;
      e.written_unit = p.written_unit;
      e.value = p.value(u);
      e.standard_error = p.slope(u) * deviation[g];
      e.low = p.value(u - quantile * deviation[g]);
      e.high = p.value(u + quantile * deviation[g]);
      if (!fixed.empty() && fixed[g]) {
        e.identifiable = false;
        e.reason = "held at its start";
      } else {
        assess_identifiability(p, e);
        if (nothing_left && !problem.noise_told) {
          e.identifiable = false;
          e.reason = std::to_string(out.values) + " values for " + std::to_string(out.unknowns) +
                     " unknowns leave nothing that would tell the noise";
        }
      }
    } else {
      e.value = problem.packed(fit.globals)[g];
      e.si_unit = problem.global_unit(g);
      e.standard_error = deviation[g];
      e.low = e.value - quantile * deviation[g];
      e.high = e.value + quantile * deviation[g];
      e.reason = "nuisance";
    }
    out.parameters.push_back(e);
  }
  out.confused = confused_errors(problem, fit.globals,
                                 {data_information, out.information, out.variance_factor, out.departure, out.covariance,
                                  out.growth, quantile_along},
                                 fixed);
  for (const ConfusedErrors& group : out.confused) {
    for (const int p : group.parameters) {
      ParameterEstimate& e = out.parameters[static_cast<std::size_t>(p)];
      e.identifiable = false;
      e.reason = group.known.empty() ? "the boresight hardly moves by it in these data"
                                     : "other errors move the boresight as it does";
    }
  }
  return out;
}

// Whether these two are among errors that cannot be told apart, which has been said.
static bool confused(const Inference& inference, int a, int b) {
  return std::any_of(inference.confused.begin(), inference.confused.end(), [&](const ConfusedErrors& group) {
    const auto has = [&](int p) {
      return std::find(group.parameters.begin(), group.parameters.end(), p) != group.parameters.end();
    };
    return has(a) || has(b);
  });
}

std::vector<std::string> verdict(const CalibrationProblem& problem, const Inference& inference) {
  std::vector<std::string> words;
  const int P = problem.parameter_count();
  for (int p = 0; p < P; ++p) {
    const ParameterEstimate& e = inference.parameters[p];
    const bool in_a_group = confused(inference, p, p);
    if (!e.identifiable && !in_a_group) words.push_back(e.name + " cannot be told from these data: " + e.reason + ".");
    if (e.identifiable && e.by_prior)
      words.push_back(e.name + " is not told by these data: its value and its error are what was assumed before.");
  }
  for (const ConfusedErrors& group : inference.confused) words.push_back(in_words(group, problem.parameters));
  for (int a = 0; a < P; ++a)
    for (int b = a + 1; b < P; ++b) {
      const double rho = inference.correlation(a, b);
      if (!(std::abs(rho) > 0.9) || confused(inference, a, b)) continue;
      const std::string both = inference.parameters[a].name + " and " + inference.parameters[b].name;
      if (problem.parameters[a].is_error() && problem.parameters[b].is_error()) {
        words.push_back(both + " are known better together than each alone: their correlation is " +
                        number("%.3f", rho) + ". Poses farther apart would separate them.");
        continue;
      }
      words.push_back(
          both + (std::abs(rho) > 0.97 ? " cannot be told apart by these data: " : " are hard to tell apart: ") +
          "their correlation is " + number("%.3f", rho) +
          "; only one combination of them is known. A run under another load or speed would separate them.");
    }
  if (inference.rank < P)
    words.push_back("The data see " + std::to_string(inference.rank) + " of the " + std::to_string(P) +
                    " directions in which the parameters can change.");
  if (inference.grazing > 0)
    words.push_back(std::to_string(inference.grazing) + (inference.grazing == 1 ? " contact" : " contacts") +
                    " began while barely moving (grazing): derivatives by them hold for small changes only.");
  if (inference.lags > 0)
    words.push_back("Neighbouring residuals follow one another (correlation " +
                    number("%.2f", inference.autocorrelation) +
                    "): the model leaves something out. Errors are widened for it over " +
                    std::to_string(inference.lags) + " samples.");
  if (words.empty()) words.push_back("All parameters are identifiable, and no two are confused with each other.");
  return words;
}

}  // namespace boresight
