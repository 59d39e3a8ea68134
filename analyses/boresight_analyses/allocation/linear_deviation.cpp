#include "boresight_analyses/allocation/linear_deviation.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

#include "boresight/formulations/ideal_simulation.hpp"
#include "boresight/mechanism/error.hpp"
#include "boresight/mechanism/load_time.hpp"
#include "boresight/scene/standing_errors.hpp"
#include "boresight/statics/quasistatic.hpp"
#include "boresight/stepping/motion_scales.hpp"
#include "boresight_analyses/study/error_parts.hpp"

namespace boresight {
namespace {

double dot(const double* u, const double* v) { return u[0] * v[0] + u[1] * v[1] + u[2] * v[2]; }
double size_of(const double* v) { return std::sqrt(dot(v, v)); }

// The vector whose length is the quantity, of a displacement and a turn of the boresight body, to first order: the
// form that the deviation is linear in.
Eigen::Matrix<double, 3, 6> gain_of(const PoseSample& sample, PointingQuantity quantity, const Pointing& pointing) {
  return error_gain(quantity, sample.ideal, sample.ideal.q * pointing.boresight_B, pointing.line_of_sight);
}

// Which errors of the description these paths name; none where they name gaps.
std::vector<std::size_t> errors_named(const MechanismDescription& mechanism, const std::vector<ParameterPath>& paths) {
  std::vector<std::size_t> named;
  for (const ParameterPath& path : paths)
    for (const std::string& single : single_paths(mechanism, path.path()))
      for (std::size_t e = 0; e < mechanism.errors.size(); ++e)
        if (single == "error." + mechanism.errors[e].name) named.push_back(e);
  return named;
}

// The columns of these errors, [place][..]; none where there are none. `may`: which places may be left out; `leaves_out`: which are,
// as no linear form holds for them.
std::unique_ptr<const StandingErrors> standing_errors(const Mechanism& mechanism, const IdealMotion& commanded,
                                                      const std::vector<std::vector<std::size_t>>& errors_of,
                                                      const std::vector<bool>& may, std::vector<bool>& leaves_out) {
  std::vector<bool> needed(mechanism.description().errors.size(), false), all = needed;
  for (std::size_t j = 0; j < errors_of.size(); ++j)
    for (const std::size_t e : errors_of[j]) {
      all[e] = true;
      if (!may[j]) needed[e] = true;
    }
  const auto any = [](const std::vector<bool>& of) { return std::find(of.begin(), of.end(), true) != of.end(); };
  std::unique_ptr<const StandingErrors> standing;
  if (!any(all)) return standing;
  try {
    standing = std::make_unique<StandingErrors>(mechanism, commanded, all);
  } catch (const ComputationError&) {  // one strains the mechanism
    if (needed == all) throw;
    if (any(needed)) standing = std::make_unique<StandingErrors>(mechanism, commanded, needed);
    all = needed;
  }
  for (std::size_t j = 0; j < errors_of.size(); ++j)
    for (const std::size_t e : errors_of[j]) {
      if (all[e] && !standing->uses_play(e)) continue;
      if (!may[j])
        throw ComputationError(
            taken_up_by_play(mechanism.description(), e) +
            "; no deviation that is linear in it can share its tolerance out: scatter it by [[random]]");
      leaves_out[j] = true;
    }
  return standing;
}

// The instants that are kept: of what the index counts, equally spaced. A motion that turns back and forth faster than that would be met at
// equal angles; of it each instant is drawn from its own stretch of the motion.
struct Kept {
  double history_spacing = 0.0;    // of the runs that they are taken from [s]
  std::vector<double> at;          // [s]
  std::vector<double> stands_for;  // the middle of what an instant stands for [s]
  std::size_t sample(std::size_t k, std::size_t samples) const {
    return std::min(samples - 1, static_cast<std::size_t>(std::lround(at[k] / history_spacing)));
  }
};

Kept kept_of(const Mechanism& mechanism, const IdealMotion& ideal, double start, std::size_t instants) {
  constexpr double kResolved = 0.25;              // of the time in which a body turns by a radian, or a load changes
  constexpr double kGolden = 0.6180339887498949;  // whose multiples come back to no period
  constexpr double kOfStart = 8.0,
                   kMostFiner = 200.0;  // samples of the history to an instant, where they need not fall on it
  const double fastest = kResolved * std::min(own_time(ideal, mechanism.bodies(), mechanism.characteristic_length()),
                                              load_time(mechanism));
  const double whole = mechanism.duration(), counted = whole - start, spacing = counted / static_cast<double>(instants);
  const bool resolved = spacing <= fastest;
  double finer = 1.0;
  if (start > 0.0) finer = kOfStart * whole / counted;
  if (!resolved) finer = std::max(finer, whole / counted * std::ceil(spacing / fastest) * 4.0);
  Kept kept;
  kept.history_spacing = whole / (static_cast<double>(instants) * std::min(kMostFiner, std::ceil(finer)));
  for (std::size_t k = 0; k < instants + (resolved ? 1 : 0); ++k) {
    const double place = kGolden * static_cast<double>(k + 1);
    kept.at.push_back(start + spacing * (static_cast<double>(k) + (resolved ? 0.0 : place - std::floor(place))));
    kept.stands_for.push_back(start + spacing * (static_cast<double>(k) + (resolved ? 0.0 : 0.5)));
  }
  return kept;
}

}  // namespace

LinearDeviation::LinearDeviation(std::vector<double> time, std::vector<double> offset,
                                 std::vector<std::vector<double>> sensitivity, std::string statistic)
    : time_(std::move(time)),
      offset_(std::move(offset)),
      weight_(time_.size(), 1.0),
      sensitivity_(std::move(sensitivity)),
      statistic_(std::move(statistic)) {
  const std::size_t n = time_.size();
  if (n > 1) {
    const double whole = time_.back() - time_.front();
    for (std::size_t i = 0; i < n; ++i)
      weight_[i] = 0.5 * (time_[std::min(i + 1, n - 1)] - time_[i == 0 ? 0 : i - 1]) / whole;
  }
  for (std::size_t i = 0; i < n; ++i) offset_size_.push_back(size_of(&offset_[3 * i]));
  for (const auto& a : sensitivity_) {
    size_.emplace_back(n);
    for (std::size_t i = 0; i < n; ++i) size_.back()[i] = size_of(&a[3 * i]);
  }
}

LinearDeviation LinearDeviation::of_only(const std::vector<std::size_t>& kept) const {
  std::vector<std::vector<double>> sensitivity;
  for (const std::size_t j : kept) sensitivity.push_back(sensitivity_[j]);
  return {time_, offset_, std::move(sensitivity), statistic_};
}

double LinearDeviation::statistic_of(const std::vector<double>& sizes, std::vector<double>* derivative) const {
  const std::size_t n = sizes.size();
  if (derivative) derivative->assign(n, 0.0);
  if (statistic_ == "mean") {
    double sum = 0.0;
    for (std::size_t i = 0; i < n; ++i) sum += weight_[i] * sizes[i];
    if (derivative) *derivative = weight_;
    return sum;
  }
  if (statistic_ == "rms") {
    double sum = 0.0;
    for (std::size_t i = 0; i < n; ++i) sum += weight_[i] * sizes[i] * sizes[i];
    const double rms = std::sqrt(sum);
    if (derivative && rms > 0.0)
      for (std::size_t i = 0; i < n; ++i) (*derivative)[i] = weight_[i] * sizes[i] / rms;
    return rms;
  }
  std::size_t at = static_cast<std::size_t>(std::max_element(sizes.begin(), sizes.end()) - sizes.begin());
  if (statistic_ == "p99.73") {
    // The instant at which the time spent above falls to 0.27 %.
    std::vector<std::size_t> order(n);
    for (std::size_t i = 0; i < n; ++i) order[i] = i;
    std::sort(order.begin(), order.end(), [&](std::size_t l, std::size_t r) { return sizes[l] > sizes[r]; });
    double above = 0.0;
    for (const std::size_t i : order) {
      at = i;
      if ((above += weight_[i]) > 0.0027) break;
    }
  }
  if (derivative) (*derivative)[at] = 1.0;
  return sizes[at];
}

double LinearDeviation::index(std::span<const double> gaps) const { return index(gaps, {}); }

double LinearDeviation::index(std::span<const double> gaps, std::span<double> gradient) const {
  thread_local std::vector<double> e, sizes, derivative;
  e = offset_;
  for (std::size_t j = 0; j < gaps.size(); ++j) {
    const double c = gaps[j];
    const double* a = sensitivity_[j].data();
    for (std::size_t i = 0; i < e.size(); ++i) e[i] += c * a[i];
  }
  sizes.resize(time_.size());
  for (std::size_t i = 0; i < sizes.size(); ++i) sizes[i] = size_of(&e[3 * i]);
  const double value = statistic_of(sizes, gradient.empty() ? nullptr : &derivative);
  if (gradient.empty()) return value;
  std::fill(gradient.begin(), gradient.end(), 0.0);
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    if (derivative[i] == 0.0 || sizes[i] == 0.0) continue;
    const double w = derivative[i] / sizes[i];
    for (std::size_t j = 0; j < gradient.size(); ++j) {
      const double* a = &sensitivity_[j][3 * i];
      gradient[j] += w * (a[0] * e[3 * i] + a[1] * e[3 * i + 1] + a[2] * e[3 * i + 2]);
    }
  }
  return value;
}

