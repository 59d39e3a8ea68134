#include "boresight_analyses/calibration/multibody_correction.hpp"

#include <algorithm>
#include <cmath>

#include "boresight_analyses/calibration/calibration_fit.hpp"
#include "boresight_analyses/calibration/rig.hpp"

namespace boresight {
namespace {

// Of window w, its samples x the run's channels.
MatX window_readings(const CalibrationProblem& problem, const Window& w, const Globals& at) {
  const CalibrationRun& run = problem.runs[w.run];
  std::vector<double> times;
  for (int i = w.first; i <= w.last; ++i) times.push_back(std::max(0.0, run.data.time[i] + at.time_offset));
  return multibody_readings(run.mechanism, problem.parameters_at(w.run, problem.values(at)), times,
                            run.data.channels);
}

// Less those of the fit's rung, where there are data.
void subtract_own(const CalibrationProblem& plain, const Window& w, const Globals& at, MatX& readings) {
  const CalibrationRun& run = plain.runs[w.run];
  WindowResiduals own;
  plain.evaluate(w, at, VecX::Zero(plain.state_size(w)), false, own);
  for (Eigen::Index i = 0; i < own.r.size(); ++i) {
    const int column = plain.column(w.run, own.channel[i]);
    const double bias = at.bias.size() > 0 ? at.bias[own.channel[i]] : 0.0;
    readings(own.sample[i] - w.first, column) -=
        run.data.value(own.sample[i], column) + own.r[i] * plain.sigma[own.channel[i]] - bias;
  }
}

// At each of the points, per run; zero where no window starts from rest.
std::vector<Readings> at_points(const CalibrationProblem& problem, const std::vector<Globals>& points,
                                bool less_own, int jobs) {
  CalibrationProblem plain = problem;
  plain.corrections.clear();
  Readings none;
  for (const CalibrationRun& run : plain.runs)
    none.push_back(MatX::Zero(run.data.value.rows(), run.data.value.cols()));
  std::vector<Readings> all(points.size(), none);
  const int windows = static_cast<int>(plain.windows.size());
  in_parallel(windows * static_cast<int>(points.size()), jobs, [&](int k) {
    const Window& w = plain.windows[k % windows];
    if (!w.from_rest) return;
    const Globals& point = points[k / windows];
    MatX readings = window_readings(plain, w, point);
    if (less_own) subtract_own(plain, w, point, readings);
    all[k / windows][w.run].middleRows(w.first, w.last - w.first + 1) = readings;
  });
  return all;
}

}  // namespace

Readings multibody_difference(const CalibrationProblem& problem, const Globals& at, int jobs) {
  return at_points(problem, {at}, true, jobs).front();
}

std::vector<std::vector<MatX>> multibody_slopes(const CalibrationProblem& problem, const Globals& at,
                                                const VecX& step, int jobs) {
  const int P = problem.parameter_count();
  std::vector<Globals> points;
  for (int p = 0; p < P; ++p)
    for (const double side : {1.0, -1.0}) {
      if (!(step[p] > 0.0)) continue;
      Globals moved = at;
      moved.u[p] = std::clamp(at.u[p] + side * step[p], problem.parameters[p].lowest_coordinate(),
                              problem.parameters[p].highest_coordinate());
      points.push_back(moved);
    }
  const std::vector<Readings> readings = at_points(problem, points, false, jobs);
  std::vector<std::vector<MatX>> slopes(problem.runs.size());
  for (std::size_t r = 0; r < problem.runs.size(); ++r) {
    const MatX& value = problem.runs[r].data.value;
    slopes[r].assign(P, MatX::Zero(value.rows(), value.cols()));
    for (int p = 0, k = 0; p < P; ++p) {
      if (!(step[p] > 0.0)) continue;
      slopes[r][p] = (readings[k][r] - readings[k + 1][r]) / (points[k].u[p] - points[k + 1].u[p]);
      k += 2;
    }
  }
  return slopes;
}

CorrectionSize size_of(const CalibrationProblem& problem, const Globals& at, const Readings& difference) {
  CalibrationProblem multibody = problem;
  multibody.corrections.clear();
  for (const MatX& offset : difference) multibody.corrections.push_back({at.u, offset, {}});
  CorrectionSize size;
  long count = 0;
  for (const Window& w : problem.windows) {
    if (!w.from_rest) continue;
    WindowResiduals residuals;
    multibody.evaluate(w, at, VecX::Zero(problem.state_size(w)), false, residuals);
    count += residuals.r.size();
    for (Eigen::Index i = 0; i < residuals.r.size(); ++i) {
      const int channel = residuals.channel[i];
      size.confirmation += std::pow(problem.loss.residual(residuals.r[i]), 2);
      size.difference += std::pow(
          difference[w.run](residuals.sample[i], problem.column(w.run, channel)) / problem.sigma[channel], 2);
    }
  }
  size.confirmation = std::sqrt(size.confirmation / static_cast<double>(std::max(1L, count)));
  size.difference = std::sqrt(size.difference / static_cast<double>(std::max(1L, count)));
  return size;
}

}  // namespace boresight
