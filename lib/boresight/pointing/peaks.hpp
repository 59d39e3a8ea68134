// Where between the instants of a walk along a motion an index of pointing is largest. A maximum over instants alone depends on which
// instants there are; located between them, it is that of the motion.
#pragma once

#include <algorithm>
#include <array>
#include <boost/math/tools/minima.hpp>
#include <cstdint>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "boresight/pointing/indices.hpp"

namespace boresight {

// State: what is known at one instant, with t() [s] and error (PoseError). accept() takes states in order of time; they are handed on in this
// order, and with them, between two of them, the states of the peaks that may be the largest so far.
template <class State>
class PeakSeeker {
 public:
  // The state at time t, followed from the one before.
  using Follow = std::function<State(double t, const State& before)>;
  using Take = std::function<void(const State&)>;

  // Peaks before `start` do not count [s].
  PeakSeeker(double start, Follow follow, Take take)
      : start_(start), follow_(std::move(follow)), take_(std::move(take)) {}

  void accept(State next) {
    if (before_ && last_) look_beside_last(next);
    if (last_) hand_on(*last_);
    before_ = std::move(last_);
    last_ = std::move(next);
    for (State& state : after_) hand_on(state);
    after_.clear();
  }
  // No more will come.
  void finish() {
    if (last_) hand_on(*last_);
    before_.reset();
    last_.reset();
  }

 private:
  static constexpr std::size_t kIndices = 4;
  // A peak that rises above its neighbours by less than this share is not worth a look, and may be one by rounding.
  static constexpr double kFlat = 1e-7;
  // Half the digits: a maximum is then known to all of them (Brent 1973, chapter 5).
  static constexpr int kBits = 26;
  static constexpr std::uintmax_t kMostLooks = 60;

  static std::array<double, kIndices> indices(const State& state) {
    return {state.error.position, state.error.orientation, state.error.boresight, state.error.line_of_sight};
  }

  void look_beside_last(const State& next) {
    const auto left = indices(*before_), middle = indices(*last_), right = indices(next);
    std::vector<State> earlier;
    for (std::size_t q = 0; q < kIndices; ++q) {
      const double rise = middle[q] - std::min(left[q], right[q]);
      if (last_->t() < start_ || middle[q] < left[q] || middle[q] < right[q] || rise <= kFlat * middle[q] ||
          middle[q] + rise < largest_[q])
        continue;
      std::optional<State> peak;
      std::uintmax_t looks = kMostLooks;
      // As a share of the way, so that a maximum at the edge of a jump is found as closely as the jump.
      const double from = std::max(start_, before_->t()), way = next.t() - from;
      boost::math::tools::brent_find_minima(
          [&](double share) {
            const double t = from + share * way;
            State state = follow_(t, t < last_->t() ? *before_ : *last_);
            const double value = indices(state)[q];
            if (value > (peak ? indices(*peak)[q] : middle[q])) peak = std::move(state);
            return -value;
          },
          0.0, 1.0, kBits, looks);
      if (peak) (peak->t() < last_->t() ? earlier : after_).push_back(std::move(*peak));
    }
    const auto by_time = [](const State& a, const State& b) { return a.t() < b.t(); };
    std::sort(earlier.begin(), earlier.end(), by_time);
    std::sort(after_.begin(), after_.end(), by_time);
    for (const State& state : earlier) hand_on(state);
  }

  void hand_on(const State& state) {
    if (state.t() >= start_) {
      const auto values = indices(state);
      for (std::size_t q = 0; q < kIndices; ++q) largest_[q] = std::max(largest_[q], values[q]);
    }
    take_(state);
  }

  double start_;
  Follow follow_;
  Take take_;
  std::optional<State> before_, last_;  // the last two accepted; the later one is still to be handed on
  std::vector<State> after_;            // peaks between the last one and the next
  std::array<double, kIndices> largest_{};
};

}  // namespace boresight
