#include "boresight_analyses/calibration/next_test.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "boresight/math/dense_solves.hpp"
#include "boresight/mechanism/error.hpp"

namespace boresight {

namespace {

double log_determinant(const MatX& information) {
  const Eigen::LLT<MatX> root(information);
  return 2.0 * MatX(root.matrixL()).diagonal().array().log().sum();
}

// A run that has offsets of its own tells the others of what it shares with them alone: what is left of `shared` globals with the offsets
// behind them unknown, as a part of all G.
MatX without_own_offsets(const MatX& information, Eigen::Index shared, Eigen::Index G) {
  const Eigen::Index own = information.rows() - shared;
  MatX all = MatX::Zero(G, G);
  const MatX across = information.topRightCorner(shared, own);
  all.topLeftCorner(shared, shared) =
      information.topLeftCorner(shared, shared) -
      across * solve_least(MatX(information.bottomRightCorner(own, own)), MatX(across.transpose()));
  return all;
}

}  // namespace

NextTest judge_candidate(const CalibrationProblem& problem, const Inference& inference, const Globals& globals,
                         const std::vector<bool>& fixed, const Candidate& candidate) {
  const int G = problem.global_count(), P = problem.parameter_count();
  std::vector<int> free;
  for (int g = 0; g < G; ++g)
    if (g >= P || !fixed[g]) free.push_back(g);
  const auto part = [&](const MatX& H) {
    MatX out(free.size(), free.size());
    for (std::size_t a = 0; a < free.size(); ++a)
      for (std::size_t b = 0; b < free.size(); ++b) out(a, b) = H(free[a], free[b]);
    return MatX(out + 1e-8 * MatX::Identity(out.rows(), out.cols()));
  };
  NextTest test{candidate.name, 0.0, 0.0, {}, ""};
  if (free.empty()) {
    test.refusal = "no parameter is left to learn of";
    return test;
  }
  // Of the noise that the data show; what was known before is known as well as it was told.
  const MatX prior = problem.prior_information().asDiagonal();
  const auto known = [&](const MatX& weighed) { return MatX((weighed - prior) / inference.variance_factor + prior); };
  const MatX H = part(known(inference.information));
  const MatX before = H.inverse();
  try {
    CalibrationProblem one = problem;
    MeasuredData data;
    double readings = 0.0;
    for (const CalibrationRun& run : problem.runs) readings += static_cast<double>(run.data.time.size());
    readings = std::max(2.0, readings / static_cast<double>(problem.runs.size()));
    const double step = problem.follows_play() ? 1e-3 : candidate.mechanism->duration() / (readings - 1.0);
    for (double t = 0.0; t <= candidate.mechanism->duration() * (1.0 + 1e-12); t += step) {
      data.time.push_back(std::min(t, candidate.mechanism->duration()));
      data.line.push_back(0);
    }
    data.channels = problem.channels;
    for (std::size_t c = 0; c < problem.channels.size(); ++c) {
      std::size_t run = 0;
      while (run + 1 < problem.runs.size() && problem.column(static_cast<int>(run), static_cast<int>(c)) < 0) ++run;
      data.place_B.push_back(problem.runs[run].data.place_of(problem.channels[c]));
    }
    data.value =
        MatX::Zero(static_cast<Eigen::Index>(data.time.size()), static_cast<Eigen::Index>(data.channels.size()));
    one.runs = {CalibrationRun(candidate.name, candidate.mechanism, data)};
    one.corrections.clear();
    one.loss.kind = Loss::none;
    const double length = problem.windows.front().end - problem.windows.front().start;
    one.prepare(problem.windows.front().from_rest ? std::max(length, data.time.back()) : length, true);
    Globals there = globals;
    if (problem.offsets_per_run) {
      there.bias = one.start().bias;
      there.drift = one.start().drift;
    }
    MatX of_test = MatX::Zero(one.global_count(), one.global_count());
    for (const Window& w : one.windows) {
      WindowResiduals at;
      one.evaluate(w, there, VecX::Zero(one.state_size(w)), true, at);
      of_test += window_information(one, w, at).information;
    }
    const MatX more = problem.offsets_per_run ? without_own_offsets(of_test, one.bias_column(), G) : of_test;
    const MatX with = part(known(inference.information + more)), after = with.inverse();
    // Of many parameters the determinants themselves leave what a double holds.
    test.d_gain = log_determinant(with) - log_determinant(H);
    double sum_before = 0.0, sum_after = 0.0;
    for (std::size_t a = 0; a < free.size(); ++a) {
      if (free[a] >= P) continue;
      const auto i = static_cast<Eigen::Index>(a);
      const FittedParameter& parameter = problem.parameters[free[a]];
      const double u = globals.u[free[a]], size = parameter.is_error() ? parameter.size : parameter.value(u);
      const double relative = std::pow(parameter.slope(u) / size, 2);
      sum_before += relative * before(i, i);
      sum_after += relative * after(i, i);
      test.error_ratio.push_back(std::sqrt(after(i, i) / before(i, i)));
    }
    test.a_ratio = sum_after / sum_before;
  } catch (const ComputationError& fault) {
    test.refusal = fault.what();
  }
  return test;
}

}  // namespace boresight
