#include "boresight_analyses/calibration/channel_noise.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

#include "boresight/rungs/integrator_choice.hpp"

namespace boresight {

namespace {

// The last digit of a channel that is read in so few that most readings are there more than once; otherwise 0.
double last_digit(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  double smallest = std::numeric_limits<double>::infinity();
  std::size_t different = values.empty() ? 0 : 1;
  for (std::size_t i = 1; i < values.size(); ++i)
    if (values[i] > values[i - 1]) {
      smallest = std::min(smallest, values[i] - values[i - 1]);
      ++different;
    }
  return std::isfinite(smallest) && 2 * different <= values.size() ? smallest : 0.0;
}

}  // namespace

VecX noise_from_differences(const CalibrationProblem& problem) {
  VecX sigma(static_cast<Eigen::Index>(problem.channels.size()));
  for (int c = 0; c < static_cast<int>(problem.channels.size()); ++c) {
    std::vector<double> differences;
    std::vector<double> sizes;
    double resolution = 0.0;  // of the readings: of those without a resolution next to nothing
    for (std::size_t r = 0; r < problem.runs.size(); ++r) {
      const int column = problem.column(static_cast<int>(r), c);
      if (column < 0) continue;
      const auto all = problem.runs[r].data.value.col(column);
      // Where another sensor reads oftener, this one's readings have gaps between them.
      std::vector<double> v;
      for (const double reading : all)
        if (std::isfinite(reading)) v.push_back(reading);
      // The same of a channel that is read in every second row.
      long adjacent = 0;
      for (Eigen::Index i = 1; i + 1 < all.size(); ++i)
        adjacent += std::isfinite(all[i - 1]) && std::isfinite(all[i]) && std::isfinite(all[i + 1]);
      const bool gaps = !problem.runs[r].data.file_of.empty() || 4 * adjacent < static_cast<long>(v.size()) - 2;
      for (Eigen::Index i = 1; !gaps && i + 1 < all.size(); ++i)
        if (const double d = all[i - 1] - 2.0 * all[i] + all[i + 1]; std::isfinite(d))
          differences.push_back(std::abs(d));
      for (std::size_t i = 1; gaps && i + 1 < v.size(); ++i)
        differences.push_back(std::abs(v[i - 1] - 2.0 * v[i] + v[i + 1]));
      for (std::size_t i = 1; i + 1 < v.size(); ++i) sizes.push_back(std::abs(v[i]));
      resolution = std::max(resolution, last_digit(v));
    }
    double middle = 0.0;
    if (!differences.empty()) {
      std::nth_element(differences.begin(), differences.begin() + static_cast<std::ptrdiff_t>(differences.size() / 2),
                       differences.end());
      middle = differences[differences.size() / 2];
    }
    // Data without any noise would weigh without bound. Nine tenths of the readings say how large they are: one that is wrong
    // says nothing.
    double large = 0.0;
    if (!sizes.empty()) {
      const auto ninth = sizes.begin() + static_cast<std::ptrdiff_t>(9 * (sizes.size() - 1) / 10);
      std::nth_element(sizes.begin(), ninth, sizes.end());
      large = *ninth;
    }
    sigma[c] = std::max({1.4826 * middle / std::sqrt(6.0), resolution / std::sqrt(12.0), 1e-6 * large, 1e-15});
  }
  return sigma;
}

namespace {

// Of the problem's channel c.
bool is_angle(const CalibrationProblem& problem, int c) {
  const int channel = problem.channels[static_cast<std::size_t>(c)];
  return std::string(channel_names()[static_cast<std::size_t>(channel)].si_unit) == "rad";
}

}  // namespace

VecX noise_of_steps(const CalibrationProblem& problem) {
  double clearance = 0.0, length = 0.0;
  for (const CalibrationRun& run : problem.runs) {
    clearance = std::max(clearance, smallest_clearance(run.mechanism->parameters()));
    length = std::max(length, run.mechanism->characteristic_length());
  }
  VecX sigma = VecX::Constant(static_cast<Eigen::Index>(problem.channels.size()), kNoiseOfSteps * clearance);
  for (int c = 0; c < sigma.size(); ++c)
    if (is_angle(problem, c)) sigma[c] /= length;
  return sigma;
}

VecX noise_from_sizes(const CalibrationProblem& problem) {
  const int count = static_cast<int>(problem.channels.size());
  std::vector<double> sizes[2];
  for (int c = 0; c < count; ++c)
    for (std::size_t r = 0; r < problem.runs.size(); ++r)
      if (const int column = problem.column(static_cast<int>(r), c); column >= 0)
        for (const double v : problem.runs[r].data.value.col(column))
          if (std::isfinite(v)) sizes[is_angle(problem, c)].push_back(std::abs(v));
  VecX sigma(count);
  for (int c = 0; c < count; ++c) {
    std::vector<double>& s = sizes[is_angle(problem, c)];
    if (!s.empty()) std::nth_element(s.begin(), s.begin() + static_cast<std::ptrdiff_t>(s.size() / 2), s.end());
    sigma[c] = std::max(s.empty() ? 0.0 : s[s.size() / 2], 1e-15);
  }
  return sigma;
}

// Which instrument reads each channel, by its lowest channel: those that stand in one file of a run are read by one.
static std::vector<int> instruments(const CalibrationProblem& problem) {
  std::vector<int> of(problem.channels.size());
  std::iota(of.begin(), of.end(), 0);
  const auto join = [&](int a, int b) {
    const int from = std::max(of[static_cast<std::size_t>(a)], of[static_cast<std::size_t>(b)]),
              to = std::min(of[static_cast<std::size_t>(a)], of[static_cast<std::size_t>(b)]);
    std::replace(of.begin(), of.end(), from, to);
  };
  const int count = static_cast<int>(of.size());
  for (std::size_t r = 0; r < problem.runs.size(); ++r) {
    const std::vector<std::string>& file_of = problem.runs[r].data.file_of;  // empty: one file
    for (int a = 0; a < count; ++a)
      for (int b = a + 1; b < count; ++b) {
        const int first = problem.column(static_cast<int>(r), a), second = problem.column(static_cast<int>(r), b);
        if (first < 0 || second < 0) continue;
        if (file_of.empty() || file_of[static_cast<std::size_t>(first)] == file_of[static_cast<std::size_t>(second)])
          join(a, b);
      }
  }
  return of;
}

namespace {

struct AlikeChannels {
  std::vector<int> channels;
  double square = 0.0, readings = 0.0;  // square: mean over the readings
  void add(const AlikeChannels& other) {
    square = (square * readings + other.square * other.readings) / (readings + other.readings);
    readings += other.readings;
    channels.insert(channels.end(), other.channels.begin(), other.channels.end());
  }
};

// Puts neighbours by size together as long as `alike` says so of the quieter and the noisier one.
template <typename Alike>
void put_together(std::vector<AlikeChannels>& groups, const Alike& alike) {
  std::sort(groups.begin(), groups.end(),
            [](const AlikeChannels& l, const AlikeChannels& r) { return l.square < r.square; });
  for (std::size_t k = 0; k + 1 < groups.size();) {
    if (alike(groups[k], groups[k + 1])) {
      groups[k].add(groups[k + 1]);
      groups.erase(groups.begin() + static_cast<std::ptrdiff_t>(k) + 1);
      k = k > 0 ? k - 1 : 0;
    } else {
      ++k;
    }
  }
}

}  // namespace

VecX pooled_where_alike(const CalibrationProblem& problem, const VecX& sigma, double apart_by) {
  // Of the logarithm of a noise that is estimated by the median size of n residuals: 1 / (2 n 0.368), Huber (1981), section 5.1.
  constexpr double kVariance = 1.36;
  constexpr double kReadingsOfUnknown = 3.0;  // below, a fit follows the noise itself, and takes it for less and less
  const std::vector<int> instrument = instruments(problem);
  const auto too_few = [&](const AlikeChannels& quieter, const AlikeChannels&) {
    return quieter.readings < kReadingsOfUnknown * problem.global_count();
  };
  const auto alike = [&](const AlikeChannels& quieter, const AlikeChannels& noisier) {
    const double apart = 0.5 * std::log(noisier.square / quieter.square),
                 allowed = apart_by * std::sqrt(kVariance / quieter.readings + kVariance / noisier.readings);
    return apart <= allowed || too_few(quieter, noisier);
  };
  VecX pooled = sigma;
  for (const bool angle : {false, true}) {
    std::vector<AlikeChannels> of_all;
    for (int i = 0; i < sigma.size(); ++i) {
      std::vector<AlikeChannels> of_one;
      for (int c = i; c < sigma.size(); ++c) {
        if (instrument[static_cast<std::size_t>(c)] != i || is_angle(problem, c) != angle) continue;
        AlikeChannels group{{c}, sigma[c] * sigma[c], 0.0};
        for (std::size_t r = 0; r < problem.runs.size(); ++r)
          if (const int column = problem.column(static_cast<int>(r), c); column >= 0)
            for (const double v : problem.runs[r].data.value.col(column))
              group.readings += std::isfinite(v) ? 1.0 : 0.0;
        if (group.readings > 0.0) of_one.push_back(group);
      }
      put_together(of_one, alike);
      of_all.insert(of_all.end(), of_one.begin(), of_one.end());
    }
    put_together(of_all, too_few);
    for (const AlikeChannels& group : of_all)
      for (const int c : group.channels) pooled[c] = std::sqrt(group.square);
  }
  return pooled;
}

// How many unknowns each channel pays for: the trace of its share of the information, which add up to the unknowns that the data determine
// (Foerstner 1979, variance components). A quiet channel among noisy ones pays for nearly all of them. Of poses, which have no start states.
static VecX unknowns_of_channels(const CalibrationProblem& problem, const FitResult& fit) {
  const auto channels = problem.channels.size();
  const int G = problem.global_count();
  std::vector<MatX> share(channels, MatX::Zero(G, G));
  for (std::size_t k = 0; k < fit.windows.size(); ++k) {
    WindowResiduals at;
    problem.evaluate(problem.windows[fit.windows[k]], fit.globals, fit.states[k], true, at);
    for (Eigen::Index i = 0; i < at.r.size(); ++i)
      share[static_cast<std::size_t>(at.channel[i])].noalias() +=
          problem.loss.weight(at.r[i]) * at.by_global.row(i).transpose() * at.by_global.row(i);
  }
  MatX all = problem.prior_information().asDiagonal();
  for (const MatX& one : share) all += one;
  constexpr double kOfRounding = 1e-12;  // what nothing determines costs nothing
  all.diagonal().array() += kOfRounding * all.diagonal().maxCoeff();
  const Eigen::LDLT<MatX> solver(all);
  VecX unknowns(static_cast<Eigen::Index>(channels));
  for (std::size_t c = 0; c < channels; ++c) unknowns[static_cast<Eigen::Index>(c)] = solver.solve(share[c]).trace();
  return unknowns;
}

VecX noise_from_residuals(const CalibrationProblem& problem, const FitResult& fit) {
  std::vector<std::vector<double>> sizes(problem.channels.size());
  int unknowns = problem.global_count();
  for (std::size_t k = 0; k < fit.windows.size(); ++k) {
    const Window& w = problem.windows[fit.windows[k]];
    WindowResiduals at;
    problem.evaluate(w, fit.globals, fit.states[k], false, at);
    unknowns += w.from_rest ? 0 : problem.state_size(w);
    for (Eigen::Index i = 0; i < at.r.size(); ++i) sizes[at.channel[i]].push_back(std::abs(at.r[i]));
  }
  std::size_t all = 0;
  for (const auto& s : sizes) all += s.size();
  VecX sigma = problem.sigma;
  const VecX own = problem.follows_play() ? VecX() : unknowns_of_channels(problem, fit);
  for (std::size_t c = 0; c < sizes.size(); ++c) {
    if (sizes[c].empty()) continue;
    const auto n = static_cast<double>(sizes[c].size());
    std::nth_element(sizes[c].begin(), sizes[c].begin() + static_cast<std::ptrdiff_t>(sizes[c].size() / 2),
                     sizes[c].end());
    const double freedom = own.size() > 0
                               ? n / std::max(1.0, n - own[static_cast<Eigen::Index>(c)])
                               : static_cast<double>(all) / std::max(1.0, static_cast<double>(all) - unknowns);
    // Never far below what differences say: a channel fitted too well is not a quiet one.
    sigma[static_cast<Eigen::Index>(c)] *= std::max(0.5, 1.4826 * sizes[c][sizes[c].size() / 2] * std::sqrt(freedom));
  }
  return sigma;
}

std::vector<OutlyingReading> leave_out_lone_readings(CalibrationProblem& problem) {
  constexpr double kAlone = 1000.0;
  const VecX noise = noise_from_differences(problem);
  std::vector<OutlyingReading> found;
  for (std::size_t r = 0; r < problem.runs.size(); ++r) {
    MeasuredData& data = problem.runs[r].data;
    for (std::size_t c = 0; c < problem.channels.size(); ++c) {
      const int column = problem.column(static_cast<int>(r), static_cast<int>(c));
      if (column < 0) continue;
      std::vector<Eigen::Index> measured;
      for (Eigen::Index i = 0; i < data.value.rows(); ++i)
        if (std::isfinite(data.value(i, column))) measured.push_back(i);
      const auto n = static_cast<std::ptrdiff_t>(measured.size());
      if (n < 6) continue;
      const auto at = [&](std::ptrdiff_t k) { return data.value(measured[static_cast<std::size_t>(k)], column); };
      std::vector<Eigen::Index> alone;
      for (std::ptrdiff_t k = 0; k < n; ++k) {
        // The four measured next to it, at the ends all on one side.
        std::vector<double> next;
        for (std::ptrdiff_t j = std::clamp<std::ptrdiff_t>(k - 2, 0, n - 5); next.size() < 4; ++j)
          if (j != k) next.push_back(at(j));
        const auto [low, high] = std::minmax_element(next.begin(), next.end());
        const double off = std::max(at(k) - *high, *low - at(k));
        if (!(off > kAlone * std::max(*high - *low, noise[static_cast<Eigen::Index>(c)]))) continue;
        const Eigen::Index sample = measured[static_cast<std::size_t>(k)];
        alone.push_back(sample);
        const Origin place = data.origin(sample, column);
        found.push_back({place.file, place.line, problem.channels[c], off / noise[static_cast<Eigen::Index>(c)]});
      }
      for (const Eigen::Index sample : alone) data.value(sample, column) = std::numeric_limits<double>::quiet_NaN();
    }
  }
  return found;
}

std::vector<OutlyingReading> outlying_readings(const CalibrationProblem& problem, const FitResult& fit) {
  constexpr double kOutlying = 10.0;
  struct Reading {
    int run, sample, channel;
    double size;
  };
  std::vector<Reading> all;
  std::vector<std::vector<double>> sizes(problem.channels.size());
  for (std::size_t k = 0; k < fit.windows.size(); ++k) {
    const Window& w = problem.windows[fit.windows[k]];
    WindowResiduals at;
    problem.evaluate(w, fit.globals, fit.states[k], false, at);
    for (Eigen::Index i = 0; i < at.r.size(); ++i) {
      const auto n = static_cast<std::size_t>(i);
      all.push_back({w.run, at.sample[n], at.channel[n], std::abs(at.r[i])});
      sizes[static_cast<std::size_t>(at.channel[n])].push_back(std::abs(at.r[i]));
    }
  }
  std::vector<double> deviation;
  for (std::vector<double>& s : sizes) {
    if (!s.empty()) std::nth_element(s.begin(), s.begin() + static_cast<std::ptrdiff_t>(s.size() / 2), s.end());
    deviation.push_back(s.empty() ? 1.0 : std::max(1.0, 1.4826 * s[s.size() / 2]));
  }
  std::vector<OutlyingReading> found;
  for (const Reading& reading : all) {
    const double deviations = reading.size / deviation[static_cast<std::size_t>(reading.channel)];
    if (!(deviations > kOutlying)) continue;
    const MeasuredData& data = problem.runs[static_cast<std::size_t>(reading.run)].data;
    const Origin at = data.origin(reading.sample, problem.column(reading.run, reading.channel));
    found.push_back({at.file, at.line, problem.channels[static_cast<std::size_t>(reading.channel)], deviations});
  }
  std::sort(found.begin(), found.end(),
            [](const OutlyingReading& a, const OutlyingReading& b) { return a.deviations > b.deviations; });
  return found;
}

}  // namespace boresight