double LinearDeviation::least_index(std::span<const double> at, std::span<const double> low,
                                    std::span<const double> high) const {
  std::vector<double> e = offset_, sizes(time_.size());
  for (std::size_t j = 0; j < at.size(); ++j)
    for (std::size_t i = 0; i < e.size(); ++i) e[i] += at[j] * sensitivity_[j][i];
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    const double size = size_of(&e[3 * i]);
    if (size == 0.0) continue;
    double least = size;
    for (std::size_t j = 0; j < at.size(); ++j) {
      if (low[j] == high[j]) continue;
      const double slope = dot(&e[3 * i], &sensitivity_[j][3 * i]) / size;
      least += std::min(slope * (low[j] - at[j]), slope * (high[j] - at[j]));
    }
    sizes[i] = std::max(0.0, least);
  }
  return statistic_of(sizes, nullptr);
}

bool LinearDeviation::rises_with_every_gap(std::span<const double> low, std::span<const double> high) const {
  for (std::size_t i = 0; i < time_.size(); ++i)
    for (std::size_t j = 0; j < gaps(); ++j) {
      const double* a = &sensitivity_[j][3 * i];
      double least = dot(&offset_[3 * i], a), scale = std::abs(least);
      if (low[j] == high[j]) continue;
      for (std::size_t k = 0; k < gaps(); ++k) {
        const double product = dot(&sensitivity_[k][3 * i], a);
        least += std::min(low[k] * product, high[k] * product);
        scale += std::max(std::abs(low[k]), std::abs(high[k])) * std::abs(product);
      }
      constexpr double kRounding = 1e-12;
      if (least < -kRounding * scale) return false;
    }
  return true;
}

