#include "boresight_analyses/budget/contributor.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <stdexcept>

#include "boresight_analyses/random/counter_stream.hpp"

namespace boresight {
namespace {

// The ensemble parameter as the tables need it.
struct Ensemble {
  double mean, sd, rms, low, high;

  explicit Ensemble(const Distribution& d) : mean(d.mean()), sd(d.sd()), rms(std::hypot(mean, sd)) {
    constexpr double kDeviations = 3.0;  // worst case of a distribution without ends
    low = std::isfinite(d.lowest()) ? d.lowest() : mean - kDeviations * sd;
    high = std::isfinite(d.highest()) ? d.highest() : mean + kDeviations * sd;
  }
  double worst() const { return std::max(std::abs(low), std::abs(high)); }
  double worst_signed() const { return std::abs(low) > std::abs(high) ? low : high; }
};

Moments scaled(const Ensemble& e, double factor) { return {factor * e.mean, std::abs(factor) * e.sd}; }

// A factor of what has these moments: of values, or of largest sizes.
Moments times(const Ensemble& factor, const Moments& m, Interpretation interpretation) {
  if (interpretation == Interpretation::temporal) return {factor.worst_signed() * m.mean, factor.worst() * m.sd};
  const double mean = factor.mean * m.mean;
  return {mean, std::sqrt(std::max(0.0, factor.rms * factor.rms * (m.mean * m.mean + m.sd * m.sd) - mean * mean))};
}

// What a transfer function leaves of a constant, a sinusoid and a ramp once it has settled.
double of_constant(const Contributor& c) { return c.through ? c.through->standing() : 1.0; }
std::complex<double> of_sinusoid(const Contributor& c) { return c.through ? c.through->at(1.0 / c.period) : 1.0; }
double behind_ramp(const Contributor& c) { return c.through ? c.through->slope() : 0.0; }

Moments of_bias(const Contributor& c, const Ensemble& e, ErrorIndex index, Interpretation interpretation) {
  if (index == ErrorIndex::rpe || index == ErrorIndex::pde) return {};
  if (index == ErrorIndex::pre) {
    if (!c.recalibrated) return {};
    return interpretation == Interpretation::temporal ? Moments{e.high - e.low, 0.0}
                                                      : Moments{0.0, std::sqrt(2.0) * e.sd};
  }
  return interpretation == Interpretation::temporal ? Moments{e.worst_signed(), 0.0} : Moments{e.mean, e.sd};
}

// Zero mean in time; `peak` times the parameter is the largest size, `rms` times it the root mean square.
Moments of_oscillation(const Ensemble& e, Interpretation interpretation, double peak, double rms) {
  switch (interpretation) {
    case Interpretation::ensemble:
      return scaled(e, peak);
    case Interpretation::temporal:
      return {0.0, rms * e.worst()};
    case Interpretation::mixed:
      return {0.0, rms * e.rms};
  }
  return {};
}

// The index is the rate times a factor uniform in [middle - half, middle + half].
Moments of_drift(const Ensemble& e, Interpretation interpretation, double middle, double half) {
  const double variance = half * half / 3.0;
  switch (interpretation) {
    case Interpretation::ensemble:
      return scaled(e, std::abs(middle) + half);
    case Interpretation::temporal:
      return {middle * e.worst_signed(), std::sqrt(variance) * e.worst()};
    case Interpretation::mixed:
      return {middle * e.mean, std::hypot(middle * e.sd, std::sqrt(variance) * e.rms)};
  }
  return {};
}

// Whether the means of a contributor are sizes without a sign.
bool comes_either_way(const Contributor& c, Interpretation interpretation) {
  if (interpretation == Interpretation::mixed) return false;
  if (interpretation == Interpretation::ensemble) return c.of_error || c.kind != ContributorClass::bias;
  const auto scatters = [](const DistributionPtr& of) { return of && of->sd() > 0.0; };
  if (c.of_error) return scatters(c.of_error->factor) || scatters(c.of_error->value);
  return std::any_of(c.parameter.begin(), c.parameter.end(), scatters);
}

// Of the measured course's values, without the factor.
std::vector<MemberSums> sums_of_stretches(const MeasuredCourse& measured, ErrorIndex index, const Windows& windows,
                                          double duration) {
  const std::vector<std::vector<Vec3>>& stretches = measured.stretches();
  const double spacing = duration / static_cast<double>(stretches.front().size());
  std::vector<MemberSums> sums;
  for (const std::vector<Vec3>& stretch : stretches)
    sums.push_back(sums_of(index_values(index, {spacing, stretch}, windows)));
  return sums;
}

// How the contributor's own axes vary together that have one course: of others by axes_factor alone.
std::optional<Mat3> covariance_of(const Contributor& c, ErrorIndex index, Interpretation interpretation,
                                  const Windows& windows, double duration) {
  if (c.of_error) {
    const std::size_t samples = std::max<std::size_t>(1, c.of_error->by_value.size());
    return covariance_of(*c.of_error, index, interpretation, windows, duration / static_cast<double>(samples));
  }
  if (!c.measured) return std::nullopt;
  Vec3 rms = Vec3::Zero(), mean = Vec3::Zero();
  for (Eigen::Index a = 0; a < 3; ++a)
    if (const DistributionPtr& factor = c.parameter[static_cast<std::size_t>(a)])
      rms[a] = Ensemble(*factor).rms, mean[a] = factor->mean();
  std::vector<MemberSums> sums = sums_of_stretches(*c.measured, index, windows, duration);
  // The factor is one for all axes that it has.
  if (interpretation != Interpretation::mixed) return covariance_of(sums, interpretation);
  MemberSums all;
  for (const MemberSums& s : sums) all.count += s.count, all.sum += s.sum, all.squares += s.squares;
  const Vec3 of_mean = mean.cwiseProduct(all.sum / all.count);
  return Mat3(rms.asDiagonal() * (all.squares / all.count) * rms.asDiagonal() - of_mean * of_mean.transpose());
}

constexpr std::uint64_t kAxes = 4;           // places a stream has for an observation
constexpr std::uint64_t kPlaceOfFactor = 3;  // the last of them

}  // namespace

const char* to_string(ContributorClass kind) {
  static const char* const names[] = {"bias", "random", "periodic", "drift", "spectrum", "measured"};
  return names[static_cast<int>(kind)];
}

Moments moments(const Contributor& c, int axis, ErrorIndex index, Interpretation interpretation, const Windows& windows,
                double duration) {
  if (c.of_error) {
    const std::size_t samples = std::max<std::size_t>(1, c.of_error->by_value.size());
    return moments(*c.of_error, axis, index, interpretation, windows, duration / static_cast<double>(samples));
  }
  const DistributionPtr& distribution = c.parameter[static_cast<std::size_t>(axis)];
  if (!distribution) return {};
  const Ensemble e(*distribution);
  switch (c.kind) {
    case ContributorClass::bias: {
      const Moments m = of_bias(c, e, index, interpretation);
      return {of_constant(c) * m.mean, std::abs(of_constant(c)) * m.sd};
    }
    case ContributorClass::random: {
      if (c.noise) break;
      const double kept = std::sqrt(kept_of_noise(index, c.correlation_time, windows));
      return of_oscillation(e, interpretation, 3.0 * kept, kept);
    }
    case ContributorClass::periodic: {
      const double frequency = 2.0 * M_PI / c.period, gain = std::abs(of_sinusoid(c));
      return of_oscillation(e, interpretation, gain * peak_of_sinusoid(index, frequency, windows),
                            gain * std::sqrt(0.5 * kept_of_sinusoid(index, frequency, windows)));
    }
    case ContributorClass::spectrum:
      break;
    case ContributorClass::measured: {
      const std::vector<MemberSums> sums = sums_of_stretches(*c.measured, index, windows, duration);
      return times(e, moments_of(sums, axis, interpretation), interpretation);
    }
    case ContributorClass::drift: {
      const double whole = c.recalibrated ? windows.observation_in(duration) : duration;
      const double gain = of_constant(c), half = 0.5 * std::abs(gain);
      const double middle = gain * (0.5 * whole + (c.recalibrated ? 0.0 : windows.start)) + behind_ramp(c);
      if (index == ErrorIndex::ape) return of_drift(e, interpretation, middle, half * whole);
      if (index == ErrorIndex::mpe) return of_drift(e, interpretation, middle, half * (whole - windows.window));
      if (index == ErrorIndex::rpe) return of_drift(e, interpretation, 0.0, half * windows.window);
      if (index == ErrorIndex::pde) return of_drift(e, interpretation, gain * windows.separation, 0.0);
      const double revisit = windows.revisit_after();
      if (!c.recalibrated) return of_drift(e, interpretation, gain * revisit, 0.0);
      // The two windows lie in different observations, s = revisit - q whole further on in theirs, or that and an observation less: the drift
      // has been reset q or q + 1 times in between. How often either, by the places that a window has in an observation.
      const double q = std::floor(revisit / whole * (1.0 + 1e-12)), s = std::max(0.0, revisit - q * whole);
      const double fewer = q > 0.0 ? std::max(0.0, whole - windows.window - s) : 0.0,
                   more = std::max(0.0, s - windows.window), all = fewer + more;
      // Windows as long as an observation lie in whole ones.
      const double share = all > 0.0 ? more / all : q > 0.0 && s < 0.5 * whole ? 0.0 : 1.0;
      if (interpretation == Interpretation::ensemble)
        return of_drift(e, interpretation,
                        std::abs(gain) * std::max(share < 1.0 ? s : 0.0, share > 0.0 ? whole - s : 0.0), 0.0);
      return of_drift(e, interpretation, gain * (s - share * whole),
                      std::abs(gain) * whole * std::sqrt(3.0 * share * (1.0 - share)));
    }
  }
  const double deviation = std::sqrt(c.noise->variance(index, windows));
  return of_oscillation(e, interpretation, 3.0 * deviation, deviation);
}

AxesMoments axes_moments(const Contributor& c, ErrorIndex index, Interpretation interpretation, const Windows& windows,
                         double duration) {
  AxesMoments out;
  Vec3 deviations = Vec3::Zero();
  for (int axis = 0; axis < 3; ++axis) {
    const Moments m = moments(c, axis, index, interpretation, windows, duration);
    out.mean[axis] = m.mean;
    deviations[axis] = m.sd;
  }
  out.either_sign = comes_either_way(c, interpretation);
  out.mean = out.either_sign ? Vec3(c.frame.cwiseAbs() * out.mean.cwiseAbs()) : Vec3(c.frame * out.mean);
  const std::optional<Mat3> together = covariance_of(c, index, interpretation, windows, duration);
  out.factor =
      c.frame * (together ? factor_with(*together, deviations) : Mat3(deviations.asDiagonal() * c.axes_factor));
  return out;
}

std::vector<Vec3> course(const Contributor& c, std::uint64_t seed, std::uint64_t member, const Draws& draws,
                         double spacing, std::size_t samples, const Windows& windows) {
  const std::uint64_t stream = draws.first();
  const CounterStream value(seed, StreamPurpose::budget_value), in_time(seed, StreamPurpose::budget_course);
  if (c.of_error) {
    // Contributors of one group draw one and the same value.
    constexpr std::uint64_t kPlaceOfValue = 0;
    const auto drawn = [&](const DistributionPtr& of, std::uint64_t place, double fixed) {
      return of ? of->quantile(value.uniform(member, stream, place)) : fixed;
    };
    return course_of(*c.of_error, drawn(c.of_error->factor, kPlaceOfFactor, 1.0),
                     drawn(c.of_error->value, kPlaceOfValue, 0.0));
  }
  const double observation = windows.observation_in(spacing * static_cast<double>(samples));
  const auto observed = static_cast<std::size_t>(std::max(1.0, std::round(observation / spacing)));
  std::vector<Vec3> out(samples, Vec3::Zero());
  if ((c.noise && (c.noise_course->samples() != samples || c.noise_course->spacing() != spacing)) ||
      (c.measured && c.measured->stretches().front().size() != samples))
    throw std::invalid_argument("the course of " + c.name + " was made for another grid");
  // A factor is one for all axes.
  const bool by_factor = c.kind == ContributorClass::spectrum || c.kind == ContributorClass::measured;
  if (c.measured) out = c.measured->history(in_time.uniform(member, stream * kAxes));
  const Mat3 one_for_all = Mat3::Identity();
  using Where = MixedNumbers::Where;
  const MixedNumbers values(value, member, draws, by_factor ? one_for_all : c.axes_factor),
      noises(in_time, member, draws, c.axes_factor);
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    if (!c.parameter[static_cast<std::size_t>(axis)]) continue;
    const Distribution& distribution = *c.parameter[static_cast<std::size_t>(axis)];
    const auto drawn = [&](std::size_t observation_number) {
      return distribution.quantile(values.uniform(axis, [&](std::uint64_t of, Eigen::Index own) -> Where {
        return {of, (by_factor ? kPlaceOfFactor : static_cast<std::uint64_t>(own)) + kAxes * observation_number};
      }));
    };
    const auto in_noise = [&](std::uint64_t number) {
      return [number](std::uint64_t of, Eigen::Index own) -> Where {
        return {of * kAxes + static_cast<std::uint64_t>(own), number};
      };
    };
    double parameter = drawn(0);
    if (c.measured) {
      for (Vec3& e : out) e[axis] *= parameter;
      continue;
    }
    if (c.noise) {
      const std::vector<double> noise =
          c.noise_course->drawn([&](std::uint64_t k) { return noises.two_normals(axis, in_noise(2 * k + 1)); });
      for (std::size_t k = 0; k < samples; ++k) out[k][axis] = parameter * noise[k];
      continue;
    }
    const bool turns = c.kind == ContributorClass::periodic;
    const double gain = turns ? std::abs(of_sinusoid(c)) : of_constant(c),
                 lead = turns ? std::arg(of_sinusoid(c)) : 0.0;
    const double behind = behind_ramp(c);
    const double phase = 2.0 * M_PI * in_time.uniform(member, stream * kAxes + static_cast<std::uint64_t>(axis)) + lead;
    const double correlation = c.kind == ContributorClass::random ? std::exp(-spacing / c.correlation_time) : 0.0;
    double noise = 0.0;
    for (std::size_t k = 0; k < samples; ++k) {
      const double t = (static_cast<double>(k) + 0.5) * spacing;
      if (c.kind == ContributorClass::bias && c.recalibrated && k % observed == 0) parameter = drawn(k / observed);
      double& e = out[k][axis];
      switch (c.kind) {
        case ContributorClass::bias:
          e = gain * parameter;
          break;
        case ContributorClass::random: {
          const double fresh = noises.normal(axis, in_noise(k + 1));
          noise = k == 0 ? fresh : correlation * noise + std::sqrt(1.0 - correlation * correlation) * fresh;
          e = parameter * noise;
          break;
        }
        case ContributorClass::periodic:
          e = gain * parameter * std::sin(2.0 * M_PI * t / c.period + phase);
          break;
        case ContributorClass::drift:
          e = parameter *
              (gain * (c.recalibrated ? (static_cast<double>(k % observed) + 0.5) * spacing : t + windows.start) +
               behind);
          break;
        case ContributorClass::spectrum:
        case ContributorClass::measured:
          break;
      }
    }
  }
  if (c.frame != one_for_all)
    for (Vec3& e : out) e = (c.frame * e).eval();
  return out;
}

std::vector<std::uint64_t> streams_of(const std::vector<Contributor>& contributors) {
  std::vector<std::uint64_t> streams;
  for (std::size_t i = 0; i < contributors.size(); ++i) {
    std::size_t first = 0;
    const std::string& group = contributors[i].group;
    while (first < i && (group.empty() || contributors[first].group != group)) ++first;
    streams.push_back(first);
  }
  return streams;
}

std::vector<Draws> draws_of(const std::vector<Contributor>& contributors,
                            const std::vector<ContributorCorrelation>& correlations) {
  return draws_of(streams_of(contributors), correlations);
}

}  // namespace boresight
