// Where each lane stands in time. In double precision whatever the lanes' own: a second of motion takes thousands of steps, some
// of them of a nanosecond.
#pragma once

#include <array>
#include <cstring>

#include "boresight/lanes/lane_numbers.hpp"

namespace boresight {

template <typename T>
class LaneClock {
 public:
  static constexpr int W = T::kWidth;

  void set(int lane, double now, double end) {
    now_[lane] = now;
    end_[lane] = end;
  }

  // A step of h from now, or of what is left where that is less; next() is where it leads.
  void aim(T& h) {
    Numbers step = spread(h);
#pragma GCC unroll 1
    for (int l = 0; l < W; ++l) {
      const double left = end_[l] - now_[l], wanted = step[l];
      next_[l] = wanted < left ? now_[l] + wanted : end_[l];
      step[l] = static_cast<Number>(wanted < left ? wanted : left);
    }
    h = gather(step);
  }
  template <typename Mask>
  void advance(const Mask& lanes) {
    const Numbers chosen = spread(select(lanes, T(1.0), T(0.0)));
#pragma GCC unroll 1
    for (int l = 0; l < W; ++l) now_[l] = chosen[l] > 0 ? next_[l] : now_[l];
  }

  T now() const {
    Numbers t;
#pragma GCC unroll 1
    for (int l = 0; l < W; ++l) t[l] = static_cast<Number>(now_[l]);
    return gather(t);
  }
  // Whether the end is reached.
  typename T::Mask ended() const {
    Numbers left;
#pragma GCC unroll 1
    for (int l = 0; l < W; ++l) left[l] = static_cast<Number>(now_[l] < end_[l] ? 1.0 : 0.0);
    return gather(left) < T(0.5);
  }
  const double* times() const { return now_.data(); }
  const double* next() const { return next_.data(); }
  // Halfway between the two.
  void middles(double* t) const {
    for (int l = 0; l < W; ++l) t[l] = 0.5 * (now_[l] + next_[l]);
  }
  double now(int lane) const { return now_[lane]; }
  bool ended(int lane) const { return now_[lane] >= end_[lane]; }

 private:
  using Number = typename T::Number;
  // The lanes in memory, so that the loops above become a few instructions.
  using Numbers = std::array<Number, W>;
  static Numbers spread(const T& lanes) {
    Numbers numbers;
    std::memcpy(numbers.data(), &lanes.v, sizeof numbers);
    return numbers;
  }
  static T gather(const Numbers& numbers) {
    T lanes;
    std::memcpy(&lanes.v, numbers.data(), sizeof numbers);
    return lanes;
  }

  alignas(64) std::array<double, W> now_{}, next_{}, end_{};
};

}  // namespace boresight