double LinearDeviation::most_per_gap(std::size_t j) const {
  return *std::max_element(size_[j].begin(), size_[j].end());
}

double LinearDeviation::worst_index(std::span<const double> gaps) const { return worst_index(gaps, {}); }

double LinearDeviation::worst_index(std::span<const double> gaps, std::span<double> gradient) const {
  std::vector<double> sizes = offset_size_, derivative;
  for (std::size_t j = 0; j < gaps.size(); ++j)
    for (std::size_t i = 0; i < sizes.size(); ++i) sizes[i] += size_[j][i] * gaps[j];
  const double value = statistic_of(sizes, gradient.empty() ? nullptr : &derivative);
  for (std::size_t j = 0; j < gradient.size(); ++j) {
    gradient[j] = 0.0;
    for (std::size_t i = 0; i < sizes.size(); ++i) gradient[j] += derivative[i] * size_[j][i];
  }
  return value;
}

LinearDeviation find_linear_deviation(const std::shared_ptr<const Mechanism>& mechanism,
                                      const std::vector<std::vector<ParameterPath>>& places,
                                      const std::vector<double>& probe, const IndexChoice& index, std::size_t instants,
                                      double& misfit, std::vector<bool>* left_out) {
  index.title();  // throws where the quantity or the statistic is unknown
  const PointingQuantity quantity = index.kind();
  const auto rung = make_rests(mechanism);
  RunOptions options;
  options.events = false;
  options.start = index.start;
  const IdealMotion commanded = ideal_motion(*mechanism, mechanism->parameters());
  const Kept kept = kept_of(*mechanism, commanded, index.start, instants);
  options.sample_spacing = kept.history_spacing;
  std::vector<std::vector<std::size_t>> errors_of;
  for (const auto& place : places) errors_of.push_back(errors_named(mechanism->description(), place));
  std::vector<bool> leaves_out(places.size(), false);
  const std::unique_ptr<const StandingErrors> standing =
      standing_errors(*mechanism, commanded, errors_of,
                      left_out == nullptr ? std::vector<bool>(places.size(), false) : *left_out, leaves_out);
  if (left_out != nullptr) *left_out = leaves_out;
  // Error vectors of a run, all instants in a row.
  std::vector<double> time;
  std::vector<Eigen::Matrix<double, 3, 6>> gains;
  const auto vectors = [&](const std::vector<double>& gaps, double* value) {
    Parameters parameters = mechanism->parameters();
    for (std::size_t j = 0; j < places.size(); ++j)
      if (!leaves_out[j])
        for (const ParameterPath& place : places[j]) place.set(parameters, gaps[j]);
    const RunResult result = rung->run(parameters, options);
    if (value) *value = index.of(result.index);
    time.clear();
    std::vector<double> out;
    gains.clear();
    for (std::size_t k = 0; k < kept.at.size(); ++k) {
      const std::size_t i = kept.sample(k, result.time.size());
      const PoseSample& sample = result.boresight.samples[i];
      time.push_back(result.time[i]);
      gains.push_back(gain_of(sample, quantity, mechanism->pointing()));
      const Vec3 e =
          gains.back().leftCols<3>() * sample.error.displacement + gains.back().rightCols<3>() * sample.error.rotation;
      out.insert(out.end(), {e.x(), e.y(), e.z()});
    }
    return out;
  };
  double truth = 0.0;
  const std::vector<double> whole = vectors(probe, &truth);
  std::vector<std::vector<double>> sensitivity;
  std::vector<double> offset = whole;
  MatX columns;  // of all wanted errors: 3 instants x errors
  if (standing) {
    const TimeTable& table = standing->gain(mechanism->boresight_body());
    Eigen::Matrix<double, 6, Eigen::Dynamic, Eigen::RowMajor> at(6, standing->count());
    columns.resize(static_cast<Eigen::Index>(whole.size()), standing->count());
    for (std::size_t i = 0; i < time.size(); ++i) {
      table.at(time[i], at.data());
      columns.middleRows<3>(static_cast<Eigen::Index>(3 * i)) = gains[i] * at;
    }
  }
  for (std::size_t j = 0; j < places.size(); ++j) {
    std::vector<double>& a = sensitivity.emplace_back(whole.size());
    if (leaves_out[j]) continue;
    if (!errors_of[j].empty()) {
      for (const std::size_t e : errors_of[j])
        Eigen::Map<VecX>(a.data(), columns.rows()) += columns.col(static_cast<Eigen::Index>(e));
    } else {
      std::vector<double> less = probe;
      less[j] *= 0.5;
      const std::vector<double> there = vectors(less, nullptr);
      for (std::size_t i = 0; i < a.size(); ++i) a[i] = (whole[i] - there[i]) / (probe[j] - less[j]);
    }
    for (std::size_t i = 0; i < a.size(); ++i) offset[i] -= a[i] * probe[j];
  }
  LinearDeviation linear(kept.stands_for, offset, sensitivity, index.statistic);
  // At the probe itself only the instants can differ; far from it the form is tried too: every other one narrow, and each alone.
  misfit = truth > 0.0 ? std::abs(linear.index(probe) - truth) / truth : 0.0;
  std::vector<std::vector<double>> others(1, probe);
  for (std::size_t j = 0; j < probe.size(); ++j) others[0][j] *= j % 2 == 0 ? 0.25 : 0.75;
  constexpr std::size_t kMostAlone = 12;
  for (std::size_t j = 0; j < std::min(probe.size(), kMostAlone); ++j) {
    std::vector<double>& alone = others.emplace_back(probe);
    for (std::size_t k = 0; k < alone.size(); ++k) alone[k] *= k == j ? 1.0 : 0.25;
  }
  const double whole_truth = truth;
  for (const std::vector<double>& other : others) {
    vectors(other, &truth);
    // Alone, one may do next to nothing, of which nothing hangs.
    const double least = &other == &others.front() ? 0.0 : 1e-3 * whole_truth;
    if (truth > least) misfit = std::max(misfit, std::abs(linear.index(other) - truth) / truth);
  }
  return linear;
}

}  // namespace boresight
