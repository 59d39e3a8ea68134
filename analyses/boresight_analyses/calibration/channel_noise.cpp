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

// In one round a noise falls to no less than this share: a channel that is fitted too well is not a quiet one.
constexpr double kLeastLeft = 0.5;

// Readings beyond those that the unknowns may follow, from which a channel has a noise of its own: with four degrees of freedom and less, the
// ratio by which Kenward and Roger (1997) match errors has no variance.
constexpr double kLeastLeftOver = 5.0;

// Of an information: how many unknowns a part of it pays for.
class Unknowns {
 public:
  explicit Unknowns(MatX all) {
    constexpr double kOfRounding = 1e-12;  // what nothing determines costs nothing
    // Unknowns are of different units.
    unit_ = all.diagonal().unaryExpr([](double h) { return h > 0.0 ? 1.0 / std::sqrt(h) : 1.0; });
    all = unit_.asDiagonal() * all * unit_.asDiagonal();
    all.diagonal().array() += kOfRounding;
    solver_.compute(all);
  }
  double in(const MatX& part) const { return solver_.solve(unit_.asDiagonal() * part * unit_.asDiagonal()).trace(); }

 private:
  VecX unit_;
  Eigen::LDLT<MatX> solver_;
};

}  // namespace

namespace {

// What a fit leaves of channels that share a noise.
struct Left {
  std::vector<int> channels;
  MatX information;  // at the problem's own sigma
  double values = 0.0, square = 0.0,
         redundancy = 0.0;  // square: of all readings [SI^2]; redundancy: readings less what they pay of the unknowns

  double variance() const { return square / std::max(1.0, redundancy); }
  void add(const Left& other) {
    channels.insert(channels.end(), other.channels.begin(), other.channels.end());
    information += other.information;
    values += other.values;
    square += other.square;
    redundancy += other.redundancy;
  }
};

// Sum of the squares of residuals of unit noise, of which outliers count as no more than so many deviations of them; infinite: all in full. The
// size of the residuals is known by their median, and the clipped squares made up for as a normal distribution asks (Huber 1981, section 5.2,
// one step).
double square_of(std::vector<double> sizes, double deviations) {
  double sum = 0.0;
  if (std::isinf(deviations)) {
    for (const double r : sizes) sum += r * r;
    return sum;
  }
  const auto middle = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2);
  std::nth_element(sizes.begin(), middle, sizes.end());
  const double most = deviations * std::max(kLeastLeft, 1.4826 * *middle);
  for (const double r : sizes) sum += std::min(r * r, most * most);
  const double beyond = std::erfc(deviations / std::sqrt(2.0)),
               density = std::exp(-0.5 * deviations * deviations) / std::sqrt(2.0 * M_PI);
  return sum / (1.0 - beyond - 2.0 * deviations * density + deviations * deviations * beyond);
}

// Of each channel that has readings; it stands under its number.
std::vector<Left> left_by_channel(const CalibrationProblem& problem, const FitResult& fit) {
  const int G = problem.global_count();
  std::vector<Left> left(problem.channels.size());
  std::vector<std::vector<double>> sizes(left.size());
  for (std::size_t c = 0; c < left.size(); ++c) left[c] = {{static_cast<int>(c)}, MatX::Zero(G, G)};
  for (std::size_t k = 0; k < fit.windows.size(); ++k) {
    WindowResiduals at;
    problem.evaluate(problem.windows[fit.windows[k]], fit.globals, fit.states[k], true, at);
    for (Eigen::Index i = 0; i < at.r.size(); ++i) {
      const auto c = static_cast<std::size_t>(at.channel[static_cast<std::size_t>(i)]);
      sizes[c].push_back(std::abs(at.r[i]));
      left[c].information.noalias() +=
          problem.loss.weight(at.r[i]) * at.by_global.row(i).transpose() * at.by_global.row(i);
    }
  }
  MatX all = problem.prior_information().asDiagonal();
  for (const Left& one : left) all += one.information;
  const Unknowns unknowns(all);
  const double clipped = problem.loss.kind == Loss::none    ? std::numeric_limits<double>::infinity()
                         : problem.loss.kind == Loss::huber ? problem.loss.scale
                                                            : ResidualLoss{}.scale;
  for (std::size_t c = 0; c < left.size(); ++c) {
    if (sizes[c].empty()) continue;
    left[c].values = static_cast<double>(sizes[c].size());
    // Each pays for the trace of its share of the information; these add up to the unknowns that the data determine (Foerstner 1979, variance
    // components). A quiet channel among noisy ones pays for nearly all of them.
    left[c].redundancy = left[c].values - unknowns.in(left[c].information);
    left[c].square = std::pow(problem.sigma[static_cast<Eigen::Index>(c)], 2) * square_of(std::move(sizes[c]), clipped);
  }
  return left;
}

