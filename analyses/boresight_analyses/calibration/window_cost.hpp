// A calibration's windows as the solver sees them: the residuals of each, and all motions followed together before it asks for any.
#pragma once

#include <ceres/ceres.h>

#include <chrono>
#include <functional>
#include <utility>
#include <vector>

#include "boresight/mechanism/error.hpp"
#include "boresight_analyses/calibration/kept_fits.hpp"
#include "boresight_analyses/threads/on_threads.hpp"

namespace boresight {

// What a global counts in within the fit: parameters as they are, times in ms, biases and drifts in standard deviations.
inline VecX units_of(const CalibrationProblem& problem) {
  VecX units = VecX::Ones(problem.global_count());
  units.segment(problem.time_offset_column(), problem.bias_column() - problem.time_offset_column()).setConstant(1e-3);
  for (std::size_t k = 0; k < problem.offsets.size(); ++k) {
    const double sigma = problem.sigma[problem.offsets[k].channel];
    if (problem.fit_bias) units[problem.bias_column() + static_cast<int>(k)] = sigma;
    if (problem.fit_drift) units[problem.drift_column() + static_cast<int>(k)] = sigma;
  }
  return units;
}

// First column and width of each block of globals: one per parameter, [time offset], [lag], [biases], [drifts].
inline std::vector<std::pair<int, int>> blocks_of(const CalibrationProblem& problem) {
  std::vector<std::pair<int, int>> blocks;
  for (int g = 0; g < problem.bias_column(); ++g) blocks.emplace_back(g, 1);
  const int offsets = static_cast<int>(problem.offsets.size());
  for (int g = problem.bias_column(); g < problem.global_count(); g += offsets) blocks.emplace_back(g, offsets);
  return blocks;
}

// Residuals of one window. Parameter blocks: those of blocks_of(), [start state].
class WindowCost final : public ceres::CostFunction {
 public:
  // What the solver asks of a motion that was followed, or could not be.
  struct Followed {
    bool at_all = false;
    VecX r;
    MatX by_global, by_state;
  };

  WindowCost(const CalibrationProblem& problem, const Window& window, int residuals)
      : problem_(problem),
        window_(window),
        values_(residuals - problem.state_size(window)),
        units_(units_of(problem)),
        globals_(blocks_of(problem)) {
    for (const auto& [first, width] : globals_) mutable_parameter_block_sizes()->push_back(width);
    if (problem.state_size(window) > 0) mutable_parameter_block_sizes()->push_back(problem.state_size(window));
    set_num_residuals(residuals);
  }

  // Follows the window's motion at these blocks, for the Evaluate() that comes next.
  void prepare(const std::vector<double*>& blocks, bool derivatives) {
    const int size = problem_.state_size(window_);
    VecX packed(problem_.global_count());
    for (std::size_t b = 0; b < globals_.size(); ++b)
      packed.segment(globals_[b].first, globals_[b].second) = Eigen::Map<const VecX>(blocks[b], globals_[b].second);
    const Globals globals = problem_.unpacked(packed.cwiseProduct(units_));
    const VecX state = size > 0 ? VecX(Eigen::Map<const VecX>(blocks.back(), size)) : VecX();
    WindowResiduals motion;
    at_.at_all = true;
    try {
      problem_.evaluate(window_, globals, state, derivatives, motion);
    } catch (const ComputationError&) {
      at_.at_all = false;
    }
    at_.r = std::move(motion.r);
    at_.by_global = std::move(motion.by_global);
    at_.by_state = std::move(motion.by_state);
  }
  const Followed& followed() const { return at_; }
  void refuse() { at_.at_all = false; }
  void take(Followed at) { at_ = std::move(at); }

