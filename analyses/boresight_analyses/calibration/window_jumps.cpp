// How a window's readings follow jumps of its state on the way.
#include <algorithm>
#include <cmath>

#include "boresight_analyses/calibration/calibration_problem.hpp"

namespace boresight {
namespace {

// A motion that is begun anew amid a contact has forgotten how fast that contact began. Where it then ends farther from the unbroken one
// than this, in the scales of the state, it is begun at an earlier sample. Steps of 1e-7 leave a tenth of it.
constexpr double kSamePlace = 1e-5;

}  // namespace

MatX CalibrationProblem::by_jumps(const Window& w, const Globals& globals, int jumps) const {
  const CalibrationRun& run = runs[w.run];
  const int n = freedoms(w.run), n2 = 2 * n, samples = w.last - w.first + 1;
  const std::vector<double> theta = values(globals);
  const VecX scale = state_scale(w);
  std::vector<double> times;
  for (int i = w.first; i <= w.last; ++i)
    times.push_back(std::clamp(run.data.time[i] + globals.time_offset - globals.lag, w.start, w.end));
  const MatX unbroken = follow(w, theta, VecX::Zero(n2), times, false).state;
  const Parameters parameters_here = parameters_at(w.run, theta);
  const ContactNumbers numbers = contact_numbers_at(w.run, theta);
  const std::shared_ptr<const SceneTables> tables = tables_at(w.run, theta);
  MotionRequest request;
  set_start(w, theta, VecX::Zero(n2), false, request);
  request.tolerance = tolerance;
  request.implicit = run.implicit_steps;
  const auto stretch = [&](int from, int to, bool derivatives) {
    MotionRequest part = request;
    if (from > 0) {
      part.start = times[from];
      part.start_state = unbroken.col(from);
    }
    part.times.assign(times.begin() + from, times.begin() + to + 1);
    part.end = times[to];
    part.by_start_state = derivatives;
    part.derivative_tolerance = derivatives ? derivative_tolerance : 0.0;
    return follow_with_sensitivity(*run.mechanism, parameters_here, tables, numbers, part);
  };
  const int step = std::max(2, samples / jumps);
  std::vector<int> begins = {0};
  for (int wanted = step; wanted + step / 2 < samples; wanted += step)
    for (int from = wanted; from > wanted - step / 2; from -= std::max(1, step / 6)) {
      const int to = std::min(wanted + step, samples - 1);
      const VecX reached = stretch(from, to, false).state.rightCols(1);
      if (!((reached - unbroken.col(to)).cwiseQuotient(scale).lpNorm<Eigen::Infinity>() < kSamePlace)) continue;
      begins.push_back(from);
      break;
    }
  // grown: how the state at the beginning of a stretch follows each jump before it.
  std::vector<MatX> grown, by(static_cast<std::size_t>(samples));
  for (std::size_t s = 0; s < begins.size(); ++s) {
    const int from = begins[s], to = s + 1 < begins.size() ? begins[s + 1] : samples - 1;
    grown.push_back(scale.asDiagonal());
    const SensitiveMotion part = stretch(from, to, true);
    for (int i = from; i <= to; ++i) {
      MatX& here = by[static_cast<std::size_t>(i)];
      here.resize(n, n2 * static_cast<Eigen::Index>(grown.size()));
      for (std::size_t k = 0; k < grown.size(); ++k)
        here.middleCols(n2 * static_cast<Eigen::Index>(k), n2) =
            part.by[static_cast<std::size_t>(i - from)].topRows(n) * grown[k];
    }
    for (MatX& g : grown) g = part.by.back() * g;
  }
  MatX out =
      MatX::Zero(samples * static_cast<Eigen::Index>(channels.size()), n2 * static_cast<Eigen::Index>(begins.size()));
  Eigen::Index m = 0;
  ChannelRows at;
  for (int c = 0; c < static_cast<int>(channels.size()); ++c) {
    const int column_here = column(w.run, c);
    if (column_here < 0) continue;
    for (int i = 0; i < samples; ++i) {
      if (!std::isfinite(run.data.value(w.first + i, column_here))) continue;
      channel_rows(run, channels[c], times[static_cast<std::size_t>(i)], n, at);
      const Vec3 vector = at.rows * unbroken.col(i).head(n);
      const Vec3 along = at.size ? Vec3(vector / std::max(vector.norm(), 1e-12)) : Vec3::UnitX();
      const MatX& here = by[static_cast<std::size_t>(i)];
      out.row(m++).head(here.cols()) = along.transpose() * at.rows * here / sigma[c];
    }
  }
  return out.topRows(m);
}

}  // namespace boresight