// How many readings are left over where nothing but these tell the unknowns.
double left_over_alone(const CalibrationProblem& problem, const Left& left) {
  return left.values - Unknowns(left.information + MatX(problem.prior_information().asDiagonal())).in(left.information);
}

// To whom those go that have too few readings to tell a noise of their own: to the next noisier channels of their unit, first of their instrument.
// -1: there are none.
int next_noisier(const CalibrationProblem& problem, const std::vector<Left>& left, std::size_t of) {
  const std::vector<int> instrument = instruments(problem);
  const auto read_by = [&](const Left& one) { return instrument[static_cast<std::size_t>(one.channels.front())]; };
  int found = -1;
  const auto better = [&](std::size_t k) {
    if (found < 0) return true;
    const Left& other = left[static_cast<std::size_t>(found)];
    const bool ours = read_by(left[k]) == read_by(left[of]), its = read_by(other) == read_by(left[of]);
    return ours != its ? ours : left[k].variance() < other.variance();
  };
  for (std::size_t k = 0; k < left.size(); ++k)
    if (k != of && left[k].variance() >= left[of].variance() &&
        is_angle(problem, left[k].channels.front()) == is_angle(problem, left[of].channels.front()) && better(k))
      found = static_cast<int>(k);
  return found;
}

}  // namespace

ChannelNoises noises_from_residuals(const CalibrationProblem& problem, const FitResult& fit,
                                    const std::vector<bool>& told, const std::vector<int>& shared) {
  ChannelNoises out{problem.sigma, std::vector<int>(problem.channels.size(), -1)};
  std::vector<Left> of_channel = left_by_channel(problem, fit), left;
  std::vector<int> place(of_channel.size(), -1);  // in `left`, by the number that they shared
  for (std::size_t c = 0; c < of_channel.size(); ++c) {
    if (told[c] || of_channel[c].values == 0.0) continue;
    int& at = place[shared.empty() ? c : static_cast<std::size_t>(shared[c])];
    if (at >= 0) {
      left[static_cast<std::size_t>(at)].add(of_channel[c]);
    } else {
      at = static_cast<int>(left.size());
      left.push_back(std::move(of_channel[c]));
    }
  }
  for (std::size_t k = 0; k < left.size();) {
    const int other = left_over_alone(problem, left[k]) < kLeastLeftOver ? next_noisier(problem, left, k) : -1;
    if (other < 0) {
      ++k;
      continue;
    }
    left[k].add(left[static_cast<std::size_t>(other)]);
    left.erase(left.begin() + other);
    k = 0;
  }
  for (std::size_t k = 0; k < left.size(); ++k)
    for (const int c : left[k].channels) {
      out.shared[static_cast<std::size_t>(c)] = static_cast<int>(k);
      // Slowly: what a first fit with other weights leaves of a quiet channel is not its own.
      out.sigma[c] = std::max(kLeastLeft * problem.sigma[c], std::sqrt(left[k].variance()));
    }
  return out;
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
  const double freedom = static_cast<double>(all) / std::max(1.0, static_cast<double>(all) - unknowns);
  for (std::size_t c = 0; c < sizes.size(); ++c) {
    if (sizes[c].empty()) continue;
    std::nth_element(sizes[c].begin(), sizes[c].begin() + static_cast<std::ptrdiff_t>(sizes[c].size() / 2),
                     sizes[c].end());
    // Never far below what differences say: a channel fitted too well is not a quiet one.
    sigma[static_cast<Eigen::Index>(c)] *=
        std::max(kLeastLeft, 1.4826 * sizes[c][sizes[c].size() / 2] * std::sqrt(freedom));
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
