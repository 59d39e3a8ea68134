// The start state of a window that does not begin at rest.
#include <algorithm>
#include <cmath>

#include "boresight/mechanism/error.hpp"
#include "boresight/rungs/integrator_choice.hpp"
#include "boresight_analyses/calibration/calibration_problem.hpp"

namespace boresight {

double CalibrationProblem::refine_state(const Window& w, const Globals& globals, VecX& state,
                                        int most_iterations) const {
  const VecX prior = prior_deviation(w);
  double here = cost(w, globals, state), damping = 1e-3;
  if (!std::isfinite(here)) return here;
  WindowResiduals at;
  for (int k = 0; k < most_iterations; ++k) {
    try {
      evaluate(w, globals, state, true, at);
    } catch (const ComputationError&) {
      break;  // with slopes, which steps have to follow too, a motion may not be followed that is without
    }
    MatX H = prior.cwiseAbs2().cwiseInverse().asDiagonal();
    VecX g = -state.cwiseQuotient(prior.cwiseAbs2());
    for (Eigen::Index i = 0; i < at.r.size(); ++i) {
      const double slope = loss.slope(at.r[i]);
      H.noalias() += slope * slope * at.by_state.row(i).transpose() * at.by_state.row(i);
      g.noalias() -= loss.residual(at.r[i]) * slope * at.by_state.row(i).transpose();
    }
    const double before = here;
    for (int trial = 0; trial < 6; ++trial) {
      MatX damped = H;
      damped.diagonal() *= 1.0 + damping;
      const VecX moved = state + damped.ldlt().solve(g);
      const double there = cost(w, globals, moved);
      damping *= there < here ? 0.1 : 10.0;
      if (!(there < here)) continue;
      state = moved;
      here = there;
      break;
    }
    if (!(here < before * (1.0 - 1e-3))) break;
  }
  return here;
}

VecX CalibrationProblem::state_at(const Window& w, const Globals& globals, const VecX& state, double t) const {
  const CalibrationRun& run = runs[w.run];
  const std::vector<double> theta = values(globals);
  MotionRequest request;
  request.start = w.start;
  request.end = t;
  request.times = {t};
  set_start(w, theta, state, false, request);
  request.tolerance = tolerance;
  request.implicit = run.implicit_steps;
  return follow_with_sensitivity(*run.mechanism, parameters_at(w.run, theta), tables_at(w.run, theta),
                                 contact_numbers_at(w.run, theta), request)
      .state.col(0)
      .cwiseQuotient(state_scale(w));
}

VecX CalibrationProblem::guess_state(const Window& window, const Globals& globals, const VecX& carried) const {
  // Some fits lead deep into a contact, and what it throws back goes to and fro for as many steps as one lets it.
  // An implicit step is as dear as several.
  constexpr long kFewSteps = 20'000, kFewImplicit = 5'000, kTimesAtRest = 20;
  Window w = window;
  if (!w.from_rest) {
    w.most_steps = runs[w.run].implicit_steps ? kFewImplicit : kFewSteps;
    try {
      w.most_steps +=
          kTimesAtRest * follow(window, values(globals), VecX::Zero(state_size(window)), {window.end}, false).steps;
    } catch (const ComputationError&) {
    }
  }
  const CalibrationRun& run = runs[w.run];
  const int n = freedoms(w.run), samples = w.last - w.first + 1;
  const VecX scale = state_scale(w), prior = prior_deviation(w);
  if (w.from_rest) return VecX::Zero(2 * n);
  constexpr int kSteps = 8;
  VecX best = carried.size() > 0 ? carried : VecX(VecX::Zero(2 * n));
  double best_cost = refine_state(w, globals, best, kSteps);
  // z(t) = a + b tau + c tau^2 over the first samples, by reweighted least squares.
  for (const auto& [count, powers] : {std::pair{4, 2}, {6, 2}, {6, 3}, {10, 3}, {16, 3}}) {
    const int used = std::min(count, samples);
    if (used < powers) continue;
    const int unknowns = powers * n;
    VecX x = VecX::Zero(unknowns);
    for (int pass = 0; pass < 4; ++pass) {
      MatX H = MatX::Zero(unknowns, unknowns);
      VecX g = VecX::Zero(unknowns);
      for (int k = 0; k < powers; ++k)
        for (int j = 0; j < n; ++j)
          H(k * n + j, k * n + j) = 1.0 / (k == 0 ? prior[j] * prior[j] : prior[n + j] * prior[n + j]);
      for (int c = 0; c < static_cast<int>(channels.size()); ++c) {
        const int column_here = column(w.run, c);
        if (column_here < 0 || channels[c] >= 9) continue;
        for (int i = 0; i < used; ++i) {
          const double measured = run.data.value(w.first + i, column_here);
          if (!std::isfinite(measured)) continue;
          const double t = run.data.time[w.first + i] + globals.time_offset, tau = (t - w.start) / kFlightTime;
          ChannelRows at;
          channel_rows(run, channels[c], t, n, at);
          Eigen::RowVectorXd row(unknowns);
          for (int k = 0; k < powers; ++k)
            row.segment(k * n, n) = at.rows.row(0) * scale[0] / sigma[c] * std::pow(tau, k);
          const double bias = globals.offset_at(offset_index(w.run, c), run.data.time[w.first + i]);
          const double y = (measured - bias) / sigma[c], r = std::abs(y - row.dot(x));
          const double weight = pass > 0 && r > 3.0 ? 3.0 / r : 1.0;
          H += weight * row.transpose() * row;
          g += weight * y * row.transpose();
        }
      }
      x = H.ldlt().solve(g);
    }
    VecX state = VecX::Zero(2 * n);
    state.head(n) = x.head(n);
    state.tail(n) = x.segment(n, n);
    const double here = refine_state(w, globals, state, kSteps);
    if (here < best_cost) {
      best_cost = here;
      best = state;
    }
  }
  return best;
}

}  // namespace boresight