  bool Evaluate(double const* const* blocks, double* residuals, double** jacobians) const override {
    if (!at_.at_all) return false;
    const Followed& at = at_;
    const int size = problem_.state_size(window_);
    const int count = static_cast<int>(parameter_block_sizes().size()), last = size > 0 ? count - 1 : count;
    const VecX state = size > 0 ? VecX(Eigen::Map<const VecX>(blocks[last], size)) : VecX(),
               prior = problem_.prior_deviation(window_);
    for (int i = 0; i < values_; ++i) residuals[i] = problem_.loss.residual(at.r[i]);
    for (int i = 0; i < size; ++i) residuals[values_ + i] = state[i] / prior[i];
    if (!jacobians) return true;
    VecX slope(values_);
    for (int i = 0; i < values_; ++i) slope[i] = problem_.loss.slope(at.r[i]);
    using Rows = Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>;
    for (int b = 0, column = 0; b < count; ++b) {
      const int width = parameter_block_sizes()[b];
      if (jacobians[b]) {
        Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> J = MatX::Zero(num_residuals(), width);
        if (b == last) {
          J.topRows(values_) = slope.asDiagonal() * at.by_state;
          J.bottomRows(size) = prior.cwiseInverse().asDiagonal();
        } else {
          J.topRows(values_) =
              slope.asDiagonal() * at.by_global.middleCols(column, width) * units_.segment(column, width).asDiagonal();
        }
        if (width == 1)
          Eigen::Map<VecX>(jacobians[b], num_residuals()) = J.col(0);
        else
          Rows(jacobians[b], num_residuals(), width) = J;
      }
      column += width;
    }
    return true;
  }

 private:
  const CalibrationProblem& problem_;
  const Window& window_;
  int values_;
  VecX units_;
  std::vector<std::pair<int, int>> globals_;
  Followed at_;
};

inline void fields(Numbers& n, WindowCost::Followed& f) { n(f.at_all, f.r, f.by_global, f.by_state); }

// All windows at once, each on the thread that is free, before the solver adds them up in their order on one: sums of several threads hang
// on which of them was faster, and a fit among narrow optima on the last bit of a sum.
//
// Evaluations that take long are kept until the fit is, so that a start that goes on loses one of them at most, and not a fit.
class AllWindows final : public ceres::EvaluationCallback {
 public:
  // kept: may be none. fit: the key of this one.
  AllWindows(int jobs, KeptResults* kept, std::uint64_t fit) : jobs_(jobs), kept_(kept), fit_(fit) {}
  void add(WindowCost* cost, std::vector<double*> blocks) { windows_.push_back({cost, std::move(blocks)}); }
  // Whether the blocks are where they may be; asked before every evaluation from here on.
  void ask_first(std::function<bool()> inside) { inside_ = std::move(inside); }
  bool refused() const { return refused_; }
  void PrepareForEvaluation(bool evaluate_jacobians, bool) override {
    if (inside_ && !inside_()) {
      for (const Window& w : windows_) w.cost->refuse();
      refused_ = true;
      return;
    }
    const std::uint64_t key = key_of(evaluations_++);
    if (auto found = kept_result<std::vector<WindowCost::Followed>>(kept_, key);
        found && found->size() == windows_.size()) {
      for (std::size_t k = 0; k < windows_.size(); ++k) windows_[k].cost->take(std::move((*found)[k]));
      return;
    }
    const auto begin = std::chrono::steady_clock::now();
    for_each_on_threads(static_cast<int>(windows_.size()), jobs_,
                        [&](int k) { windows_[k].cost->prepare(windows_[k].blocks, evaluate_jacobians); });
    if (kept_ == nullptr || std::chrono::steady_clock::now() - begin < kLong) return;
    std::vector<WindowCost::Followed> all;
    for (const Window& w : windows_) all.push_back(w.cost->followed());
    kept_->keep(key, Numbers::of(std::move(all)));
  }
  void forget() {
    if (kept_ == nullptr) return;
    for (std::uint64_t k = 0; k < evaluations_; ++k) kept_->forget(key_of(k));
  }

 private:
  // Far longer than it takes to write what an evaluation leaves.
  static constexpr auto kLong = std::chrono::milliseconds(50);
  std::uint64_t key_of(std::uint64_t evaluation) const {
    Checksum sum;
    sum.add(fit_);
    sum.add(evaluation);
    return static_cast<std::uint64_t>(sum.value());
  }

  struct Window {
    WindowCost* cost;
    std::vector<double*> blocks;
  };
  int jobs_;
  KeptResults* kept_;
  std::uint64_t fit_, evaluations_ = 0;
  std::function<bool()> inside_;
  bool refused_ = false;
  std::vector<Window> windows_;
};

}  // namespace boresight
