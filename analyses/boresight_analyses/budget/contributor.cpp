#include "boresight_analyses/budget/contributor.hpp"

#include <algorithm>
#include <boost/math/special_functions/erf.hpp>
#include <cmath>

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

double standard_normal(double u) { return -std::sqrt(2.0) * boost::math::erfc_inv(2.0 * u); }

}  // namespace

const char* to_string(ContributorClass kind) {
  static const char* const names[] = {"bias", "random", "periodic", "drift"};
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
    case ContributorClass::bias:
      return of_bias(c, e, index, interpretation);
    case ContributorClass::random: {
      const double kept = std::sqrt(kept_of_noise(index, c.correlation_time, windows));
      return of_oscillation(e, interpretation, 3.0 * kept, kept);
    }
    case ContributorClass::periodic: {
      const double frequency = 2.0 * M_PI / c.period;
      return of_oscillation(e, interpretation, peak_of_sinusoid(index, frequency, windows),
                            std::sqrt(0.5 * kept_of_sinusoid(index, frequency, windows)));
    }
    case ContributorClass::drift: {
      const double whole = c.recalibrated ? windows.observation_in(duration) : duration;
      const double middle = 0.5 * whole + (c.recalibrated ? 0.0 : windows.start);
      if (index == ErrorIndex::ape) return of_drift(e, interpretation, middle, 0.5 * whole);
      if (index == ErrorIndex::mpe) return of_drift(e, interpretation, middle, 0.5 * (whole - windows.window));
      if (index == ErrorIndex::rpe) return of_drift(e, interpretation, 0.0, 0.5 * windows.window);
      if (index == ErrorIndex::pde) return of_drift(e, interpretation, windows.separation, 0.0);
      const double revisit = windows.revisit_after();
      const double passed = c.recalibrated ? revisit - std::round(revisit / whole) * whole : revisit;
      return of_drift(e, interpretation, passed, 0.0);
    }
  }
  return {};
}

std::vector<Vec3> course(const Contributor& c, std::uint64_t seed, std::uint64_t member, std::uint64_t stream,
                         double spacing, std::size_t samples, const Windows& windows) {
  constexpr std::uint64_t kAxes = 4;  // places a stream has for an observation
  const CounterStream value(seed, StreamPurpose::budget_value), in_time(seed, StreamPurpose::budget_course);
  if (c.of_error) {
    // Contributors of one group draw one and the same value; a factor has a place of its own.
    constexpr std::uint64_t kPlaceOfValue = 0, kPlaceOfFactor = 3;
    const auto drawn = [&](const DistributionPtr& of, std::uint64_t place, double fixed) {
      return of ? of->quantile(value.uniform(member, stream, place)) : fixed;
    };
    return course_of(*c.of_error, drawn(c.of_error->factor, kPlaceOfFactor, 1.0),
                     drawn(c.of_error->value, kPlaceOfValue, 0.0));
  }
  const double observation = windows.observation_in(spacing * static_cast<double>(samples));
  const auto observed = static_cast<std::size_t>(std::max(1.0, std::round(observation / spacing)));
  std::vector<Vec3> out(samples, Vec3::Zero());
  for (std::uint64_t axis = 0; axis < 3; ++axis) {
    if (!c.parameter[axis]) continue;
    const Distribution& distribution = *c.parameter[axis];
    const auto drawn = [&](std::size_t observation_number) {
      return distribution.quantile(value.uniform(member, stream, axis + kAxes * observation_number));
    };
    double parameter = drawn(0);
    const double phase = 2.0 * M_PI * in_time.uniform(member, stream * kAxes + axis);
    const double correlation = c.kind == ContributorClass::random ? std::exp(-spacing / c.correlation_time) : 0.0;
    double noise = 0.0;
    for (std::size_t k = 0; k < samples; ++k) {
      const double t = (static_cast<double>(k) + 0.5) * spacing;
      if (c.kind == ContributorClass::bias && c.recalibrated && k % observed == 0) parameter = drawn(k / observed);
      double& e = out[k][static_cast<Eigen::Index>(axis)];
      switch (c.kind) {
        case ContributorClass::bias:
          e = parameter;
          break;
        case ContributorClass::random: {
          const double fresh = standard_normal(in_time.uniform(member, stream * kAxes + axis, k + 1));
          noise = k == 0 ? fresh : correlation * noise + std::sqrt(1.0 - correlation * correlation) * fresh;
          e = parameter * noise;
          break;
        }
        case ContributorClass::periodic:
          e = parameter * std::sin(2.0 * M_PI * t / c.period + phase);
          break;
        case ContributorClass::drift:
          e = parameter * (c.recalibrated ? t - static_cast<double>(k / observed) * observation : t + windows.start);
          break;
      }
    }
  }
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

}  // namespace boresight
