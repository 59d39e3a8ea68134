#include "boresight_analyses/calibration/multibody_correction.hpp"

#include <algorithm>
#include <cmath>

#include "boresight_analyses/calibration/kept_fits.hpp"
#include "boresight_analyses/calibration/rig.hpp"

namespace boresight {
namespace {

CalibrationProblem without_corrections(const CalibrationProblem& problem) {
  CalibrationProblem plain = problem;
  plain.corrections.clear();
  return plain;
}

Readings zeros_for(const CalibrationProblem& problem) {
  Readings zeros;
  for (const CalibrationRun& run : problem.runs)
    zeros.push_back(MatX::Zero(run.data.value.rows(), run.data.value.cols()));
  return zeros;
}

// Of window w, its samples x the run's channels.
MatX window_readings(const CalibrationProblem& problem, const Window& w, const Globals& at) {
  const CalibrationRun& run = problem.runs[w.run];
  std::vector<double> times = problem.reading_times(w, at);
  return kept_or_computed<MatX>(
      problem.kept, CalibrationKey("multibody", problem).add(w.run, w.first, w.last, at).value(), [&] {
        return problem.mean_readings(
            w, at,
            multibody_readings(run.mechanism, problem.parameters_at(w.run, problem.values(at)), times,
                               run.data.channels, run.data.place_B, run.implicit_steps));
      });
}

}  // namespace

MultibodyAt multibody_at(const CalibrationProblem& problem, const Globals& at, int jobs) {
  const CalibrationProblem plain = without_corrections(problem);
  MultibodyAt out{zeros_for(plain), zeros_for(plain), zeros_for(plain), zeros_for(plain), {}};
  out.motion.resize(plain.runs.size());
  for_each_on_threads(static_cast<int>(plain.windows.size()), jobs, [&](int k) {
    const Window& w = plain.windows[k];
    if (!w.from_rest) return;
    const MeasuredData& data = plain.runs[w.run].data;
    const MatX readings = window_readings(plain, w, at);
    out.reading[w.run].middleRows(w.first, w.last - w.first + 1) = readings;
    WindowResiduals own;
    plain.evaluate(w, at, VecX::Zero(plain.state_size(w)), true, own);
    for (Eigen::Index i = 0; i < own.r.size(); ++i) {
      const int sample = own.sample[i], channel = own.channel[i], column = plain.column(w.run, channel);
      const double bias = at.offset_at(plain.offset_index(w.run, channel), data.time[sample]);
      const double model = data.value(sample, column) + own.r[i] * plain.sigma[channel] - bias;
      out.difference[w.run](sample, column) = readings(sample - w.first, column) - model;
      if (plain.fit_time_offset)
        out.by_time[w.run](sample, column) = own.by_global(i, plain.time_offset_column()) * plain.sigma[channel];
      if (plain.fit_lag)
        out.by_lag[w.run](sample, column) = own.by_global(i, plain.lag_column()) * plain.sigma[channel];
    }
    out.motion[w.run] = std::move(own.motion);
  });
  return out;
}

std::vector<std::vector<MatX>> multibody_slopes(const CalibrationProblem& problem, const Globals& at, const VecX& step,
                                                int jobs) {
  const CalibrationProblem plain = without_corrections(problem);
  const int P = plain.parameter_count(), windows = static_cast<int>(plain.windows.size());
  std::vector<std::vector<MatX>> slopes;
  for (const MatX& zeros : zeros_for(plain)) slopes.emplace_back(P, zeros);
  for_each_on_threads(windows * P, jobs, [&](int k) {
    const Window& w = plain.windows[k % windows];
    const int p = k / windows;
    if (!w.from_rest || !(step[p] > 0.0)) return;
    const auto moved = [&](double by) {
      Globals there = at;
      there.u[p] =
          std::clamp(at.u[p] + by, plain.parameters[p].lowest_coordinate(), plain.parameters[p].highest_coordinate());
      return there;
    };
    const Globals more = moved(step[p]), less = moved(-step[p]);
    slopes[w.run][p].middleRows(w.first, w.last - w.first + 1) =
        (window_readings(plain, w, more) - window_readings(plain, w, less)) / (more.u[p] - less.u[p]);
  });
  return slopes;
}

CorrectionSize size_of(const CalibrationProblem& problem, const Globals& at, const MultibodyAt& multibody) {
  CorrectionSize size;
  long count = 0;
  for (const Window& w : problem.windows) {
    if (!w.from_rest) continue;
    for (int c = 0; c < static_cast<int>(problem.channels.size()); ++c) {
      const int column = problem.column(w.run, c);
      if (column < 0) continue;
      for (int i = w.first; i <= w.last; ++i) {
        const double measured = problem.runs[w.run].data.value(i, column);
        if (!std::isfinite(measured)) continue;
        const double r = (multibody.reading[w.run](i, column) +
                          at.offset_at(problem.offset_index(w.run, c), problem.runs[w.run].data.time[i]) - measured) /
                         problem.sigma[c];
        size.confirmation += std::pow(problem.loss.residual(r), 2);
        size.difference += std::pow(multibody.difference[w.run](i, column) / problem.sigma[c], 2);
        ++count;
      }
    }
  }
  size.confirmation = std::sqrt(size.confirmation / static_cast<double>(std::max(1L, count)));
  size.difference = std::sqrt(size.difference / static_cast<double>(std::max(1L, count)));
  return size;
}

}  // namespace boresight
